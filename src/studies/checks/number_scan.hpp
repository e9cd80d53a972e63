#pragma once

#include <string>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// How many numbers a run's result has, and how many of them are not finite in the precision in
/// which they are stored.
struct NumberScan {
  long numbers = 0;
  long not_finite = 0;
  std::string first;  ///< where the first number that is not finite stands
};

/// Looks at all numbers that are printed or stored of a run.
NumberScan scan_numbers(const Scene& scene, const RunResult& run);

}  // namespace hamjet
