#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "../formats/relative_frame_text.hpp"
#include "../store/result_table.hpp"

namespace hamjet::io {

/// Adds the columns of the centre of a domain, along the frame of the results; `centre(row)` gives
/// its three metres and its three metres per second from what `from` names.
template <class Row, class Centre>
void add_centre(ResultTable<Row>& table, RelativeFrame frame, const std::string& from,
                const Centre& centre) {
  const auto names = component_names(frame);
  const auto add = [&](std::size_t first, const std::string& unit, const std::string& ending,
                       const std::string& of) {
    std::vector<std::string> parts;
    for (std::size_t i = first; i < first + 3; ++i) {
      parts.push_back("centre_" + std::string(names[i]) + ending);
    }
    table.add_array("centre" + ending, parts, unit,
                    "the " + of + " of its centre at the start, from " + from +
                        ", along the frame of the results",
                    [first, centre](const Row& row) {
                      const auto& numbers = centre(row);
                      const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(first);
                      return std::vector<double>(begin, begin + 3);
                    });
  };
  add(0, "m", "_m", "position");
  add(3, "m/s", "_m_s", "velocity");
}

}  // namespace hamjet::io
