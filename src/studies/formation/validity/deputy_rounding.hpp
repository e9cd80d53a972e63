#pragma once

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The rounding of deputies' flights over a time: that of the chief's, see rounding_of_flights, but
/// for deputies that are further from their chief than the chief starts from the origin, as all are
/// where it rests there.
class DeputyRounding {
 public:
  /// No deputy is further than `furthest` from its chief.
  DeputyRounding(const ComputedProblem& problem, double time, double furthest);

  /// The rounding, in position, of the flights of deputies at a separation.
  double at(double separation) const;

 private:
  double of_chief_;
  double start_;
  double growth_ = 0;  ///< of deviations by the linear flow, where deputies may be that far
};

}  // namespace hamjet
