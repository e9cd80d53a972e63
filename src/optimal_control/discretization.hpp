#pragma once

#include <string_view>
#include <vector>

namespace hamjet {

/// The discrete geometry of the maximum principle: the points in a step from k to k+1 at which the
/// state x^d and the costate p^d are taken. The derivative is (x_(k+1) - x_k) / tau in both
/// geometries.
enum class Discretization {
  stormer,   ///< (x^d, p^d, u^d) = (x_k, p_(k+1), u_k)
  midpoint,  ///< the means of both ends; u^d is the unknown, because u_k and u_(k+1) do not occur
             ///< separately
};

/// The names of Discretization in scenes, in the order of the enumeration.
const std::vector<std::string_view>& discretization_names();

/// The weight, 0 or 1/2, in the state x^d = x_k + weight (x_(k+1) - x_k).
double state_weight(Discretization discretization);
/// The weight, 1 or 1/2, in the costate p^d = p_k + weight (p_(k+1) - p_k).
double costate_weight(Discretization discretization);

}  // namespace hamjet
