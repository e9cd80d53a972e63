// A Hamiltonian that hamjet does not know, from its formula to an answer: the circular restricted
// three-body problem, about an orbit around the point L1 between Earth and Moon. With which change
// of velocity does a spacecraft that starts on the orbit arrive 100 km beside it?

#include <cmath>
#include <cstdio>
#include <hamjet/error.hpp>
#include <hamjet/integrators/gauss_collocation.hpp>
#include <hamjet/maps/exactness.hpp>
#include <hamjet/maps/map_evaluator.hpp>
#include <span>
#include <vector>

namespace {

/// In the frame that turns with the two bodies; their distance, the sum of their masses and the
/// frame's rate are 1:
///
///   H = |p|^2/2 + y px - x py - (1 - mu)/r1 - mu/r2 .
struct RestrictedThreeBody {
  double mu = 0.01215058560962404;  ///< the Moon's share of the mass

  template <class T>
  T operator()(std::span<const T> q, std::span<const T> p) const {
    const T across = q[1] * q[1] + q[2] * q[2];
    const T from_earth = q[0] + T(mu);
    const T from_moon = q[0] - T(1 - mu);
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / T(2) + q[1] * p[0] - q[0] * p[1] -
           T(1 - mu) / sqrt(from_earth * from_earth + across) -
           T(mu) / sqrt(from_moon * from_moon + across);
  }
};

constexpr double length_km = 384400;
constexpr double velocity_km_s = 1.0245;
constexpr double duration = 1.37;  // six days, half a revolution about L1

/// The jet of the flow to an order; order 0 flies one trajectory.
hamjet::FlowJet<double> fly(const hamjet::DynamicalSystem& system, std::vector<double> start,
                            int order) {
  const hamjet::FlowProblem<double> problem{system,
                                            hamjet::SeriesSpace::create(6, order),
                                            {0, 1, 2, 3, 4, 5},
                                            std::move(start),
                                            hamjet::ClockTime::epoch(),
                                            duration};
  hamjet::IntegrationStatistics statistics;
  return hamjet::integrate_gauss<double>(problem, {.stages = 8, .tolerance = 1e-14}, statistics);
}

int study() {
  const auto system = hamjet::make_system("restricted-three-body", 3, RestrictedThreeBody{});
  // At rest along x in the turning frame, where px = x' - y and py = y' + x.
  const double x = 0.8234;
  const std::vector<double> start = {x, 0, 0.01, 0, 0.1263 + x, 0};
  const auto jet = fly(system, start, 5);

  // F1(q, q0), whose derivatives are the momenta at both ends. It exists because the integrator is
  // symplectic: its one-form is closed, to round-off.
  const auto inversion = hamjet::invert_partially<double>(jet, hamjet::parse_kind("F1", 3));
  const auto one_form = hamjet::one_form(inversion);
  double residual = 0;
  for (const auto& degree : hamjet::exactness_residual(one_form)) {
    std::printf("exactness residual of degree %d: %.1e\n", degree.degree, degree.scaled);
    residual = std::max(residual, degree.scaled);
  }
  const auto f1 = hamjet::generating_function(one_form);
  std::printf("F1: %zu coefficients, condition %.2g\n", f1.size(), inversion.condition);

  // The wanted deviation of q at the end, then that of q0, which is none. The one-form is
  // (p, -p0).
  const double aside = 100 / length_km;
  const std::vector<double> places = {0, aside, 0, 0, 0, 0};
  double worst = 0;
  for (const int degree : {1, 5}) {
    std::vector<double> momenta(6);
    hamjet::MapEvaluator(one_form, degree).evaluate(places, {.values = momenta});
    std::vector<double> neighbour = start;
    for (std::size_t i = 0; i < 3; ++i) neighbour[3 + i] -= momenta[3 + i];
    const auto end = fly(system, neighbour, 0);
    double miss = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      miss = std::hypot(miss, end[i].constant() - jet[i].constant() - places[i]);
    }
    std::printf("order %d: a change of %.6f m/s, which when flown misses by %.3g m\n", degree,
                1000 * velocity_km_s * std::hypot(momenta[3], momenta[4], momenta[5]),
                1000 * length_km * miss);
    worst = 1000 * length_km * miss;
  }
  return residual < 1e-10 && worst < 1 ? 0 : 1;
}

}  // namespace

int main() {
  try {
    return study();
  } catch (const hamjet::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return error.exit_code();
  }
}
