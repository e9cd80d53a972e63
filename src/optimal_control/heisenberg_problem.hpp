#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "closed_form_cost.hpp"

namespace hamjet {

/// The Heisenberg problem: states (x, y, z), controls (u_1, u_2),
///
///   x' = u_1 ,  y' = u_2 ,  z' = u_1 y - u_2 x ,  g = (u_1^2 + u_2^2) / 2 .
///
/// z falls by twice the area that (x, y) sweeps about the origin, counted anticlockwise.
/// Pontryagin's principle gives u_1 = -(p_x + p_z y), u_2 = -(p_y - p_z x), constant p_z, and
/// controls that turn at the rate 2 p_z. Source: Guibout and Bloch, "The Heisenberg optimal control
/// problem" (the signs, the cost and the reduced Hamiltonian are corrected here).
struct HeisenbergFunctions {
  static constexpr std::size_t states = 3;
  static constexpr std::size_t controls = 2;

  template <class T>
  T running_cost(std::span<const T>, std::span<const T> u) const {
    return (u[0] * u[0] + u[1] * u[1]) / T(2);
  }
  template <class T>
  std::vector<T> dynamics(std::span<const T> x, std::span<const T> u) const {
    return {u[0], u[1], u[0] * x[1] - u[1] * x[0]};
  }
};

/// The change that an end asks for, relative to the start; components that are not fixed do not
/// change.
struct HeisenbergChange {
  double dx = 0;
  double dy = 0;
  /// Change of Z = z - z_0 - y_0 X + x_0 Y, which obeys the same equations, started from the
  /// origin.
  double a = 0;
};
/// The change that an end with these fixed components asks for from `start`.
HeisenbergChange heisenberg_change(std::span<const double> start,
                                   std::span<const std::optional<double>> end);

/// The least cost from `start` to an end with these fixed components within `duration`, in the
/// cases where it is elementary:
///
/// - (x, y) is the same at both ends and z is fixed: one full circle at constant speed, which
///   encloses the area |a| / 2, where a is the change of z minus the contribution of the start's
///   x, y; the cost is pi |a| / T. In discrete time it is a regular polygon of N >= 3 sides:
///   N tan(pi / N) |a| / T. One or two steps cannot enclose an area: then there is no value, unless
///   a = 0.
/// - x and y are fixed, and z is free or such that a = 0: the straight line, d^2 / (2 T) in both
///   times.
///
/// Both discrete geometries give the same cost, because in each z changes by the triangle that a
/// step spans with the origin.
std::optional<ClosedFormCost> heisenberg_cost(std::span<const double> start,
                                              const std::array<std::optional<double>, 3>& end,
                                              double duration, std::size_t steps);

}  // namespace hamjet
