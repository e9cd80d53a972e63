#include "hamjet/integrators/midpoint.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <limits>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/error.hpp"
#include "real_number.hpp"

namespace hamjet {
namespace {

/// Twice the number of iterations that quadratic convergence needs to reach round-off from a start
/// with an error of a quarter.
constexpr int largest_iteration_count = 14;

template <class Real>
Real largest_entry(const Vector<Real>& v) {
  Real largest = 0;
  for (const Real& x : v) {
    if (!is_finite(x)) return x;
    largest = std::max(largest, magnitude(x));
  }
  return largest;
}

template <class Real>
[[noreturn]] void fail(const char* why, const Real& tau) {
  throw Error(ErrorKind::numerical, fmt::format("midpoint: a step of {:.6g} has no solution: {}",
                                                static_cast<double>(tau), why));
}

}  // namespace

template <class Real>
Vector<Real> midpoint_step(DifferentiableHamiltonian<Real>& hamiltonian, const Vector<Real>& z,
                           const Real& tau) {
  const Eigen::Index size = hamiltonian.dimension();
  if (z.size() != size) {
    throw Error(ErrorKind::usage, fmt::format("midpoint: the state has {} components, the "
                                              "Hamiltonian takes {}",
                                              z.size(), size));
  }
  using std::sqrt;
  const Real epsilon = std::numeric_limits<Real>::epsilon();
  // Newton's method converges quadratically: below this size, changes that stop shrinking are
  // round-off.
  const Real stagnation = sqrt(epsilon);
  const Eigen::Index n = size / 2;
  Vector<Real> increment = Vector<Real>::Zero(size);
  Matrix<Real> matrix(size, size);
  Eigen::PartialPivLU<Matrix<Real>> factors(size);
  Real previous = 0;
  for (int iteration = 0; iteration < largest_iteration_count; ++iteration) {
    const auto& at_middle = hamiltonian.derivatives(z + increment / Real(2));
    matrix.topRows(n) = at_middle.hessian.bottomRows(n) * Real(-tau / 2);
    matrix.bottomRows(n) = at_middle.hessian.topRows(n) * Real(tau / 2);
    matrix.diagonal().array() += Real(1);
    factors.compute(matrix);
    // The determinant is 1 for tau = 0 and changes sign only where the solution connected to tau =
    // 0 ends. This test is the same in all canonical coordinates, as Newton's iterates are (the
    // test of a norm would not be).
    if (!(factors.determinant() > 0)) {
      fail("it is longer than the way to a singular point; a shorter step would do", tau);
    }
    const Vector<Real> change =
        factors.solve(symplectic_unit_times(at_middle.gradient) * tau - increment);
    const Real moved = largest_entry(change);
    if (!is_finite(moved)) {
      fail("the equation is not finite (a collision, or a point outside the domain)", tau);
    }
    increment += change;
    const Real scale = std::max(largest_entry(z), largest_entry(increment));
    const bool is_stagnant = moved <= stagnation * scale && 4 * moved > previous;
    if (moved <= epsilon * scale / 4 || (iteration > 0 && is_stagnant)) return z + increment;
    previous = moved;
  }
  fail("Newton's method does not converge from its start; a shorter step would do", tau);
}

template Vector<InstantiatedReal> midpoint_step(DifferentiableHamiltonian<InstantiatedReal>&,
                                                const Vector<InstantiatedReal>&,
                                                const InstantiatedReal&);

}  // namespace hamjet
