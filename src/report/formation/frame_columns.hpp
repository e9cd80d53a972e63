#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/result_table.hpp"
#include "hamjet/charts/jet_coordinates.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet::io {

/// The first components of a vector along a frame's axes, of which a system may have fewer than
/// three.
inline std::vector<double> along_told_axes(const Eigen::Vector3d& vector, std::size_t count) {
  return {vector.begin(), vector.begin() + static_cast<std::ptrdiff_t>(count)};
}

/// The names of a vector's components along the axes of a transfer's frame, as in
/// "start_change_r_m_s".
inline std::vector<std::string> axis_parts(const Scene& scene, std::string_view before,
                                           std::string_view after) {
  std::vector<std::string> names;
  for (const std::string& axis : axis_columns(scene.system, scene.transfer->frame)) {
    names.push_back(fmt::format("{}{}{}", before, axis, after));
  }
  return names;
}

/// Adds the frame that a result is told in, and the coordinates of its polynomials; `is_in_csv`
/// says whether each row has them too.
template <class Row>
void add_frame(ResultTable<Row>& table, const SystemSettings& system, RelativeFrame frame,
               const CoordinatesAtEnds& coordinates, bool is_in_csv = false) {
  const auto add = [&](const char* name, const char* meaning, std::string_view value) {
    table.add_scalar(name, "", meaning, value).is_in_csv = is_in_csv;
  };
  add("frame", "the axes: RTN of the chief, or inertial", frame_name(frame));
  add("derivatives", "whether velocities are seen from the turning axes or from inertial ones",
      derivatives_name(frame));
  add("coordinates", "coordinates of the polynomials at the start", name_of(coordinates.start));
  add("end_coordinates", "coordinates of the polynomials at the end", name_of(coordinates.end));
  table.add_scalars("axes", "",
                    "the frame's axes: R, T, N or x, y, z, or an own system's coordinates",
                    axis_letters(system, frame));
}

}  // namespace hamjet::io
