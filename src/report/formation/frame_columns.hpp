#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/result_table.hpp"
#include "../../studies/formation/charts/free_coordinates.hpp"
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

/// Adds a vector along the axes of a transfer's frame, of which a system may have fewer than three;
/// `value` returns it, or an optional of it.
template <class Row, class Value>
void add_along_axes(ResultTable<Row>& table, const Scene& scene, std::string name,
                    std::vector<std::string> parts, std::string unit, std::string meaning,
                    Value value) {
  const std::size_t count = told_coordinates(scene.system);
  table.add_array(std::move(name), std::move(parts), std::move(unit), std::move(meaning),
                  [count, value](const Row& row) {
                    const auto told = [&](const Eigen::Vector3d& vector) {
                      return along_told_axes(vector, count);
                    };
                    using Given = std::remove_cvref_t<std::invoke_result_t<Value, const Row&>>;
                    if constexpr (std::is_same_v<Given, std::optional<Eigen::Vector3d>>) {
                      const Given given = std::invoke(value, row);
                      return given ? std::optional(told(*given)) : std::nullopt;
                    } else {
                      return told(std::invoke(value, row));
                    }
                  });
}

/// Adds the costates at the start of a transfer, an optional of six numbers: those of positions and
/// velocities along the inertial axes, or of coordinates and momenta of a system without an orbit.
template <class Row, class Value>
void add_costates(ResultTable<Row>& table, const Scene& scene, const std::string& meaning,
                  Value value) {
  std::vector<std::string> parts = {"costate_x",  "costate_y",  "costate_z",
                                    "costate_vx", "costate_vy", "costate_vz"};
  const std::size_t count = told_coordinates(scene.system);
  if (scene.transfer->frame == RelativeFrame::coordinates && scene.system.own_text) {
    parts.clear();
    const SystemText& text = *scene.system.own_text;
    for (const auto* names : {&text.coordinates, &text.momenta}) {
      for (std::size_t i = 0; i < count; ++i) parts.push_back("costate_" + (*names)[i]);
    }
  }
  table.add_array("costates", std::move(parts), "",
                  "the costates at the start, in the scene's canonical units along inertial axes "
                  "or an own system's coordinates" +
                      meaning,
                  [count, value](const Row& row) {
                    const std::optional<std::vector<double>> all = std::invoke(value, row);
                    if (!all) return all;
                    std::vector<double> told;
                    for (const std::size_t first : {std::size_t{0}, all->size() / 2}) {
                      const auto begin = all->begin() + static_cast<std::ptrdiff_t>(first);
                      told.insert(told.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
                    }
                    return std::optional(told);
                  });
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
