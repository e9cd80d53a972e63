#include "message_agreement.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "../../algebra/hermite_cubic.hpp"
#include "../../astronomy/physical_constants.hpp"
#include "../../dynamics/celestial_bodies.hpp"
#include "../../text/letter_case.hpp"

namespace hamjet::io {
namespace {

/// Placeholders that stand for an unknown name.
constexpr std::array<std::string_view, 7> placeholders = {"",     "UNKNOWN", "NONE",     "N/A",
                                                          "NULL", "DEPUTY",  "UNDEFINED"};

/// Axes that move with precession or nutation. Without an epoch, they are those of the state's own
/// moment.
constexpr std::array<std::string_view, 4> frames_of_date = {"TOD", "MOD", "TEMEOFDATE", "CIRF"};

/// Axes close to those of J2000.
constexpr std::array<std::string_view, 6> frames_of_J2000 = {"EME2000", "GCRF",  "ICRF",
                                                             "ICRF1",   "ICRF2", "ICRF3"};
constexpr double angle_of_frame_bias = 1.2e-7;
constexpr double angle_of_precession = 0.03;

bool is_among(const auto& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The largest possible angle between the axes of two inertial frames.
double angle_between(const KnownState& one, const KnownState& other) {
  const std::string_view a = name_of_axes(one.reference_frame);
  const std::string_view b = name_of_axes(other.reference_frame);
  if (a == b && one.reference_frame_epoch == other.reference_frame_epoch) return 0;
  return is_among(frames_of_J2000, a) && is_among(frames_of_J2000, b) ? angle_of_frame_bias
                                                                      : angle_of_precession;
}

/// Converts a state in axes that rotate with the Earth to inertial axes with the same pole. The
/// remaining angle about the pole is chosen so that the state lies as the other one does.
KnownState without_rotation(KnownState state, const KnownState& other) {
  const Eigen::Vector3d rate(0, 0, earth_rate);
  state.velocity_km_s += rate.cross(state.position_km);
  const double off_pole = state.position_km.head<2>().norm() / state.position_km.norm();
  const double speed_off_pole = state.velocity_km_s.head<2>().norm() / state.velocity_km_s.norm();
  const auto turn = [](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return std::atan2(to[1], to[0]) - std::atan2(from[1], from[0]);
  };
  const double angle = off_pole >= speed_off_pole ? turn(state.position_km, other.position_km)
                                                  : turn(state.velocity_km_s, other.velocity_km_s);
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  state.position_km = rotation * state.position_km;
  state.velocity_km_s = rotation * state.velocity_km_s;
  return state;
}

}  // namespace

std::vector<std::string> known_names(std::vector<std::string> names) {
  std::vector<std::string> known;
  for (std::string& name : names) {
    if (!is_among(placeholders, capitals(name)) && !is_among(known, name)) {
      known.push_back(std::move(name));
    }
  }
  return known;
}

std::vector<std::string> known_names_of(const ConjunctionObject& object) {
  return known_names(
      {object.object_name, object.international_designator, object.object_designator});
}

bool are_other_objects(const std::vector<std::string>& one, const std::vector<std::string>& other) {
  if (one.empty() || other.empty()) return false;
  return std::none_of(one.begin(), one.end(), [&](const std::string& name) {
    return std::any_of(other.begin(), other.end(), [&](const std::string& of_other) {
      return capitals(name) == capitals(of_other);
    });
  });
}

bool is_same_centre(const std::string& one, const std::string& other) {
  return one == other || (body_named(one) != nullptr && body_named(one) == body_named(other));
}

std::string axes_text(const std::string& reference_frame, const std::string& epoch) {
  if (!epoch.empty()) return fmt::format("{} of {}", reference_frame, epoch);
  return is_among(frames_of_date, name_of_axes(reference_frame)) ? reference_frame + " of date"
                                                                 : reference_frame;
}

bool is_same_axes(const EphemerisSettings& one, const EphemerisSettings& other) {
  const std::string_view axes = name_of_axes(one.reference_frame);
  if (axes != name_of_axes(other.reference_frame)) return false;
  const auto epoch_of = [&](const EphemerisSettings& settings) {
    const bool is_of_date =
        settings.reference_frame_epoch.empty() && is_among(frames_of_date, axes);
    return is_of_date ? parse_epoch(settings.epoch) : parse_epoch(settings.reference_frame_epoch);
  };
  return epoch_of(one) == epoch_of(other);
}

StateDifference difference_of_states(const KnownState& message, const KnownState& scene,
                                     double position_deviation_km, double velocity_deviation_km_s) {
  const bool is_rotating = message.reference_frame.starts_with("ITRF");
  const KnownState given = is_rotating ? without_rotation(message, scene) : message;
  const double angle = is_rotating ? angle_of_precession : angle_between(message, scene);
  StateDifference difference;
  // If the axes differ by an angle, the lengths of the vectors are compared too, because no angle
  // changes these.
  const auto compare = [&](const Eigen::Vector3d& one, const Eigen::Vector3d& other,
                           double tolerance, double& between, double& most) {
    const double size = other.stableNorm();
    const double of_lengths = std::abs(one.stableNorm() - size);
    const double of_size = tolerance + rounding_of_states * size;
    between = (one - other).stableNorm();
    most = of_size + angle * size;
    if (between <= most && of_lengths > of_size) {
      between = of_lengths;
      most = of_size;
    }
  };
  compare(given.position_km, scene.position_km,
          most_standard_deviations * position_deviation_km + message.position_error_km +
              scene.position_error_km,
          difference.position_km, difference.most_position_km);
  compare(given.velocity_km_s, scene.velocity_km_s,
          most_standard_deviations * velocity_deviation_km_s + message.velocity_error_km_s +
              scene.velocity_error_km_s,
          difference.velocity_km_s, difference.most_velocity_km_s);
  return difference;
}

bool interpolate_state(std::span<const OrbitState> states, const Epoch& epoch, double mu_km3_s2,
                       KnownState& result) {
  const auto after = std::lower_bound(
      states.begin(), states.end(), epoch,
      [](const OrbitState& state, const Epoch& wanted) { return state.epoch < wanted; });
  if (after == states.end()) return false;
  const auto vector = [](const std::array<double, 3>& numbers) {
    return Eigen::Vector3d(numbers.data());
  };
  result.position_km = vector(after->position_km);
  result.velocity_km_s = vector(after->velocity_km_s);
  result.position_error_km = result.velocity_error_km_s = 0;
  if (after->epoch == epoch) return true;
  if (after == states.begin()) return false;
  const OrbitState& before = *(after - 1);
  const double h = seconds_between(before.epoch, after->epoch);
  const HermiteWeights weights = hermite_weights(h, seconds_between(before.epoch, epoch) / h);
  const Eigen::Vector3d q = vector(before.position_km), v = vector(before.velocity_km_s);
  const Eigen::Vector3d end = result.position_km, end_velocity = result.velocity_km_s;
  const auto cubic = [&](const std::array<double, 4>& w) -> Eigen::Vector3d {
    return w[0] * q + w[1] * v + w[2] * end + w[3] * end_velocity;
  };
  const double r = std::min(q.norm(), end.norm());
  result.position_km = cubic(weights.position);
  result.velocity_km_s = cubic(weights.velocity);
  const double fourth_derivative = 10 * mu_km3_s2 * mu_km3_s2 / std::pow(r, 5);
  result.position_error_km = fourth_derivative * std::pow(h, 4) / 384;
  result.velocity_error_km_s = fourth_derivative * std::pow(h, 3) / (72 * std::sqrt(3.0));
  return true;
}

}  // namespace hamjet::io
