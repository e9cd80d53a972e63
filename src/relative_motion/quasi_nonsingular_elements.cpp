#include "quasi_nonsingular_elements.hpp"

#include <fmt/format.h>

#include <boost/math/constants/constants.hpp>

#include "../dynamics/kepler_root.hpp"
#include "extended_vectors.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// Cosine and sine of an angle in the orbit's plane.
struct Direction {
  Extended cosine;
  Extended sine;
};

/// eta = sqrt(1 - e^2), and the quantities that the closed formulas make of eta. Throws unless the
/// orbit is an ellipse.
struct Ellipse {
  explicit Ellipse(const QuasiNonsingularElements& elements)
      : x(elements.eccentricity_x), y(elements.eccentricity_y) {
    const Extended square = x * x + y * y;
    if (!(elements.semi_major_axis > 0) || !(square < 1)) {
      throw Error(ErrorKind::numerical,
                  "orbital elements: the orbit is no ellipse, which needs a > 0 and e < 1");
    }
    eta = sqrt(1 - square);
    beta = 1 / (1 + eta);
  }

  Extended x, y, eta, beta;
};

/// The eccentric argument of latitude F that belongs to a mean argument of latitude u, with |F - u|
/// <= e.
Extended eccentric_argument(const Ellipse& ellipse, const Extended& mean) {
  const Extended e = sqrt(ellipse.x * ellipse.x + ellipse.y * ellipse.y);
  const auto miss = [&](const Extended& F) -> MissAndSlope {
    const Extended sine = sin(F), cosine = cos(F);
    return {F - ellipse.x * sine + ellipse.y * cosine - mean,
            1 - ellipse.x * cosine - ellipse.y * sine};
  };
  return root_in_bracket(miss, mean - e, mean + e, mean);
}

/// The position on the ellipse, as a multiple of a, along the line of nodes and across it.
Direction place_at(const Ellipse& ellipse, const Extended& eccentric) {
  const auto& [x, y, eta, beta] = ellipse;
  const Extended sine = sin(eccentric), cosine = cos(eccentric);
  return {(1 - y * y * beta) * cosine + x * y * beta * sine - x,
          (1 - x * x * beta) * sine + x * y * beta * cosine - y};
}

/// The eccentric argument of latitude of the position that lies on the ellipse in the given
/// direction, on the same turn as `near`.
Extended eccentric_argument_of(const Ellipse& ellipse, const Direction& direction) {
  const auto& [x, y, eta, beta] = ellipse;
  const Extended r = eta * eta / (1 + x * direction.cosine + y * direction.sine);
  const Extended X = r * direction.cosine, Y = r * direction.sine;
  return atan2(Extended(y + ((1 - y * y * beta) * Y - x * y * beta * X) / eta),
               Extended(x + ((1 - x * x * beta) * X - x * y * beta * Y) / eta));
}

}  // namespace

Extended within_half_turn(const Extended& angle) {
  const Extended turn = 2 * boost::math::constants::pi<Extended>();
  const Extended rest = angle - turn * floor(angle / turn);
  return rest > turn / 2 ? Extended(rest - turn) : rest;
}

Extended true_argument_of_latitude(const QuasiNonsingularElements& elements) {
  const Ellipse ellipse(elements);
  const Extended& mean = elements.mean_argument_of_latitude;
  const Direction place = place_at(ellipse, eccentric_argument(ellipse, mean));
  // The true argument of latitude is within half a turn of the mean one.
  return mean + within_half_turn(atan2(place.sine, place.cosine) - mean);
}

Extended mean_argument_of_latitude(const QuasiNonsingularElements& elements) {
  const Ellipse ellipse(elements);
  const Extended& theta = elements.true_argument_of_latitude;
  const Extended F = eccentric_argument_of(ellipse, {cos(theta), sin(theta)});
  return theta + within_half_turn(F - ellipse.x * sin(F) + ellipse.y * cos(F) - theta);
}

QuasiNonsingularElements quasi_nonsingular_elements(const OrbitState& state, const Extended& mu,
                                                    std::string_view satellite) {
  const auto refuse = [&](std::string_view why) {
    throw Error(
        ErrorKind::numerical,
        fmt::format("orbital elements: the orbit of the {} {}; curvilinear coordinates need "
                    "no elements",
                    satellite, why));
  };
  const ExtendedVector r = {state[0], state[1], state[2]}, v = {state[3], state[4], state[5]};
  const ExtendedVector h = cross(r, v);
  const Extended distance = sqrt(dot(r, r)), momentum = sqrt(dot(h, h));
  const Extended across = sqrt(h[0] * h[0] + h[1] * h[1]);
  // For a smaller inclination the rounding of the state alone would decide where the node is.
  const Extended least_sine("1e-12");
  if (!(momentum > least_sine * distance * sqrt(dot(v, v)))) {
    refuse("is a line through the centre, without a plane");
  }
  if (!(across > least_sine * momentum)) {
    refuse("lies in the equatorial plane and has no node");
  }
  QuasiNonsingularElements elements;
  const Extended inverse_a = 2 / distance - dot(v, v) / mu;
  if (!(inverse_a > 0)) {
    refuse("is no ellipse, it escapes");
  }
  elements.semi_major_axis = 1 / inverse_a;
  elements.inclination = atan2(across, h[2]);
  elements.ascending_node = atan2(h[0], Extended(-h[1]));
  // The position along the line of nodes and across it, divided by the distance.
  const ExtendedVector node = {-h[1] / across, h[0] / across, 0};
  const Extended cosine = dot(r, node) / distance;
  const Extended sine = dot(r, cross(h, node)) / (momentum * distance);
  elements.true_argument_of_latitude = atan2(sine, cosine);
  // e cos f and e sin f, with f = theta - w, turned by theta.
  const Extended radial = momentum * momentum / (mu * distance) - 1;
  const Extended transverse = dot(r, v) * momentum / (mu * distance);
  elements.eccentricity_x = radial * cosine + transverse * sine;
  elements.eccentricity_y = radial * sine - transverse * cosine;
  elements.mean_argument_of_latitude = mean_argument_of_latitude(elements);
  return elements;
}

OrbitState state_from_elements(const QuasiNonsingularElements& elements, const Extended& mu) {
  const Ellipse ellipse(elements);
  const Extended& a = elements.semi_major_axis;
  const Direction place =
      place_at(ellipse, eccentric_argument(ellipse, elements.mean_argument_of_latitude));
  const Extended r = sqrt(place.cosine * place.cosine + place.sine * place.sine);
  const Extended speed = sqrt(mu / a) / ellipse.eta;  // mu / |h|
  // Position and velocity along the line of nodes and across it, in the orbit's plane.
  const std::array<Extended, 2> along = {a * place.cosine, -speed * (place.sine / r + ellipse.y)};
  const std::array<Extended, 2> across = {a * place.sine, speed * (place.cosine / r + ellipse.x)};
  const Extended cos_node = cos(elements.ascending_node), sin_node = sin(elements.ascending_node);
  const Extended cos_i = cos(elements.inclination), sin_i = sin(elements.inclination);
  OrbitState state;
  for (std::size_t k = 0; k < 2; ++k) {
    state[3 * k] = along[k] * cos_node - across[k] * sin_node * cos_i;
    state[3 * k + 1] = along[k] * sin_node + across[k] * cos_node * cos_i;
    state[3 * k + 2] = across[k] * sin_i;
  }
  return state;
}

}  // namespace hamjet
