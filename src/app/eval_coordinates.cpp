#include "eval_coordinates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../formats/relative_frame_text.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "refusal.hpp"

namespace hamjet::cli {
namespace {

const std::vector<std::string_view> frames = {"RTN", "inertial", "canonical"};
const std::vector<std::string_view> rtn_columns = {"R_m",    "T_m",    "N_m",
                                                   "vR_m_s", "vT_m_s", "vN_m_s"};
const std::vector<std::string_view> inertial_columns = {"x_m",    "y_m",    "z_m",
                                                        "vx_m_s", "vy_m_s", "vz_m_s"};

RelativeFrame relative_frame(const std::string& frame,
                             const std::optional<std::string>& derivatives) {
  if (frame == "inertial") return RelativeFrame::inertial;
  return derivatives.value_or("rotating") == "rotating" ? RelativeFrame::rtn_rotating
                                                        : RelativeFrame::rtn_inertial;
}

std::vector<double> numbers_of(const RelativeState& state) {
  return {state.position_m[0],   state.position_m[1],   state.position_m[2],
          state.velocity_m_s[0], state.velocity_m_s[1], state.velocity_m_s[2]};
}

}  // namespace

void check_frame(const std::string& frame, const std::optional<std::string>& derivatives) {
  if (frame == "LVLH") {
    refuse(
        "--frame LVLH: has two meanings: x radially outward and z along the orbit's normal, or z "
        "toward the nadir and y opposite the normal; say RTN, which is radial, transverse, normal");
  }
  if (std::find(frames.begin(), frames.end(), frame) == frames.end()) {
    refuse(fmt::format("--frame {}: no such frame; {}", io::printable(frame),
                       io::suggestion(frame, frames)));
  }
  if (!derivatives) return;
  if (frame != "RTN") {
    refuse(fmt::format("--derivatives: goes with --frame RTN alone, got --frame {}", frame));
  }
  if (*derivatives != "rotating" && *derivatives != "inertial") {
    refuse(
        fmt::format("--derivatives {}: must be rotating or inertial", io::printable(*derivatives)));
  }
}

EvalCoordinates::EvalCoordinates(const io::StoredJet& stored, const std::string& frame,
                                 const std::optional<std::string>& derivatives)
    : stored_(stored) {
  check_frame(frame, derivatives);
  if (frame == "canonical") {
    const auto names = stored.variable_names();
    for (const std::size_t v : stored.variables) initial_columns_.push_back(names[v]);
    for (const std::size_t c : stored.components) final_columns_.push_back(names[c]);
    return;
  }
  if (!is_orbit(stored.model)) {
    refuse(fmt::format("--frame {}: the model {} is no orbit; say --frame canonical", frame,
                       model_name(stored.model)));
  }
  initial_columns_ = final_columns_ = frame == "RTN" ? rtn_columns : inertial_columns;
  const MetricUnits units{stored.units.length_km * 1000, stored.units.time_s};
  const RelativeFrame axes = relative_frame(frame, derivatives);
  text_ = io::frame_text(axes);
  initial_.emplace(stored.nominal_initial, units, axes);
  final_.emplace(stored.nominal_final, units, axes);
}

std::vector<double> EvalCoordinates::initial_row(std::span<const double> canonical) const {
  if (initial_) return numbers_of(initial_->relative(canonical));
  std::vector<double> row;
  for (const std::size_t v : stored_.variables) row.push_back(canonical[v]);
  return row;
}

std::optional<std::vector<double>> EvalCoordinates::variables(
    std::span<const double> deviation) const {
  if (!initial_) return std::vector<double>(deviation.begin(), deviation.end());
  const auto canonical = initial_->deviation(
      {{deviation[0], deviation[1], deviation[2]}, {deviation[3], deviation[4], deviation[5]}});
  std::vector<double> result;
  for (const std::size_t v : stored_.variables) result.push_back(canonical[v]);
  if (result.size() == canonical.size()) return result;
  // What the rotation of the axes leaves of a component that ought to vanish is round-off.
  constexpr double round_off = 8 * std::numeric_limits<double>::epsilon();
  double size = 0;
  for (const double x : canonical) size = std::max(size, std::abs(x));
  for (std::size_t i = 0; i < canonical.size(); ++i) {
    const bool is_variable =
        std::binary_search(stored_.variables.begin(), stored_.variables.end(), i);
    if (!is_variable && std::abs(canonical[i]) > round_off * size) return std::nullopt;
  }
  return result;
}

std::vector<double> EvalCoordinates::final_state(std::span<const double> components) const {
  if (!final_) return {components.begin(), components.end()};
  std::vector<double> full(stored_.nominal_initial.size(), 0);
  for (std::size_t c = 0; c < components.size(); ++c) full[stored_.components[c]] = components[c];
  return numbers_of(final_->relative(full));
}

}  // namespace hamjet::cli
