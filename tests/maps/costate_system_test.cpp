#include "dynamics/costate_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "hamjet/detail/algebra/monomial_values.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/maps/exactness.hpp"
#include "hamjet/maps/generating_function.hpp"
#include "hamjet/maps/symplecticity.hpp"

namespace hamjet {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Motion relative to a circular orbit in rotating axes (Hill's equations) with the mean motion 1:
/// p = v + (-y, x, 0).
DynamicalSystem clohessy_wiltshire() {
  return make_system("Clohessy-Wiltshire", 3, [](const auto& q, const auto& p) {
    return (square(p[0]) + square(p[1]) + square(p[2])) / 2 + q[1] * p[0] - q[0] * p[1] +
           (square(q[1]) + square(q[2]) - 2 * square(q[0])) / 2;
  });
}

/// The closed form of its transition matrix in (q, v) (Clohessy and Wiltshire 1960).
Matrix6 transition(double t) {
  const double s = std::sin(t);
  const double c = std::cos(t);
  Matrix6 phi;
  phi << 4 - 3 * c, 0, 0, s, 2 * (1 - c), 0,              //
      6 * (s - t), 1, 0, -2 * (1 - c), 4 * s - 3 * t, 0,  //
      0, 0, c, 0, 0, s,                                   //
      3 * s, 0, 0, c, 2 * s, 0,                           //
      -6 * (1 - c), 0, 0, -2 * s, 4 * c - 3, 0,           //
      0, 0, -s, 0, 0, c;
  return phi;
}

/// The controllability Gramian over a time: the integral of Phi(s) B B^T Phi(s)^T.
Matrix6 gramian(double time) {
  Matrix6 sum = Matrix6::Zero();
  using Rule = boost::math::quadrature::gauss<double, 30>;
  for (std::size_t k = 0; k < Rule::abscissa().size(); ++k) {
    for (const double sign : {-1.0, 1.0}) {
      const Matrix6 phi = transition(time / 2 * (1 + sign * Rule::abscissa()[k]));
      sum += Rule::weights()[k] * time / 2 * phi.rightCols<3>() * phi.rightCols<3>().transpose();
    }
  }
  return sum;
}

/// (q, p) from (q, v).
Vector6 with_momenta(Vector6 x) {
  x[3] -= x[1];
  x[4] += x[0];
  return x;
}

FlowJet<double> jet_of(const DynamicalSystem& system, const std::vector<double>& start, int order,
                       double time) {
  const std::size_t dimension = 2 * start.size();
  std::vector<std::size_t> variables;
  for (std::size_t i = 0; i < dimension; ++i) variables.push_back(i);
  std::vector<double> with_costates = start;
  with_costates.resize(dimension);
  const FlowProblem<double> flow = {.system = costate_system(system),
                                    .space = SeriesSpace::create(dimension, order),
                                    .variables = variables,
                                    .initial_state = with_costates,
                                    .start_time = ClockTime::epoch(),
                                    .duration = time};
  GaussSettings settings;
  settings.tolerance = 1e-14;
  IntegrationStatistics statistics;
  return integrate_gauss<double>(flow, settings, statistics);
}

// The least energy between two states of a linear system is d^T W^-1 d / 2 with the Gramian W and
// the distance d of the end from where the start drifts to.
TEST(CostateSystem, EnergyOfALinearSystemIsThatOfItsGramian) {
  const double time = 2.3;
  const FlowJet<double> jet = jet_of(clohessy_wiltshire(), std::vector<double>(6), 2, time);
  const auto inversion = invert_partially(jet, parse_kind("F1", 6));
  const Series<double> cost = generating_function(one_form(inversion));
  MonomialValues values(cost.space_pointer());
  Vector6 start;
  start << 0.3, -0.7, 0.2, 0.1, 0.4, -0.6;
  Vector6 end;
  end << -0.2, 0.5, 0.9, -0.3, 0.2, 0.1;
  const Vector6 p0 = with_momenta(start);
  const Vector6 p1 = with_momenta(end);
  std::vector<double> ends(p1.data(), p1.data() + 6);
  ends.insert(ends.end(), p0.data(), p0.data() + 6);
  values.set_point(ends);
  const Vector6 distance = end - transition(time) * start;
  const double least = distance.dot(gramian(time).ldlt().solve(distance)) / 2;
  // The inversion amplifies the rounding of the flow by its condition.
  const double allowance =
      100 * inversion.amplification * std::numeric_limits<double>::epsilon() * least;
  EXPECT_NEAR(-values.value(cost, 2), least, allowance);
  EXPECT_LT(allowance, 1e-9 * least);
  // A linear system has no further degrees, to rounding.
  for (const Series<double>& series : jet) {
    for (const double c : series.slice(2)) EXPECT_LT(std::abs(c), 1e-13);
  }
}

// Gauss maps are symplectic in states and costates too, about the paper's orbit: to the rounding
// that some hundred operations a step leave in each of the jet's numbers.
TEST(CostateSystem, FlowAboutTheChiefIsSymplectic) {
  ZonalGravity field;
  field.radius = 0.9;
  field.J[2] = 1.082626675e-3;
  field.J[3] = -2.532436e-6;
  const FlowJet<double> jet = jet_of(zonal_gravity(field), {1, 0, 0, 0, 0.6, 0.98}, 3, 4.0);
  for (const SymplecticityDefect& defect : symplecticity_by_degree(jet)) {
    EXPECT_LT(defect.scaled, 1e-13) << "degree " << defect.degree;
  }
  // Inverting amplifies this rounding by its condition, and then the one-form is closed.
  const PartialInversion<double> inversion = invert_partially(jet, parse_kind("F1", 6));
  const std::vector<ExactnessResidual> residuals = exactness_residual(one_form(inversion));
  ASSERT_EQ(residuals.size(), 3U);
  for (const ExactnessResidual& residual : residuals) {
    EXPECT_LT(residual.scaled, 1e-13 * inversion.amplification) << "degree " << residual.degree;
    EXPECT_LT(residual.scaled, 1e-8) << "degree " << residual.degree;
  }
}

// A thrust of least energy that begins without costates stays without: costates have no terms of
// states alone. All else is there: about a generic orbit no other coefficient vanishes.
TEST(CostateSystem, OnlyCostatesOfStatesAloneVanish) {
  ZonalGravity field;
  field.radius = 0.9;
  field.J[2] = 1.082626675e-3;
  field.J[3] = -2.532436e-6;
  const int order = 4;
  const FlowJet<double> jet = jet_of(zonal_gravity(field), {1, 0.1, 0.2, 0, 0.6, 0.98}, order, 4.0);
  const SeriesSpace& space = jet[0].space();
  std::vector<std::size_t> vanishing(order + 1);
  for (std::size_t component = 0; component < 12; ++component) {
    for (std::size_t k = 0; k < space.size(); ++k) {
      const auto exponents = space.exponents(k);
      const bool is_of_states = std::all_of(exponents.begin() + 6, exponents.end(),
                                            [](std::uint8_t exponent) { return exponent == 0; });
      const bool vanishes = component >= 6 && is_of_states;
      EXPECT_EQ(jet[component][k] == 0, vanishes) << component << " " << k;
      if (vanishes) ++vanishing[static_cast<std::size_t>(space.degree(k))];
    }
  }
  // Six costates, and as many monomials in six variables as each degree has.
  EXPECT_EQ(vanishing, (std::vector<std::size_t>{6, 6 * 6, 6 * 21, 6 * 56, 6 * 126}));
}

/// The equation of Hamilton and Jacobi (that of Hamilton, Jacobi and Bellman for minus the least
/// energy) in Kepler's problem: dF1/dT + H = 0, which for ends as deviations from the chief c is
///
///   dF1/dT + lambda . (f(x) - f(c)) - |lambda_v|^2 / 2 = 0
///
/// with lambda = dF1/dx at the end. The rate comes from F1 at four times beside, whose difference
/// errs by the fourth power of their distance.
class HamiltonJacobi {
 public:
  HamiltonJacobi(const std::vector<double>& start, double time, double step) : step_(step) {
    for (const int steps : {-2, -1, 1, 2, 0}) {
      const FlowJet<double> jet = jet_of(kepler(), start, 3, time + steps * step);
      costs_.push_back(generating_function(one_form(invert_partially(jet, parse_kind("F1", 6)))));
      chief_.clear();
      for (std::size_t i = 0; i < 6; ++i) chief_.push_back(jet[i][0]);
    }
  }

  /// What is left over the power of the thrust, for ends of a size, by F1 to degree order + 1.
  double residual(double size, int order) const {
    const std::vector<double> ends = {0.3 * size, -0.2 * size, 0.1 * size, 0.1 * size,
                                      0.2 * size, -0.1 * size, 0.5 * size, -0.6 * size,
                                      0.3 * size, 0.2 * size,  0.1 * size, -0.4 * size};
    MonomialValues values(costs_[0].space_pointer());
    values.set_point(ends);
    std::vector<double> cost;
    for (const Series<double>& one : costs_) cost.push_back(values.value(one, order + 1));
    const double rate = (cost[0] - 8 * cost[1] + 8 * cost[2] - cost[3]) / (12 * step_);
    Vector6 costates;
    std::vector<double> end = chief_;
    for (std::size_t i = 0; i < 6; ++i) {
      costates[static_cast<Eigen::Index>(i)] = values.derivative(costs_[4], i, order + 1);
      end[i] += ends[i];
    }
    const double power = costates.tail<3>().squaredNorm() / 2;
    return std::abs(rate + costates.dot(field(end) - field(chief_)) - power) / power;
  }

 private:
  static Vector6 field(const std::vector<double>& z) {
    const double r = std::hypot(z[0], z[1], z[2]);
    Vector6 f;
    f << z[3], z[4], z[5], -z[0] / (r * r * r), -z[1] / (r * r * r), -z[2] / (r * r * r);
    return f;
  }

  double step_;
  std::vector<double> chief_;
  std::vector<Series<double>> costs_;  // at times -2, -1, 1, 2 steps away, and at the time itself
};

// With F1 to degree k + 1 what is left is of degree k + 2.
TEST(CostateSystem, LeastEnergySolvesHamiltonJacobiByDegree) {
  const HamiltonJacobi equation({1, 0, 0, 0, 0.57, 0.98}, 2, 5e-3);
  for (int order = 1; order <= 3; ++order) {
    EXPECT_NEAR(std::log2(equation.residual(0.04, order) / equation.residual(0.02, order)), order,
                0.3)
        << order;
    if (order == 1) continue;
    EXPECT_LT(equation.residual(0.02, order), 0.1 * equation.residual(0.02, order - 1)) << order;
  }
  EXPECT_LT(equation.residual(0.02, 3), 1e-4);
}

// On ellipses from their pericentre, of 0.3 to 4.6 revolutions and of two sizes: thirty transfers.
// What is left falls with each order until it is rounding, which the inversion amplifies: at e =
// 0.74 and several revolutions to a part in a thousand.
TEST(CostateSystem, LeastEnergySolvesHamiltonJacobiOnThirtyTransfers) {
  for (const double e : {0.001, 0.3, 0.74}) {
    const double speed = std::sqrt(1 + e);
    for (const double revolutions : {0.3, 0.7, 1.3, 2.7, 4.6}) {
      const double time = 2 * std::numbers::pi * revolutions * std::pow(1 - e, -1.5);
      const HamiltonJacobi equation({1, 0, 0, 0, 0.6 * speed, 0.8 * speed}, time, 2e-3);
      const bool is_amplified = e > 0.5 && revolutions > 2;
      const double rounding = is_amplified ? 1e-3 : 1e-8;
      for (const double size : {1e-5, 1e-3}) {
        SCOPED_TRACE(::testing::Message() << e << " " << revolutions << " " << size);
        EXPECT_LT(equation.residual(size, 1), 10 * size);
        for (int order = 2; order <= 3; ++order) {
          EXPECT_LT(equation.residual(size, order),
                    0.1 * equation.residual(size, order - 1) + rounding)
              << order;
        }
      }
    }
  }
}

TEST(CostateSystem, RefusesParameters) {
  DynamicalSystem system = clohessy_wiltshire();
  system.parameters = 1;
  EXPECT_THROW(costate_system(system), Error);
}

}  // namespace
}  // namespace hamjet
