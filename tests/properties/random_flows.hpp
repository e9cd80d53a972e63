#pragma once

#include <cmath>
#include <vector>

#include "properties/property.hpp"
#include "support/flow.hpp"
#include "support/magnitude.hpp"
#include "support/symplectic.hpp"

// Random flows, drawn within a property.

namespace hamjet::test {

/// An orbit of a planet much less round than the Earth, that stays away from its centre.
struct RandomOrbit {
  ZonalGravity field;
  std::vector<double> start;
  double duration;

  Flow<double> flow(int order) const { return {zonal_gravity(field), start, duration, order, {}}; }
};

inline RandomOrbit random_orbit() {
  RandomOrbit orbit;
  orbit.field = {.mu = 1,
                 .radius = *number(0.5, 0.7).as("radius"),
                 .J = {{2, *number(-0.01, 0.01).as("J2")},
                       {3, *number(-0.002, 0.002).as("J3")},
                       {5, *number(-0.001, 0.001).as("J5")}}};
  orbit.start = {*number(0.9, 1.1).as("x"),  *number(-0.2, 0.2).as("y"),
                 *number(-0.3, 0.3).as("z"), *number(-0.3, 0.3).as("px"),
                 *number(0.8, 1.1).as("py"), *number(-0.5, 0.5).as("pz")};
  orbit.duration = *number(0.3, 5).as("duration");
  return orbit;
}

/// A Hamiltonian of one or two degrees of freedom that is neither separable nor polynomial.
template <class Real>
Flow<Real> random_flow(int order) {
  const auto degrees_of_freedom =
      static_cast<std::size_t>(*whole_number(1, 2).as("degrees of freedom"));
  RandomNumbers random(static_cast<unsigned>(*whole_number(0, 1 << 30).as("seed of the system")));
  Flow<Real> flow{random_system(degrees_of_freedom, random), {}, 0, order, {}};
  for (std::size_t i = 0; i < 2 * degrees_of_freedom; ++i) {
    flow.start.emplace_back(*number(-1, 1).as("z" + std::to_string(i)));
  }
  flow.duration = Real(*number(0.1, 1.5).as("duration"));
  return flow;
}

/// The same flow from another start, over another time.
template <class Real>
FlowJet<Real> jet_from(const Flow<Real>& flow, const std::vector<Real>& start, const Real& duration,
                       const GaussSettings& settings = adaptive()) {
  Flow<Real> other = flow;
  other.start = start;
  other.duration = duration;
  return run_gauss(other, settings);
}

template <class Real>
std::vector<Series<Real>> composed(const std::vector<Series<Real>>& outer,
                                   const std::vector<Series<Real>>& inner) {
  return compose(outer, inner);
}

/// The map of all coefficients by magnitude. Composed with another map of magnitudes, it bounds
/// every sum that the composition of the two forms, and therefore its rounding.
template <class Real>
std::vector<Series<Real>> magnitudes(std::vector<Series<Real>> map) {
  using std::abs;
  for (auto& component : map) {
    for (Real& c : component.coefficients()) c = abs(c);
  }
  return map;
}

/// The largest |difference| / bound over all coefficients; if both are zero, the ratio counts as 0.
template <class Real>
double largest_ratio(const std::vector<Series<Real>>& a, const std::vector<Series<Real>>& b,
                     const std::vector<Series<Real>>& bound) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < a[i].size(); ++k) {
      const double difference = std::abs(static_cast<double>(Real(a[i][k] - b[i][k])));
      const double ratio = difference == 0 ? 0 : difference / static_cast<double>(bound[i][k]);
      largest = larger(largest, ratio);
    }
  }
  return largest;
}

}  // namespace hamjet::test
