#pragma once

#include "hamjet/detail/dynamics/expression.hpp"

namespace hamjet {

/// The list about a time t: in place of the time it has one more variable, the last, which is the
/// time s after t. A function of the time is its Taylor polynomial of a degree about t,
///
///   f(t + s) = sum over k of f_k s^k ,
///
/// so that series in all variables up to that degree are those of the list itself.
OperationList about_time(const OperationList& list, const Extended& time, int degree);

}  // namespace hamjet
