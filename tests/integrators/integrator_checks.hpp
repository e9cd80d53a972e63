#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "support/map.hpp"
#include "support/random_series.hpp"

// Tests that several integrators share, on the same flows. `integrate` is called with a problem and
// a step.

namespace hamjet::test {

/// The flow from the start of the paper's orbit, in any field.
template <class Real = double>
FlowProblem<Real> orbit_problem(const DynamicalSystem& system, int order, double duration) {
  const std::vector<double>& start = paper_orbit().start;
  return {system,
          SeriesSpace::create(6, order),
          {0, 1, 2, 3, 4, 5},
          {start.begin(), start.end()},
          ClockTime::epoch(),
          Real(duration)};
}

/// The distance of the state and of the matrix's first column from those of the paper's orbit after
/// its time; the column's is relative to its largest entry.
inline double paper_orbit_error(const FlowJet<double>& jet) {
  const double state[] = {0.766193477722799312, -0.377383325619903653, -0.643494936008871042,
                          0.612704207756633850, 0.442268657796718223,  0.773489074513720723};
  const double column[] = {-82.9039186170813560, -60.9735264196907293, -106.657871345703589,
                           85.0485072235083642,  -42.0503868872173724, -71.9061898804517261};
  double error = 0;
  for (std::size_t c = 0; c < 6; ++c) {
    error = larger(error, std::abs(jet[c][0] - state[c]));
    error = larger(error, std::abs(jet[c][1] - column[c]) / 106.7);
  }
  return error;
}

/// The jet over no time is exactly the identity.
inline void expect_identity(const FlowJet<double>& jet, const std::vector<double>& start) {
  for (std::size_t c = 0; c < jet.size(); ++c) {
    for (std::size_t k = 0; k < jet[c].size(); ++k) {
      EXPECT_EQ(jet[c][k], k == 0 ? start[c] : k == 1 + c ? 1 : 0);
    }
  }
}

/// A jet out and one back from its end: the nominal returns to the start, and the product of their
/// matrices is the identity.
inline void expect_return(const FlowJet<double>& out, const FlowJet<double>& home,
                          const std::vector<double>& start, double state_tolerance,
                          double matrix_tolerance) {
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(home[i][0], start[i], state_tolerance);
    for (std::size_t j = 0; j < 6; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 6; ++k) sum += home[i][1 + k] * out[k][1 + j];
      EXPECT_NEAR(sum, i == j ? 1 : 0, matrix_tolerance);
    }
  }
}

/// The method with equal steps on the paper's orbit forwards and then backwards from where it
/// ended, order 3, minus the identity; largest coefficient, relative to the terms that are summed.
template <class Integrate>
double return_error(const Integrate& integrate, double duration, double step) {
  auto flow = flow_of(paper_orbit(), 3);
  flow.duration = duration;
  auto there = integrate(problem_of(flow), step);
  const auto identity = starting_jet(problem_of(flow));
  flow.start = final_state(there);
  flow.duration = -duration;
  auto back = integrate(problem_of(flow), step);
  const auto both = chained(back, there);
  for (auto* jet : {&back, &there}) {
    for (auto& u : *jet) {
      for (auto& c : u.coefficients()) c = std::abs(c);
    }
  }
  const auto terms = chained(back, there);
  double result = 0;
  for (int d = 0; d <= 3; ++d) {
    const double scale = largest_of_degree(terms, d);
    for (std::size_t i = 0; i < 6; ++i) {
      result = larger(result, largest_of_degree(both[i] - identity[i], d) / scale);
    }
  }
  return result;
}

/// Sizes of steps and, for each degree, the errors with these steps.
struct Convergence {
  std::vector<double> steps;
  std::vector<std::vector<double>> errors;
};

/// The errors of a method with these numbers of equal steps.
template <class Real, class Integrate>
Convergence convergence(const Flow<Real>& flow, const FlowJet<Real>& expected,
                        const std::vector<int>& counts, const Integrate& integrate) {
  Convergence result;
  result.errors.resize(static_cast<std::size_t>(flow.order) + 1);
  for (const int n : counts) {
    const double step = static_cast<double>(flow.duration) / n;
    result.steps.push_back(step);
    const auto jet = integrate(problem_of(flow), step);
    for (int d = 0; d <= flow.order; ++d) {
      result.errors[static_cast<std::size_t>(d)].push_back(relative_error(jet, expected, d));
    }
  }
  return result;
}

/// q and p of an oscillator of mass 2 and stiffness 0.5 (frequency 1/2), from q = 0.3, p = -0.7.
template <class Real = double>
FlowProblem<Real> oscillator_problem(const DynamicalSystem& system, double duration) {
  return {
      system,        SeriesSpace::create(2, 3), {0, 1}, {Real(0.3), Real(-0.7)}, ClockTime::epoch(),
      Real(duration)};
}

/// The closed form of this oscillator, with m w = 1: q = q0 cos wt + p0 sin wt, p = p0 cos wt - q0
/// sin wt, and the same rotation at degree 1; a linear flow has no higher degrees.
template <class Real>
void expect_rotation(const FlowJet<Real>& jet, double duration, double tolerance) {
  using std::abs;
  using std::cos;
  using std::sin;
  const Real angle = Real(duration) / 2;
  const Real c = cos(angle);
  const Real s = sin(angle);
  const Real q0 = 0.3;
  const Real p0 = -0.7;
  const std::vector<Real> expected_q{q0 * c + p0 * s, c, s};
  const std::vector<Real> expected_p{p0 * c - q0 * s, -s, c};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LE(static_cast<double>(abs(jet[0][k] - expected_q[k])), tolerance) << k;
    EXPECT_LE(static_cast<double>(abs(jet[1][k] - expected_p[k])), tolerance) << k;
  }
  for (std::size_t k = 3; k < jet[0].size(); ++k) {
    EXPECT_EQ(jet[0][k], 0);
    EXPECT_EQ(jet[1][k], 0);
  }
}

}  // namespace hamjet::test
