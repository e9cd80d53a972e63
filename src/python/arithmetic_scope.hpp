#pragma once

#include <cfenv>

#include "../app/arithmetic.hpp"

namespace hamjet::python {

/// While it lives, this thread rounds and treats denormal numbers as the command does, whatever
/// other modules have changed; then as before. Throws Error(numerical) as reset_arithmetic does.
class ArithmeticScope {
 public:
  ArithmeticScope() {
    std::fegetenv(&before_);
    cli::reset_arithmetic();
  }
  ~ArithmeticScope() { std::fesetenv(&before_); }
  ArithmeticScope(const ArithmeticScope&) = delete;
  ArithmeticScope& operator=(const ArithmeticScope&) = delete;

 private:
  std::fenv_t before_{};
};

}  // namespace hamjet::python
