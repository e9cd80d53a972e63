#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "dynamics/double_well.hpp"
#include "dynamics/harmonic_oscillator.hpp"
#include "hamjet/integrators/energy_conserving.hpp"
#include "support/flow.hpp"

namespace hamjet::test {

/// A trajectory by an energy-conserving method, with all of its steps.
template <class Real>
struct EnergyConservingRun {
  EnergyConservingResult<Real> result;
  std::vector<EnergyConservingStep<Real>> steps;
};

template <class Real>
EnergyConservingRun<Real> run_energy_conserving(const EnergyConservingProblem<Real>& problem) {
  EnergyConservingRun<Real> run;
  run.result = integrate_energy_conserving<Real>(
      problem, [&](const EnergyConservingStep<Real>& step) { run.steps.push_back(step); });
  return run;
}

/// The given number of steps, forwards or (direction -1) backwards in time.
template <class Real>
EnergyConservingRun<Real> take_steps(EnergyConservingProblem<Real> problem, std::size_t count,
                                     int direction = 1) {
  struct Enough {};
  EnergyConservingRun<Real> run;
  problem.duration = Real(direction * 1e6);
  try {
    integrate_energy_conserving<Real>(problem, [&](const EnergyConservingStep<Real>& step) {
      run.steps.push_back(step);
      if (run.steps.size() == count) throw Enough();
    });
  } catch (const Enough&) {
  }
  return run;
}

/// The Kepler orbit of eccentricity e with perigee at (1, 0, 0), mu = 1, at a true anomaly.
inline std::vector<double> kepler_state(double e, double true_anomaly) {
  const double cosine = std::cos(true_anomaly);
  const double sine = std::sin(true_anomaly);
  const double r = (1 + e) / (1 + e * cosine);
  const double v = 1 / std::sqrt(1 + e);
  return {r * cosine, r * sine, 0, -v * sine, v * (e + cosine), 0};
}
inline double kepler_period(double e) { return 2 * M_PI / std::pow(1 - e, 1.5); }

/// The Hamiltonian in extended precision.
inline Extended exact_energy(const DynamicalSystem& system, const std::vector<Extended>& z) {
  return energy<Extended>(system, z);
}
inline std::vector<Extended> widened(const std::vector<double>& z) { return {z.begin(), z.end()}; }

}  // namespace hamjet::test
