#pragma once

#include <string>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The count of numbers in a run's result, and of those that are not finite in the precision in
/// which they are stored.
struct NumberScan {
  long numbers = 0;
  long not_finite = 0;
  std::string first;  ///< place of the first number that is not finite
};

/// Counts all numbers of a run that are printed or stored.
NumberScan scan_numbers(const Scene& scene, const RunResult& run);

}  // namespace hamjet
