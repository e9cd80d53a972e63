#include "hamjet/maps/symplecticity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "support/errors.hpp"
#include "support/magnitude.hpp"
#include "support/map.hpp"

namespace hamjet {
namespace {

double worst(const std::vector<SymplecticityDefect>& defects) {
  double result = 0;
  for (const auto& entry : defects) result = test::larger(result, entry.scaled);
  return result;
}

TEST(Symplecticity, OfGaussIsRoundOffAtEveryDegreeAndStep) {
  // The scaled defect is at most 1e-13, however coarse the step.
  const struct {
    int stages;
    double step;
  } runs[] = {{1, 0.01}, {1, 0.1}, {1, 0.3}, {2, 0.05}, {2, 0.5},
              {4, 0.1},  {4, 1.0}, {8, 0.3}, {8, 1.5}};
  for (const auto& run : runs) {
    const auto jet = test::paper_jet<double>(test::paper_orbit().duration, 4,
                                             test::fixed_step(run.stages, run.step));
    const auto defects = test::symplecticity(jet);
    ASSERT_EQ(defects.size(), 4u);
    for (int d = 0; d < 4; ++d) {
      EXPECT_EQ(defects[static_cast<std::size_t>(d)].degree, d);
      EXPECT_LE(defects[static_cast<std::size_t>(d)].scaled, 1e-13)
          << run.stages << " stages, step " << run.step << ", degree " << d;
    }
  }
}

TEST(Symplecticity, OfExtendedRunsIsExtendedRoundOff) {
  const auto jet = test::paper_jet<Extended>(5, 3, test::fixed_step(2, 0.5));
  EXPECT_LE(worst(test::symplecticity(jet)), 1e-31);
}

TEST(Symplecticity, SeesAChangeOfAnyLinearCoefficient) {
  const auto jet = test::paper_jet<double>(test::quarter_period, 3);
  const double before = worst(test::symplecticity(jet));
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 1; k < 7; ++k) {
      auto changed = jet;
      changed[i][k] += 1e-6;
      EXPECT_GT(worst(test::symplecticity(changed)), 1e-9) << i << ", " << k;
    }
  }
  EXPECT_LE(before, 1e-14);
}

TEST(Symplecticity, SeesAChangeAtTheDegreeWhereItIs) {
  const auto jet = test::paper_jet<double>(test::quarter_period, 3);
  const SeriesSpace& space = jet[0].space();
  for (int d = 2; d <= 3; ++d) {
    auto changed = jet;
    changed[1][space.first(d) + 1] += 1e-6;
    const auto defects = test::symplecticity(changed);
    for (int below = 0; below < d - 1; ++below) {
      EXPECT_LE(defects[static_cast<std::size_t>(below)].scaled, 1e-14);
    }
    EXPECT_GT(defects[static_cast<std::size_t>(d - 1)].scaled, 1e-9) << "degree " << d;
    EXPECT_GT(defects[static_cast<std::size_t>(d - 1)].absolute, 1e-8) << "degree " << d;
  }
}

/// One step of Euler's method or of the classical Runge-Kutta method on the jet.
FlowJet<double> explicit_step(const OperationList& field, const FlowJet<double>& z, double h,
                              bool classical) {
  const auto slope = [&](const FlowJet<double>& at) {
    return evaluate_on_series<double>(field, at);
  };
  const auto moved = [](FlowJet<double> from, const FlowJet<double>& by, double factor) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      for (std::size_t k = 0; k < from[i].size(); ++k) from[i][k] += factor * by[i][k];
    }
    return from;
  };
  const auto k1 = slope(z);
  if (!classical) return moved(z, k1, h);
  const auto k2 = slope(moved(z, k1, h / 2));
  const auto k3 = slope(moved(z, k2, h / 2));
  const auto k4 = slope(moved(z, k3, h));
  return moved(moved(moved(moved(z, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
}

TEST(Symplecticity, OfExplicitMethodsFollowsTheStep) {
  auto flow = test::flow_of(test::paper_orbit(), 3);
  const auto problem = test::problem_of(flow);
  const auto run = [&](int count, bool classical) {
    FlowJet<double> jet = starting_jet(problem);
    for (int i = 0; i < count; ++i) {
      jet = explicit_step(flow.system.vector_field, jet, 1.0 / count, classical);
    }
    return worst(test::symplecticity(jet));
  };
  EXPECT_GT(run(50, false), 1e-3);
  // Classical Runge-Kutta is of order 4, and its defect of symplecticity of order 5 a unit of time
  // or so: halving the step divides it by 16 to 32.
  const double coarse = run(10, true);
  const double fine = run(20, true);
  EXPECT_GT(coarse, 1e-9);
  EXPECT_GT(coarse / fine, 12);
  EXPECT_LT(coarse / fine, 40);
}

TEST(Symplecticity, OfKnownMaps) {
  const auto space = SeriesSpace::create(2, 2);
  const auto q = Series<double>::variable(space, 0);
  const auto p = Series<double>::variable(space, 1);
  // A shear is symplectic; stretching by 2 has {2q, 2p} - 1 = 3, of 4 + 1 that cancel.
  const FlowJet<double> shear{q, p - q * q};
  for (const auto& entry : test::symplecticity(shear)) EXPECT_EQ(entry.absolute, 0);
  const FlowJet<double> stretch{2.0 * q, 2.0 * p};
  EXPECT_EQ(test::symplecticity(stretch)[0].absolute, 3);
  EXPECT_EQ(test::symplecticity(stretch)[0].scaled, 3.0 / 5);
  // {q + q p, p} - 1 = p, at degree 1.
  const FlowJet<double> bent{q + q * p, p};
  EXPECT_EQ(test::symplecticity(bent)[0].absolute, 0);
  EXPECT_EQ(test::symplecticity(bent)[1].absolute, 1);
}

TEST(Symplecticity, RefusesJetsInFewerVariables) {
  const auto space = SeriesSpace::create(3, 2);
  const auto x = Series<double>::variable(space, 0);
  const FlowJet<double> jet{x, x};
  test::expect_error(ErrorKind::usage, "2n components", [&] { test::symplecticity(jet); });
  test::expect_error(ErrorKind::usage, "2n components",
                     [&] { test::symplecticity(FlowJet<double>{}); });
}

}  // namespace
}  // namespace hamjet
