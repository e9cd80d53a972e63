#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/algebra/truncated_power_series.hpp"
#include "hamjet/detail/algebra/matrix.hpp"
#include "support/magnitude.hpp"

// The Lagrangian two-form of Störmer's rule (Guibout and Bloch, lemma stormer), on a particle in a
// magnetic field: L = |q'|^2/2 + A(q) q' - V(q), for which d^2 L / dq dq' does not vanish. (For
// L = T(q') - V(q) the printed form at k is the right one at k + 1, and nothing tells them apart.)

namespace hamjet {
namespace {

using Number = Series<double>;
using Plane = std::vector<Number>;  // two

/// A and its derivatives: potential[i], and slope[j][i] = dA_i / dq_j.
struct VectorPotential {
  Plane potential;
  std::vector<Plane> slope;
};

VectorPotential vector_potential(const Plane& q) {
  const Number& x = q[0];
  const Number& y = q[1];
  const Number zero = x * 0.0;
  return {{y * y - y * 0.5, x * y + x * 0.7}, {Plane{zero, y + 0.7}, Plane{y * 2.0 - 0.5, x}}};
}

/// grad V for V = (x^4 + y^2)/2 + x y^2 / 3.
Plane force_potential_slope(const Plane& q) {
  return {q[0] * q[0] * q[0] * 2.0 + q[1] * q[1] / 3.0, q[1] + q[0] * q[1] * (2.0 / 3)};
}

/// The next point from two points, and Delta q of both intervals.
struct Step {
  Plane before;        ///< q_(k-1)
  Plane point;         ///< q_k
  Plane after;         ///< q_(k+1)
  Plane slope_before;  ///< Delta q_(k-1)
  Plane slope;         ///< Delta q_k
};

/// D1 L_d(q_k, Delta q_k) - Delta D2 L_d(q_(k-1), Delta q_(k-1)) = 0, which for this L is linear in
/// v = Delta q_k:
///
///   v + A(q_k) - tau (dA/dq)^T v = Delta q_(k-1) + A(q_(k-1)) - tau grad V(q_k) .
Step step(const Plane& before, const Plane& point, double tau) {
  Step result{before, point, {}, {}, {}};
  const VectorPotential old = vector_potential(before);
  const VectorPotential now = vector_potential(point);
  const Plane gradient = force_potential_slope(point);
  Plane right;
  for (std::size_t j = 0; j < 2; ++j) {
    result.slope_before.push_back((point[j] - before[j]) / tau);
    right.push_back(result.slope_before[j] + old.potential[j] - now.potential[j] -
                    gradient[j] * tau);
  }
  const auto entry = [&](std::size_t j, std::size_t i) {
    return now.slope[j][i] * (-tau) + (i == j ? 1.0 : 0.0);
  };
  const Number determinant = entry(0, 0) * entry(1, 1) - entry(0, 1) * entry(1, 0);
  result.slope = {(right[0] * entry(1, 1) - right[1] * entry(0, 1)) / determinant,
                  (right[1] * entry(0, 0) - right[0] * entry(1, 0)) / determinant};
  for (std::size_t j = 0; j < 2; ++j) result.after.push_back(point[j] + result.slope[j] * tau);
  return result;
}

/// du ^ dv as a matrix in the four initial variables.
Matrix<double> wedge(const Number& u, const Number& v) {
  Vector<double> du(4);
  Vector<double> dv(4);
  for (std::size_t i = 0; i < 4; ++i) {
    du(static_cast<Eigen::Index>(i)) = u[u.space().linear_index(i)];
    dv(static_cast<Eigen::Index>(i)) = v[v.space().linear_index(i)];
  }
  return du * dv.transpose() - dv * du.transpose();
}

/// d^2 L_d / dq^i dDelta q^j at (q_(k-1), Delta q_(k-1)) times `first`^i ^ dq_k^j, plus d^2 L_d /
/// dDelta q^i dDelta q^j, which is the unit matrix, times `second`^i ^ dq_k^j.
Matrix<double> two_form(const Step& s, const Plane& first, const Plane& second) {
  const VectorPotential old = vector_potential(s.before);
  Matrix<double> form = Matrix<double>::Zero(4, 4);
  for (std::size_t j = 0; j < 2; ++j) {
    for (std::size_t i = 0; i < 2; ++i) form += old.slope[i][j][0] * wedge(first[i], s.point[j]);
    form += wedge(second[j], s.point[j]);
  }
  return form;
}

// Both first factors belong to k - 1, as theta_k = D2 L_d(q_(k-1), Delta q_(k-1)) dq_k gives; in
// print they are dq_k^i and dDelta q_k^i.
TEST(LagrangianTwoForm, IsPreservedWithFirstFactorsOfTheStepBefore) {
  const double tau = 0.1;
  const auto space = SeriesSpace::create(4, 1);
  Plane before = {Number::variable(space, 0, 0.3), Number::variable(space, 1, -0.2)};
  Plane point = {Number::variable(space, 2, 0.35), Number::variable(space, 3, -0.12)};
  Matrix<double> right_start;
  Matrix<double> printed_start;
  double right_change = 0;
  double printed_change = 0;
  for (int k = 0; k < 50; ++k) {
    const Step s = step(before, point, tau);
    const Matrix<double> right = two_form(s, s.before, s.slope_before);
    const Matrix<double> printed = two_form(s, s.point, s.slope);
    if (k == 0) {
      right_start = right;
      printed_start = printed;
    }
    const auto largest = [](const Matrix<double>& change) {
      return change.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    };
    right_change = test::larger(right_change, largest(right - right_start));
    printed_change = test::larger(printed_change, largest(printed - printed_start));
    before = s.point;
    point = s.after;
  }
  EXPECT_GT(right_start.norm(), 1);
  EXPECT_LE(right_change, 1e-10);
  EXPECT_GT(printed_change, 1e-2);
}

}  // namespace
}  // namespace hamjet
