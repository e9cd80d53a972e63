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
/// controls that turn at the rate 2 p_z. Source: Guibout and Bloch, "The Heisenberg optimal
/// control problem" (the printed signs, cost and reduced Hamiltonian are put right here).
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

/// What an end asks for, seen from the start; components that are not fixed do not change.
struct HeisenbergChange {
  double dx = 0;
  double dy = 0;
  /// Change of Z = z - z_0 - y_0 X + x_0 Y, which obeys the same equations from the origin.
  double a = 0;
};
/// The change that an end with these fixed components asks for from `start`.
HeisenbergChange heisenberg_change(std::span<const double> start,
                                   std::span<const std::optional<double>> end);

/// The least cost from `start` to an end with these fixed components, within `duration`, where it
/// is elementary:
///
///  - (x, y) at the end as at the start, z fixed: one full circle at constant speed, which encloses
///    the area |a| / 2, a the change of z less what the start's own x, y contribute: pi |a| / T;
///    discrete, a regular polygon of N >= 3 sides: N tan(pi / N) |a| / T. One step to z or two
///    cannot enclose anything: none then, unless a = 0;
///  - x and y fixed, z free or such that a = 0: the straight line, d^2 / (2 T) in both.
///
/// Both discrete geometries give the same, for each makes z change by the triangle that a step
/// spans with the origin.
std::optional<ClosedFormCost> heisenberg_cost(std::span<const double> start,
                                              const std::array<std::optional<double>, 3>& end,
                                              double duration, std::size_t steps);

}  // namespace hamjet
