#pragma once

#include <cstddef>

#include "hamjet/algebra/extended.hpp"

namespace hamjet {

/// Functions of the time alone that belong together, such as the components of a rotation matrix or
/// of the position of a body. A Hamiltonian takes them by `time_values` (expression.hpp). Times are
/// in the system's own unit and counted from its epoch. Objects are immutable and may be used by
/// several threads at once.
class TimeFunction {
 public:
  TimeFunction() = default;
  TimeFunction(const TimeFunction&) = delete;
  TimeFunction& operator=(const TimeFunction&) = delete;
  virtual ~TimeFunction() = default;

  virtual std::size_t components() const = 0;
  /// Sets the Taylor coefficients about t up to a degree, those of a component side by side:
  /// f_c(t + s) = sum over k of out[c * (degree + 1) + k] s^k + O(s^(degree + 1)). Throws
  /// Error(numerical) where the functions are not known, with the span in which they are.
  virtual void expand(double t, int degree, double* out) const = 0;
  virtual void expand(const Extended& t, int degree, Extended* out) const = 0;
};

}  // namespace hamjet
