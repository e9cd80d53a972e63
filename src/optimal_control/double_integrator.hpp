#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "closed_form_cost.hpp"
#include "discretization.hpp"

namespace hamjet {

/// The double integrator with least effort: states (position, velocity), one control,
///
///   position' = velocity ,  velocity' = u ,  g = u^2 / 2 .
struct DoubleIntegratorFunctions {
  static constexpr std::size_t states = 2;
  static constexpr std::size_t controls = 1;

  template <class T>
  T running_cost(std::span<const T>, std::span<const T> u) const {
    return u[0] * u[0] / T(2);
  }
  template <class T>
  std::vector<T> dynamics(std::span<const T> x, std::span<const T> u) const {
    return {x[1], u[0]};
  }
};

/// The controllability Gramian of N steps tau, by rows: the sum of tau b_j b_j^T, where b_j is the
/// effect of a unit of velocity gained in step j on the final (position, velocity). For zero steps,
/// the Gramian of continuous time, the integral of (T - t, 1) (T - t, 1)^T.
std::array<double, 4> double_integrator_gramian(Discretization discretization, double duration,
                                                std::optional<std::size_t> steps);

/// The least cost from `start` to an end with these fixed components: delta^T W^-1 delta / 2, where
/// delta is the difference between the wanted end and the end without control, and W has the rows
/// and columns of the Gramian that belong to the fixed components. A free component has the costate
/// 0 at the end. There is no value if no component is fixed, or if a single step is to reach both
/// components, or the position in the Stormer form.
std::optional<ClosedFormCost> double_integrator_cost(
    Discretization discretization, std::span<const double> start,
    const std::array<std::optional<double>, 2>& end, double duration, std::size_t steps);

}  // namespace hamjet
