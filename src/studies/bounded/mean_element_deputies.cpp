#include "mean_element_deputies.hpp"

#include <cmath>

#include "../../poincare/nodal_flight.hpp"
#include "hamjet/dynamics/mean_elements.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

// Units of length and time are the canonical ones throughout: only their ratio to mu counts.

CartesianState cartesian_of(const SixNumbers<double>& state) {
  CartesianState result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.position_km[i] = state[i];
    result.velocity_km_s[i] = state[i + 3];
  }
  return result;
}

SixNumbers<double> six_numbers_of(const CartesianState& state) {
  SixNumbers<double> result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = static_cast<double>(state.position_km[i]);
    result[i + 3] = static_cast<double>(state.velocity_km_s[i]);
  }
  return result;
}

}  // namespace

SixNumbers<double> mean_element_deputy(const ZonalGravity& field, const SixNumbers<double>& chief,
                                       MeanElementRule rule, double q, double p) {
  const double J2 = field.J[2];
  const OblateBody body{field.mu, field.radius, J2};
  const SixNumbers<double> mean = six_numbers_of(mean_of_osculating(cartesian_of(chief), body));
  const CanonicalChart<double> chart(ChartName::nodal, mean, field.mu);
  SixNumbers<double> z = chart.coordinates(mean);
  double& L = z[3];
  const auto eta = [&] {
    return 1 - (z[q_place] * z[q_place] + z[p_place] * z[p_place]) / (2 * L);
  };
  const double chief_eta = eta();
  const double chief_cosine = z[momentum_place] / (L * chief_eta);
  double inclination = std::acos(chief_cosine);
  z[q_place] += q;
  z[p_place] += p;
  const double difference = eta() - chief_eta;
  if (rule == MeanElementRule::j2_invariant) {
    const double a = L * L / field.mu;
    const double D = J2 * field.radius * field.radius / (4 * a * a * std::pow(chief_eta, 5)) *
                     (4 + 3 * chief_eta) * (1 + 5 * chief_cosine * chief_cosine);
    // A difference of the inclination turns the momentum H alone: through zero at the equator the
    // rule has no answer.
    inclination -= 4 * difference / (chief_eta * std::tan(inclination));
    // The pair is held, so that L changes L - G not at all; da/a = 2 dL/L.
    L *= 1 + D * difference;
  }
  const double G = L - (z[q_place] * z[q_place] + z[p_place] * z[p_place]) / 2;
  z[momentum_place] = G * std::cos(inclination);
  const SixNumbers<double> deputy = chart.state(z);
  for (const double x : deputy) {
    if (!std::isfinite(x) || !(G > 0) || !(std::sin(inclination) > 0)) {
      throw Error(ErrorKind::numerical, "mean elements: there is no such deputy");
    }
  }
  return six_numbers_of(osculating_of_mean(cartesian_of(deputy), body));
}

}  // namespace hamjet
