#pragma once

#include <vector>

#include "hamjet/maps/partial_inversion.hpp"

namespace hamjet {

/// The one-form sigma with dS = sum of sigma_i dw_i for a generating function S: with n entries for
/// the final pairs and then n for the initial pairs. With F1, S = F1(q, q0): sigma = (p, -p0). In
/// general, for a final pair sigma = p_i if w = q_i and -q_i if w = p_i; for an initial pair -p0_i
/// if w = q0_i and +q0_i if w = p0_i.
template <class T>
std::vector<Series<T>> one_form(const PartialInversion<T>& inversion);

/// The generating function of the map of deviations, as a polynomial of degree 2..N+1 in w (see
/// PartialInversion), by the homotopy integral, degree by degree:
///
///   S_(d+1) = (1/(d+1)) sum over i of w_i sigma_(i,d) .
///
/// S generates the map exactly only if the one-form is closed; see exactness_residual.
template <class T>
Series<T> generating_function(const std::vector<Series<T>>& one_form);

}  // namespace hamjet
