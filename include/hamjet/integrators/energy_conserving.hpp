#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

// Energy-conserving symplectic methods: time is a coordinate, and the step size is an unknown of
// each step beside the state (Guibout and Bloch, section "Energy conservation"). Neighbouring
// trajectories take different steps, so that the map at a fixed physical time is not symplectic.
// The methods therefore integrate trajectories, not jets.

/// The discretization of the generalized principles.
enum class EnergyConservingMethod {
  stormer,   ///< eqs. `m_l_stormer`, `m_h_stormer`, corrected: discrete energy H(q_k, p_(k+1))
  midpoint,  ///< eqs. `m_l_midpoint`, `m_h_midpoint`, corrected: H at the mean of z_k and z_(k+1)
};

/// The names of EnergyConservingMethod in scenes, in the order of the enumeration.
const std::vector<std::string_view>& energy_conserving_method_names();

/// The problem that integrate_energy_conserving solves; all numbers are in the system's own units.
/// Real is double or Extended.
template <class Real>
struct EnergyConservingProblem {
  SharedSystem system;
  EnergyConservingMethod method = EnergyConservingMethod::midpoint;
  std::vector<Real> initial_state;  ///< (q, p), 2n numbers
  /// Size of the first step, positive. The discrete energy E of the first step is the one that all
  /// other steps conserve. E differs from H(z_0), for which the step size would be 0.
  Real first_step = 0;
  /// The time to cover; if negative, time runs backwards. The last step ends at this time or
  /// beyond: no step is shortened.
  Real duration = 0;
};

/// One step that was taken.
template <class Real>
struct EnergyConservingStep {
  long index = 0;           ///< number of the step, from 0
  Real time = 0;            ///< time at its start
  Real size = 0;            ///< negative if the time runs backwards
  std::vector<Real> start;  ///< z_k
  std::vector<Real> end;    ///< z_(k+1)
  Real condition = 0;       ///< StepCondition at the start of the step
  int newton_iterations = 0;
};

/// Called after every step. It may throw to stop.
template <class Real>
using EnergyConservingObserver = std::function<void(const EnergyConservingStep<Real>& step)>;

/// The reason why there is no next step.
enum class EnergyConservingStopCause {
  no_root,            ///< the step equation has no real root near the last step size
  reversed_root,      ///< the root that continues the last step size points backwards in time
  step_change,        ///< the continuing root is not within a factor of largest_step_change
  undetermined_step,  ///< round-off leaves the step size undetermined
  no_midpoint,        ///< the midpoint equation has no solution for the first step
  not_finite,         ///< a collision, or a point outside the domain of the Hamiltonian
};

/// Largest ratio of two successive step sizes, in either order. A step beyond it is refused: it
/// belongs to another root of the step equation, or the steps are too large for their equation. To
/// leading order a step of the midpoint form can at most double before the root is lost, see
/// EnergyConservingStop.
inline constexpr double largest_step_change = 2;

/// An integration of more steps than this is refused with Error(too_large).
inline constexpr double largest_energy_conserving_step_count = 1e7;

/// The place where an integration ended before its time, which is a numerical failure
/// (ErrorKind::numerical).
///
/// With x = steps_to_sign_change the step equations have no root, to leading order in the step
/// size, for midpoint where 4 x^3 - 3 x - 1 < 0, so x < 1; and for Störmer before a maximum of V
/// where |s^2 x - 1| < s, s^2 = -(d^2V/dt^2) / (g^T M^-1 g) (on a Kepler orbit at apogee s^2 = e).
/// A step of midpoint from x just above 1 leads to x = -1/2, so that the integration stops between
/// these two values.
struct EnergyConservingStop {
  EnergyConservingStopCause cause = EnergyConservingStopCause::no_root;
  long step = 0;         ///< number of the step that could not be taken, from 0
  double time = 0;       ///< time at its start
  double condition = 0;  ///< StepCondition at its start
  /// Where StepCondition changes sign, in steps of the last size, extrapolated by the line through
  /// its values at the start of the step and one step size later; negative if this place lies
  /// behind. No value if StepCondition is constant.
  std::optional<double> steps_to_sign_change;
  std::string message;  ///< one line that names step, time and condition
};

/// The outcome of an integration.
template <class Real>
struct EnergyConservingResult {
  Real energy = 0;  ///< E, the conserved discrete energy
  long steps = 0;   ///< number of steps taken
  long newton_iterations = 0;
  Real last_step = 0;       ///< size of the last step taken, or of the first one if none was taken
  Real time = 0;            ///< time that was reached
  std::vector<Real> state;  ///< state that was reached
  std::optional<EnergyConservingStop> stop;
};

/// Integrates with time as a coordinate. Step k solves, with z = (q, p) and V, M from H = p^T M^-1
/// p / 2 + V(q) for Störmer,
///
///   Störmer:   p_(k+1) = p_k - h grad V(q_k),   q_(k+1) = q_k + h M^-1 p_(k+1),
///              H(q_k, p_(k+1)) = E;
///   midpoint:  z_(k+1) - z_k = h J grad H(z_m),   z_m = (z_k + z_(k+1))/2,   H(z_m) = E
///
/// for the 2n + 1 unknowns (z_(k+1), h) by Newton's method, to round-off: E is conserved to a few
/// units in the last place. To leading order the step size varies as |c|^(-1/2) for Störmer and
/// |c|^(-1/3) for midpoint, where c is StepCondition. No step can cross a sign change of c; the
/// integration stops there. For midpoint, h itself is determined only to about 4 eps / (h^2 c).
///
/// The root that is taken is always the one that continues the last step size. For Störmer it is
/// the smaller root of a quadratic; for midpoint it is the root at which H(z_m(h)) - E falls or
/// rises as in the first step. Where Newton's method does not find it, all step sizes within a
/// factor of largest_step_change of the last are searched before the integration stops.
///
/// The midpoint form has order 2 and is symmetric, the Störmer form has order 1. Sources: Guibout
/// and Bloch, section "Energy conservation"; Shibberu, "Time-discretization of Hamiltonian
/// dynamical systems" (1994); Kane, Marsden and Ortiz, "Symplectic-energy-momentum preserving
/// variational integrators" (1999). Throws Error(usage) if sizes do not fit, the first step is not
/// positive, or Störmer meets a system without second-order form; Error(too_large) for too many
/// steps. An early end of the integration is not an exception; it is reported in
/// EnergyConservingResult::stop.
template <class Real>
EnergyConservingResult<Real> integrate_energy_conserving(
    const EnergyConservingProblem<Real>& problem,
    const EnergyConservingObserver<Real>& observer = {});

/// The point of phase space at which the Hamiltonian equals the discrete energy of a step: (q_k,
/// p_(k+1)) for Störmer, the mean of z_k and z_(k+1) for midpoint.
template <class Real>
std::vector<Real> discrete_energy_point(EnergyConservingMethod method,
                                        const std::vector<Real>& start,
                                        const std::vector<Real>& end);

/// A function of the state; where it changes sign along a trajectory, the method stops. With g =
/// grad V and f = J grad H,
///
///   Störmer:   g^T M^-1 p = dV/dt ,
///   midpoint:  G = f^T H'' f = p^T M^-1 V'' M^-1 p + g^T M^-1 g ,
///
/// where the second form of G holds for H = p^T M^-1 p / 2 + V(q).
template <class Real>
class StepCondition {
 public:
  StepCondition(const DynamicalSystem& system, EnergyConservingMethod method);
  ~StepCondition();
  Real operator()(const std::vector<Real>& state);

 private:
  class Evaluation;
  std::unique_ptr<Evaluation> evaluation_;
};

}  // namespace hamjet
