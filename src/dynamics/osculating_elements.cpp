#include "hamjet/dynamics/osculating_elements.hpp"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <iterator>

#include "hamjet/error.hpp"
#include "kepler_root.hpp"

namespace hamjet {
namespace {

Extended pi() { return boost::math::constants::pi<Extended>(); }

/// The angle reduced to (-360, 360), so that the sum of two such angles keeps at least 100 bits
/// below the degree. Nothing is rounded below 1e30 degrees, where the number of turns is exact.
Extended within_one_turn(const Extended& angle_deg) { return fmod(angle_deg, Extended(360)); }

/// A zero with a minus sign, which the products below may leave, means the same as +0 but would be
/// printed differently.
Extended without_sign_of_zero(const Extended& value) { return value == 0 ? Extended(0) : value; }

Extended norm_squared(const std::array<Extended, 3>& v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

void check(const OsculatingElements& elements, double mu_km3_s2) {
  const Extended* const numbers[] = {
      &elements.semi_major_axis_km,      &elements.eccentricity,
      &elements.inclination_deg,         &elements.ascending_node_deg,
      &elements.argument_of_perigee_deg, &elements.true_anomaly_deg};
  const bool finite =
      std::isfinite(mu_km3_s2) && std::all_of(std::begin(numbers), std::end(numbers),
                                              [](const Extended* x) { return isfinite(*x); });
  if (!finite || elements.semi_major_axis_km <= 0 || elements.eccentricity < 0 ||
      elements.eccentricity >= 1 || mu_km3_s2 <= 0) {
    throw Error(ErrorKind::usage,
                "osculating elements must be finite, with a > 0, 0 <= e < 1 and mu > 0");
  }
}

/// The direction (x, y) as an angle from 0 to 360 degrees.
Extended positive_degrees(const Extended& y, const Extended& x) {
  const Extended angle = atan2(y, x) * 180 / pi();
  return without_sign_of_zero(angle < 0 ? Extended(angle + 360) : angle);
}

void check_anomaly(const Extended& anomaly_deg, const Extended& eccentricity) {
  if (!isfinite(anomaly_deg) || !(eccentricity >= 0 && eccentricity < 1)) {
    throw Error(ErrorKind::usage, "an anomaly must be finite, with 0 <= e < 1");
  }
}

}  // namespace

SineCosine sine_cosine_of_degrees(const Extended& angle_deg) {
  const Extended turn = fmod(angle_deg, Extended(360));
  // 90 * quadrant is a small integer, and the difference of two numbers this close is exact.
  const int quadrant = static_cast<int>(floor(turn / 90 + Extended(0.5)));
  const Extended remainder_rad = (turn - 90 * quadrant) * pi() / 180;
  const Extended s = sin(remainder_rad);
  const Extended c = cos(remainder_rad);
  switch (((quadrant % 4) + 4) % 4) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

CartesianState state_from_elements(const OsculatingElements& elements, double mu_km3_s2) {
  check(elements, mu_km3_s2);
  const Extended a = elements.semi_major_axis_km;
  const Extended e = elements.eccentricity;
  const Extended perigee_deg = within_one_turn(elements.argument_of_perigee_deg);
  const Extended anomaly_deg = within_one_turn(elements.true_anomaly_deg);
  const auto [sin_node, cos_node] =
      sine_cosine_of_degrees(within_one_turn(elements.ascending_node_deg));
  const auto [sin_i, cos_i] = sine_cosine_of_degrees(within_one_turn(elements.inclination_deg));
  const auto [sin_perigee, cos_perigee] = sine_cosine_of_degrees(perigee_deg);
  const auto [sin_anomaly, cos_anomaly] = sine_cosine_of_degrees(anomaly_deg);
  // The argument of latitude. Its angles are added in degrees, where 45 + 45 is exactly 90.
  const auto [sin_latitude, cos_latitude] = sine_cosine_of_degrees(perigee_deg + anomaly_deg);

  const Extended semi_latus_rectum = a * (1 - e) * (1 + e);
  const Extended r = semi_latus_rectum / (1 + e * cos_anomaly);
  const Extended speed_scale = sqrt(Extended(mu_km3_s2) / semi_latus_rectum);
  // Velocity along the line of nodes, and at right angles to it in the orbit's plane.
  const Extended along_node = -speed_scale * (sin_latitude + e * sin_perigee);
  const Extended across_node = speed_scale * (cos_latitude + e * cos_perigee);

  CartesianState state;
  state.position_km = {r * (cos_node * cos_latitude - sin_node * sin_latitude * cos_i),
                       r * (sin_node * cos_latitude + cos_node * sin_latitude * cos_i),
                       r * sin_latitude * sin_i};
  state.velocity_km_s = {cos_node * along_node - sin_node * across_node * cos_i,
                         sin_node * along_node + cos_node * across_node * cos_i,
                         across_node * sin_i};
  for (Extended& x : state.position_km) x = without_sign_of_zero(x);
  for (Extended& v : state.velocity_km_s) v = without_sign_of_zero(v);
  return state;
}

OsculatingElements elements_from_state(const CartesianState& state, double mu_km3_s2) {
  const auto& r = state.position_km;
  const auto& v = state.velocity_km_s;
  const bool is_finite =
      std::all_of(r.begin(), r.end(), [](const auto& x) { return isfinite(x); }) &&
      std::all_of(v.begin(), v.end(), [](const auto& x) { return isfinite(x); });
  if (!is_finite || !(std::isfinite(mu_km3_s2) && mu_km3_s2 > 0)) {
    throw Error(ErrorKind::usage, "elements: state and mu must be finite, and mu above 0");
  }
  const Extended mu = mu_km3_s2;
  const std::array<Extended, 3> h = {r[1] * v[2] - r[2] * v[1], r[2] * v[0] - r[0] * v[2],
                                     r[0] * v[1] - r[1] * v[0]};
  const Extended momentum = sqrt(norm_squared(h)), distance = sqrt(norm_squared(r));
  const Extended inverse_a = 2 / distance - norm_squared(v) / mu;
  if (!(inverse_a > 0) || !(momentum > 0)) {
    throw Error(ErrorKind::numerical, "elements: the orbit is no ellipse");
  }
  OsculatingElements elements;
  elements.semi_major_axis_km = 1 / inverse_a;
  const Extended radial = r[0] * v[0] + r[1] * v[1] + r[2] * v[2];
  const Extended e_cosine = momentum * momentum / (mu * distance) - 1;
  const Extended e_sine = momentum * radial / (mu * distance);
  elements.eccentricity = sqrt(e_cosine * e_cosine + e_sine * e_sine);
  const Extended across = sqrt(h[0] * h[0] + h[1] * h[1]);
  elements.inclination_deg = atan2(across, h[2]) * 180 / pi();
  // The direction of the line of nodes; in the equatorial plane it is the x axis.
  const Extended node_x = across > 0 ? Extended(-h[1] / across) : Extended(1);
  const Extended node_y = across > 0 ? Extended(h[0] / across) : Extended(0);
  elements.ascending_node_deg = positive_degrees(node_y, node_x);
  const Extended along_node = r[0] * node_x + r[1] * node_y;
  const Extended beyond_node = (r[2] * across + h[2] * (node_x * r[1] - node_y * r[0])) / momentum;
  const Extended latitude_deg = positive_degrees(beyond_node, along_node);
  if (elements.eccentricity > 0) {
    elements.true_anomaly_deg = positive_degrees(e_sine, e_cosine);
  } else {
    elements.true_anomaly_deg = latitude_deg;
  }
  const Extended perigee_deg = latitude_deg - elements.true_anomaly_deg;
  elements.argument_of_perigee_deg = perigee_deg < 0 ? Extended(perigee_deg + 360) : perigee_deg;
  return elements;
}

Extended eccentric_anomaly_of_mean_deg(const Extended& mean_anomaly_deg,
                                       const Extended& eccentricity) {
  check_anomaly(mean_anomaly_deg, eccentricity);
  // The angle is in degrees, because sine and cosine are then exact at multiples of a right angle.
  const Extended e_deg = eccentricity * 180 / pi();
  const auto miss = [&](const Extended& anomaly_deg) -> MissAndSlope {
    const auto [sine, cosine] = sine_cosine_of_degrees(anomaly_deg);
    return {anomaly_deg - e_deg * sine - mean_anomaly_deg, 1 - eccentricity * cosine};
  };
  return root_in_bracket(miss, mean_anomaly_deg - e_deg, mean_anomaly_deg + e_deg,
                         mean_anomaly_deg);
}

Extended true_anomaly_of_eccentric_deg(const Extended& eccentric_anomaly_deg,
                                       const Extended& eccentricity) {
  check_anomaly(eccentric_anomaly_deg, eccentricity);
  const Extended b = eccentricity / (1 + sqrt(Extended((1 - eccentricity) * (1 + eccentricity))));
  const auto [sine, cosine] = sine_cosine_of_degrees(eccentric_anomaly_deg);
  return eccentric_anomaly_deg + 2 * atan(Extended(b * sine / (1 - b * cosine))) * 180 / pi();
}

Extended mean_anomaly_of_true_deg(const Extended& true_anomaly_deg, const Extended& eccentricity) {
  check_anomaly(true_anomaly_deg, eccentricity);
  const auto [sine, cosine] = sine_cosine_of_degrees(true_anomaly_deg);
  const Extended eta = sqrt(Extended((1 - eccentricity) * (1 + eccentricity)));
  // sin E and cos E times 1 + e cos nu.
  const Extended E_deg = positive_degrees(eta * sine, eccentricity + cosine);
  const Extended sine_of_E = eta * sine / (1 + eccentricity * cosine);
  const Extended mean_deg = E_deg - eccentricity * sine_of_E * 180 / pi();
  return without_sign_of_zero(mean_deg < 0 ? Extended(mean_deg + 360) : mean_deg);
}

Extended semi_major_axis_of_period_km(const Extended& period_s, double mu_km3_s2) {
  if (!(isfinite(period_s) && period_s > 0 && std::isfinite(mu_km3_s2) && mu_km3_s2 > 0)) {
    throw Error(ErrorKind::usage, "a period and mu must be finite and above 0");
  }
  const Extended inverse_motion = period_s / (2 * pi());
  return pow(Extended(mu_km3_s2 * inverse_motion * inverse_motion), Extended(1) / 3);
}

std::optional<Extended> osculating_period_s(const CartesianState& state, double mu_km3_s2) {
  const Extended mu = mu_km3_s2;
  const auto& [x, y, z] = state.position_km;
  const auto& [vx, vy, vz] = state.velocity_km_s;
  const std::array<Extended, 3> angular_momentum = {y * vz - z * vy, z * vx - x * vz,
                                                    x * vy - y * vx};
  const Extended inverse_a =
      2 / sqrt(norm_squared(state.position_km)) - norm_squared(state.velocity_km_s) / mu;
  if (inverse_a <= 0 || norm_squared(angular_momentum) == 0) return std::nullopt;
  const Extended a = 1 / inverse_a;
  return 2 * pi() * sqrt(a * a * a / mu);
}

}  // namespace hamjet
