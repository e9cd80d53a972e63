#pragma once

#include <limits>

#include "hamjet/maps/generating_function.hpp"

namespace hamjet {

/// The partial inversion that belongs to a generating function S of a kind, given as
/// `generating_function()` returns it: degree 2..N+1 in the 2n variables w of that kind. The
/// gradient sigma = grad S, read with the signs of `one_form`, gives the remaining variables as
/// series of degree N in w:
///
///   final pair   p_i = sigma_i if w_i = q_i,   q_i = -sigma_i if w_i = p_i,
///   initial pair p0_i = -sigma_i if w_i = q0_i,   q0_i = sigma_i if w_i = p0_i .
///
/// `condition` is that of d^2 S / d(chosen final) d(chosen initial), the same as that of the matrix
/// that the inversion of the jet inverts. S is in the units of action of the jet's variables; its
/// constant is ignored. Throws Error(usage) if S is not in 2n variables, is of order below 2, or
/// has terms of degree 1, which would move the nominal. Source: Guibout and Bloch, eq. can_gen2,
/// for F1; Goldstein, Classical Mechanics (1980), table 9-1, for F2..F4.
template <class T>
PartialInversion<T> remaining_variables(const Series<T>& S, const GeneratingFunctionKind& kind);

/// Solves the map of `from` for the remaining variables of the kind `to`: the variables of `to` are
/// n + n of the 4n variables that are known as series in those of `from`; that map is inverted, and
/// the others are composed with its inverse. Only the pairs in which the kinds differ are inverted,
/// as a block of second derivatives of S. Throws Error(numerical) where the smallest singular value
/// of the block is below the norm of all second derivatives divided by
/// largest_condition(precision): the other kind does not exist there to any useful accuracy. The
/// message names both kinds, the smallest singular value and the condition. Throws Error(usage) for
/// kinds of different n.
template <class T>
PartialInversion<T> change_of_kind(
    const PartialInversion<T>& from, const GeneratingFunctionKind& to,
    double precision = static_cast<double>(std::numeric_limits<T>::epsilon()));

/// The generating function of kind `to`, from the generating function S of kind `from` of the same
/// map, without the jet: the Legendre transformation in the pairs where the kinds differ,
///
///   S'(w') = S(w) - sum over these of w_i sigma_i ,
///
/// formed by change_of_kind and the homotopy integral. Both S and S' are of degree 2..N+1. Throws
/// what remaining_variables and change_of_kind throw. Source: Goldstein, Classical Mechanics
/// (1980), section 9-1.
template <class T>
Series<T> legendre_transformation(
    const Series<T>& S, const GeneratingFunctionKind& from, const GeneratingFunctionKind& to,
    double precision = static_cast<double>(std::numeric_limits<T>::epsilon()));

}  // namespace hamjet
