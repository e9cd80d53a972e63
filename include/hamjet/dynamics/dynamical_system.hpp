#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hamjet/detail/dynamics/expression.hpp"
#include "hamjet/detail/dynamics/operation_list.hpp"

namespace hamjet {

/// The second-order structure q' = M^-1 p, p' = F(q) with a constant mass matrix M.
struct SecondOrderForm {
  std::vector<Extended> inverse_mass;  ///< n x n, by rows
  OperationList force;                 ///< n inputs q, n outputs F(q)
};

/// A Hamiltonian system with n degrees of freedom, z = (q_1..q_n, p_1..p_n) and
/// z' = J grad H(z), J = [[0, I], [-I, 0]].
struct DynamicalSystem {
  std::string name;
  std::size_t degrees_of_freedom = 0;
  OperationList hamiltonian;                    ///< 2n inputs, 1 output
  OperationList vector_field;                   ///< 2n inputs, 2n outputs
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

  std::size_t dimension() const noexcept { return 2 * degrees_of_freedom; }
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

/// Builds a system from the list of its Hamiltonian; the vector field is derived from it unless it
/// is given. Throws Error(usage) if the numbers of inputs or outputs do not fit.
DynamicalSystem make_system(std::string name, OperationList hamiltonian,
                            std::optional<OperationList> vector_field = std::nullopt);

/// Records the Hamiltonian and derives the vector field.
template <HamiltonianFunction Function>
DynamicalSystem make_system(std::string name, std::size_t degrees_of_freedom, const Function& h) {
  const std::size_t n = degrees_of_freedom;
  return make_system(std::move(name), record(2 * n, [&](std::span<const Expression> z) {
                       return std::vector<Expression>{h(z.first(n), z.last(n))};
                     }));
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

/// The degrees of freedom that a scene needs, ascending: those of the variables to expand in, those
/// whose nominal is not exactly at rest in the origin, and all that are driven by these.
std::vector<std::size_t> needed_degrees_of_freedom(const DynamicalSystem& system,
                                                   std::span<const double> nominal,
                                                   std::span<const std::size_t> variables);

/// The system with the `kept` degrees of freedom alone. The subspace where the others vanish must
/// be invariant.
DynamicalSystem restrict_system(const DynamicalSystem& system, std::span<const std::size_t> kept);

}  // namespace hamjet
