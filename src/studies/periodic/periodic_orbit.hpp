#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/algebra/matrix.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

// Periodic orbits of autonomous Hamiltonian systems by multiple shooting, with the period as an
// unknown. The equations "the arcs join, the last ends where the first begins, the start moves
// across the flow" are one more than the unknowns, because the energy is kept; they have solutions
// all the same, which a Gauss-Newton method by singular values finds with quadratic convergence
// (F. J. Munoz-Almaraz and others, Physica D 181 (2003) 1). Solutions form curves, and a quantity
// that is held, or the place along the curve, picks one.

namespace hamjet {

/// What one number is held at, or runs along, among the solutions.
struct OrbitQuantity {
  enum class Kind { energy, period, variable, parameter };
  Kind kind = Kind::energy;
  std::size_t variable = 0;  ///< index into (q, p), of a variable
};

/// A system, which may have a parameter, and how its flights are integrated.
struct PeriodicProblem {
  /// The system for a value of the parameter.
  std::function<SharedSystem(double parameter)> system;
  bool has_parameter = false;  ///< whether the parameter is an unknown
  GaussSettings gauss;
  std::size_t arcs = 4;
  OrbitQuantity held;  ///< for a single orbit; in a family along a parameter for each member
  double value = 0;    ///< the value at which that quantity is held
  /// Above which mismatch of arcs, in parts of the sizes of positions and momenta, an orbit is
  /// none.
  double tolerance = 1e-10;
};

/// Starts of the arcs, a period and a parameter: a solution or a guess.
struct OrbitNodes {
  std::vector<Vector<double>> states;
  double period = 0;
  double parameter = 0;
};

/// The linear part of one turn, and what is known from it.
struct Monodromy {
  Matrix<double> matrix;  ///< 2n x 2n, from the start to its return
  /// The n - 1 stability indices (lambda + 1/lambda)/2 of the multipliers but the pair 1 that every
  /// orbit has; the index of largest size first, in a family in the order of the member before.
  std::vector<std::complex<double>> indices;
  /// The multiplier of each index that lies on or outside the unit circle; if it lies on the
  /// circle, its imaginary part is at least 0.
  std::vector<std::complex<double>> multipliers;
  double determinant_defect = 0;  ///< |det M - 1|
  double symplectic_defect = 0;   ///< largest entry of M^T J M - J
  /// By how much the flow's direction f and the energy's gradient g are no eigenvectors of the
  /// multiplier 1: the larger of |M f - f|/|f| and |M^T g - g|/|g|.
  double trivial_defect = 0;

  /// Whether all multipliers lie on the unit circle, to the accuracy of the trivial pair.
  bool is_stable() const;
};

/// A periodic orbit.
struct PeriodicOrbit {
  OrbitNodes nodes;
  double energy = 0;
  double mismatch = 0;  ///< largest mismatch of the arcs' ends, in parts of the sizes
  double closing =
      0;  ///< by how much one flight from the start fails to close, in parts of the sizes
  int iterations = 0;  ///< iterations of Newton's method
  Monodromy monodromy;

  const Vector<double>& start() const { return nodes.states.front(); }
};

/// The quantity of an orbit's nodes.
double quantity_of(const PeriodicProblem& problem, const OrbitQuantity& quantity,
                   const OrbitNodes& nodes);

/// The value and gradient of the Hamiltonian at a state.
struct EnergyGradient {
  double energy = 0;
  Vector<double> gradient;
  Vector<double> field() const;  ///< J times the gradient
};
EnergyGradient energy_gradient(const DynamicalSystem& system, const Vector<double>& state);

/// Nodes on one flight from a start over a period. Throws as integrate_gauss.
OrbitNodes flown_nodes(const PeriodicProblem& problem, const Vector<double>& start, double period,
                       double parameter);

/// The multipliers of a turn from `start`, whose linear part is `matrix`. `sizes` are the units of
/// (q, p) in which defects are told: one of all positions, and one of all momenta.
Monodromy monodromy_of(const DynamicalSystem& system, const Vector<double>& start,
                       Matrix<double> matrix, const Vector<double>& sizes);

/// The periodic orbit near a guess at which the problem's quantity is held; of an orbit that is a
/// shorter one several times round, up to six, the shorter one. Throws Error(numerical) where the
/// search does not converge, or ends at an equilibrium, and as integrate_gauss.
PeriodicOrbit find_periodic_orbit(const PeriodicProblem& problem, const OrbitNodes& guess);

/// How a family is followed.
struct FamilyPath {
  OrbitQuantity along;
  double to = 0;    ///< the last member's value of it
  double step = 0;  ///< step of that quantity between members, where the family has no fold
  std::size_t most_members = 200;
};

/// A member, and what happens between the member before and this one: folds and bifurcations, in
/// words; empty for nothing.
struct FamilyMember {
  PeriodicOrbit orbit;
  double along = 0;
  std::string mark = {};
};

struct PeriodicFamily {
  std::vector<FamilyMember> members;
  /// Why the last member is not at `to`; empty if it is.
  std::string end = {};
  bool is_failure = false;  ///< whether that is because the search failed
};

/// The family of an orbit by pseudo-arclength continuation. Throws Error(numerical) where the orbit
/// is on no single curve of periodic orbits, or the quantity does not change along it.
PeriodicFamily follow_family(const PeriodicProblem& problem, const PeriodicOrbit& first,
                             const FamilyPath& path, const std::function<void(double)>& progress);

}  // namespace hamjet
