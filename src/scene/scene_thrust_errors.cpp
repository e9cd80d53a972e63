#include <limits>

#include "scene_lasting_thrust.hpp"
#include "scene_relative_motion.hpp"

namespace hamjet::io {
namespace {

constexpr int fewest_error_samples = 10;
constexpr int most_error_samples = 100000;
constexpr double largest_error_seed = 1e15;

Eigen::Vector3d navigation_deviations(const TableReader& errors, std::string_view key) {
  if (!errors.has(key)) return Eigen::Vector3d::Zero();
  return Eigen::Vector3d(
      read_deviations(errors, key, std::numeric_limits<double>::infinity(), "").data());
}

}  // namespace

const TableDescription& thrust_errors_table() {
  static const ThrustErrorSettings preset;
  static const TableDescription table = {
      {{"position_m", deviations_form(), absent::other("0"),
        "standard deviations, along the axes of the frame, of the deputy's place that its "
        "controller believes"},
       {"velocity_m_s", deviations_form(), absent::other("0"), "likewise of its velocity"},
       {"magnitude", form::between(0, 1), absent::value(preset.magnitude),
        "standard deviation of the thrust's size, as a share of the size"},
       {"direction_deg", form::between(0, 90), absent::value(preset.direction_deg),
        "standard deviation of the thrust's direction about each of the two axes across it"},
       {"samples", form::integer(fewest_error_samples, most_error_samples),
        absent::value(preset.samples), "pairs of flights"},
       {"seed", form::integer(0, largest_error_seed), absent::value(preset.seed),
        "seed of the errors"}},
      "Errors drawn at random at each instant of `feedback`, under which its law and the open loop "
      "are flown; those of the thrust stay the same until the next instant."};
  return table;
}

ThrustErrorSettings read_thrust_errors(const TableReader& errors) {
  errors.check_keys();
  ThrustErrorSettings settings;
  settings.navigation.position_m = navigation_deviations(errors, "position_m");
  settings.navigation.velocity_m_s = navigation_deviations(errors, "velocity_m_s");
  errors.read_if_any("magnitude", settings.magnitude);
  errors.read_if_any("direction_deg", settings.direction_deg);
  errors.read_if_any("samples", settings.samples);
  errors.read_if_any("seed", settings.seed);
  return settings;
}

}  // namespace hamjet::io
