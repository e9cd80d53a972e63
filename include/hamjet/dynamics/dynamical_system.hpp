#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hamjet/detail/dynamics/expression.hpp"
#include "hamjet/detail/dynamics/operation_list.hpp"

namespace hamjet {

/// The second-order structure q' = M^-1 p, p' = F(q, t) with a constant mass matrix M.
struct SecondOrderForm {
  std::vector<Extended> inverse_mass;  ///< n x n, by rows
  OperationList force;  ///< n inputs q, and the time where the system has it; n outputs F
};

/// A quantity that the flow keeps.
enum class ConservedQuantity {
  none,
  energy,           ///< H, of a system without time
  jacobi_integral,  ///< H - omega L, see UniformRotation
};

/// The rotation, at a constant rate omega, in which all dependence of a Hamiltonian on the time
/// consists: H(R(omega s) z, t + s) = H(z, t), where R turns each plane of positions, and that of
/// their momenta, by the same angle. The flow then keeps Jacobi's integral H - omega L with the
/// angular momentum L = sum over the planes of q_i p_j - q_j p_i.
struct UniformRotation {
  std::vector<std::array<std::size_t, 2>> planes;  ///< planes (i, j) of positions
  Extended rate = 0;                               ///< omega
};

/// A system with n degrees of freedom, z = (q_1..q_n, p_1..p_n), and
///
///   q' = dH/dp ,   p' = -dH/dq + F(q, p, t) ,   c' = 0 .
///
/// It is Hamiltonian unless it has forces F that come from no potential, such as drag; see
/// with_force. The state may end with parameters c, quantities that a flow keeps and that differ
/// from one spacecraft to another: jets may be expanded in them. A system whose forces do not
/// depend on the time is autonomous; the lists of all others have the time as their last input.
struct DynamicalSystem {
  std::string name;
  std::size_t degrees_of_freedom = 0;
  std::size_t parameters = 0;  ///< the number k of parameters c, the last numbers of the state
  OperationList hamiltonian;   ///< 2n + k inputs (and the time), 1 output
  OperationList vector_field;  ///< 2n + k inputs (and the time), 2n + k outputs
  bool is_hamiltonian = true;  ///< whether all forces are those of the Hamiltonian
  std::optional<SecondOrderForm> second_order;  ///< set where the vector field has this structure
  /// The largest number of waves that the field has along a circle about the origin of the
  /// positions, for example the highest degree of a gravity field; 0 where no such wave is known.
  /// Adaptive Gauss methods take no step that samples the shortest wave too coarsely.
  int waves_on_a_circle = 0;
  /// Planes (i, j) of coordinates of z that may all be turned by one angle, z_i to c z_i - s z_j
  /// and z_j to s z_i + c z_j, without changing the Hamiltonian. Both coordinates of a plane are
  /// positions or both are momenta, and to each plane of positions belongs that of their momenta.
  /// If the list is empty, no such rotation is known. Integrators leave the rotation out and put it
  /// back exactly; with_rotation declares one.
  std::vector<std::array<std::size_t, 2>> rotated_planes;
  /// The rotation of which the dependence on the time consists, where that is known;
  /// with_uniform_rotation declares it.
  std::optional<UniformRotation> uniform_rotation;
  /// The times of the clock, ascending, at which the forces have no derivatives, such as the edges
  /// of a shadow. Methods that choose their steps end one at each of them; equal steps do not.
  std::vector<double> break_times;

  /// The length of a state, 2n + k.
  std::size_t dimension() const noexcept { return 2 * degrees_of_freedom + parameters; }
  /// Whether the system does not depend on the time. The flow then commutes with shifts in time,
  /// and that of a Hamiltonian system keeps the energy.
  bool is_autonomous() const noexcept { return !hamiltonian.has_time(); }
  ConservedQuantity conserved_quantity() const noexcept {
    if (!is_hamiltonian) return ConservedQuantity::none;
    if (is_autonomous()) return ConservedQuantity::energy;
    return uniform_rotation ? ConservedQuantity::jacobi_integral : ConservedQuantity::none;
  }

  /// What an integrator evaluates: the force alone where there is a second-order form.
  const OperationList& evaluated_list() const noexcept {
    return second_order ? second_order->force : vector_field;
  }
};

/// A system in shared ownership that cannot change: copies are cheap, refer to the same system, and
/// keep it alive. It is made from a system by value, so that it cannot outlive a local variable or
/// temporary that it refers to.
class SharedSystem {
 public:
  SharedSystem() = default;  ///< refers to no system
  /// Implicit, so that a system can be given wherever a shared one is expected. The system is
  /// copied unless it is moved from.
  // NOLINTNEXTLINE(google-explicit-constructor)
  SharedSystem(DynamicalSystem system)
      : system_(std::make_shared<const DynamicalSystem>(std::move(system))) {}

  explicit operator bool() const noexcept { return system_ != nullptr; }
  const DynamicalSystem& operator*() const noexcept { return *system_; }
  const DynamicalSystem* operator->() const noexcept { return system_.get(); }

 private:
  std::shared_ptr<const DynamicalSystem> system_;
};

/// A Hamiltonian written as a template over its number type: `h(q, p)` with spans of n numbers.
template <class Function>
concept HamiltonianFunction = requires(const Function& h, std::span<const Expression> x) {
  { h(x, x) } -> std::convertible_to<Expression>;
};

/// A Hamiltonian that depends on the time: `h(q, p, t)`.
template <class Function>
concept TimeDependentHamiltonian = requires(const Function& h, std::span<const Expression> x,
                                            const Expression& t) {
  { h(x, x, t) } -> std::convertible_to<Expression>;
};

/// Builds a system from the list of its Hamiltonian; the vector field is derived from it unless it
/// is given. The last `parameters` inputs before the time are parameters. Where nothing depends on
/// the time, an input for it is left out. `waves_on_a_circle` is that of the fields in the lists.
/// Throws Error(usage) if the numbers of inputs or outputs do not fit.
DynamicalSystem make_system(std::string name, OperationList hamiltonian,
                            std::optional<OperationList> vector_field = std::nullopt,
                            std::size_t parameters = 0);

/// A force as a function of the inputs (q, p, c, t) of a system that depends on the time.
using ForceFunction = std::function<std::vector<Expression>(std::span<const Expression>)>;

/// The system with a further force F that comes from no potential, n components added to p'. It is
/// then no Hamiltonian system; its Hamiltonian is still the energy that the force takes away.
DynamicalSystem with_force(const DynamicalSystem& system, const ForceFunction& force);

/// Records the Hamiltonian and derives the vector field.
template <HamiltonianFunction Function>
DynamicalSystem make_system(std::string name, std::size_t degrees_of_freedom, const Function& h) {
  const std::size_t n = degrees_of_freedom;
  return make_system(std::move(name), record(2 * n, [&](std::span<const Expression> z) {
                       return std::vector<Expression>{h(z.first(n), z.last(n))};
                     }));
}

/// Records a Hamiltonian that depends on the time, and derives the vector field.
template <TimeDependentHamiltonian Function>
requires(!HamiltonianFunction<Function>) DynamicalSystem
    make_system(std::string name, std::size_t degrees_of_freedom, const Function& h) {
  const std::size_t n = degrees_of_freedom;
  return make_system(std::move(name),
                     record(
                         2 * n + 1,
                         [&](std::span<const Expression> z) {
                           return std::vector<Expression>{h(z.first(n), z.subspan(n, n), z.back())};
                         },
                         true));
}

/// Records the Hamiltonian and a hand-written force F(q) = -dV/dq for H = p^2/2 + V(q).
template <HamiltonianFunction Function, class Force>
DynamicalSystem make_system(std::string name, std::size_t degrees_of_freedom, const Function& h,
                            const Force& force) {
  const std::size_t n = degrees_of_freedom;
  return make_system(std::move(name),
                     record(2 * n,
                            [&](std::span<const Expression> z) {
                              return std::vector<Expression>{h(z.first(n), z.last(n))};
                            }),
                     record(2 * n, [&](std::span<const Expression> z) {
                       std::vector<Expression> field(z.begin() + static_cast<std::ptrdiff_t>(n),
                                                     z.end());
                       const std::vector<Expression> f = force(z.first(n));
                       field.insert(field.end(), f.begin(), f.end());
                       return field;
                     }));
}

/// Declares a rotation that leaves the Hamiltonian of a system unchanged, and returns the system
/// with this declaration. The rotation turns the positions i and j of each plane and their momenta
/// by the same angle; an axis of symmetry along q_3 is {{0, 1}}. Throws Error(usage) for indices
/// that are out of range or repeated, and if the vector field at one of a few random points changes
/// under the rotation by more than the rounding of extended precision.
DynamicalSystem with_rotation(DynamicalSystem system,
                              std::vector<std::array<std::size_t, 2>> planes_of_positions);

/// Declares that the dependence of a system on the time consists in a rotation, see
/// UniformRotation, and returns the system with this declaration. Throws Error(usage) for indices
/// that are out of range or repeated, and if the vector field at one of a few random points and
/// times changes under the rotation by more than the rounding of extended precision.
DynamicalSystem with_uniform_rotation(DynamicalSystem system, UniformRotation rotation);

/// The quantity that the flow of a system keeps, as a list with one output and the inputs of the
/// Hamiltonian; no value where none is known.
std::optional<OperationList> conserved_list(const DynamicalSystem& system);

/// The degrees of freedom that a scene needs, ascending: those of the variables to expand in, those
/// whose nominal is not exactly at rest in the origin, and all that are driven by these.
std::vector<std::size_t> needed_degrees_of_freedom(const DynamicalSystem& system,
                                                   std::span<const double> nominal,
                                                   std::span<const std::size_t> variables);

/// The system with the `kept` degrees of freedom alone. The subspace where the others vanish must
/// be invariant.
DynamicalSystem restrict_system(const DynamicalSystem& system, std::span<const std::size_t> kept);

}  // namespace hamjet
