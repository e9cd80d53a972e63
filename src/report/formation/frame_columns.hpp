#pragma once

#include <string>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/result_table.hpp"
#include "hamjet/charts/jet_coordinates.hpp"

namespace hamjet::io {

/// Adds the frame that a result is told in, and the coordinates of its polynomials; `is_in_csv`
/// says whether each row has them too.
template <class Row>
void add_frame(ResultTable<Row>& table, RelativeFrame frame, const CoordinatesAtEnds& coordinates,
               bool is_in_csv = false) {
  const auto add = [&](const char* name, const char* meaning, std::string_view value) {
    table.add_scalar(name, "", meaning, value).is_in_csv = is_in_csv;
  };
  add("frame", "the axes: RTN of the chief, or inertial", frame_name(frame));
  add("derivatives", "whether velocities are seen from the turning axes or from inertial ones",
      derivatives_name(frame));
  add("coordinates", "coordinates of the polynomials at the start", name_of(coordinates.start));
  add("end_coordinates", "coordinates of the polynomials at the end", name_of(coordinates.end));
  table.add_scalars("axes", "", "letters of the frame's axes", axis_letters(frame));
}

}  // namespace hamjet::io
