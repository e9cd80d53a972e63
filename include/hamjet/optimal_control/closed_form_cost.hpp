#pragma once

namespace hamjet {

/// Least costs of a problem with these end conditions.
struct ClosedFormCost {
  double continuous = 0;  ///< the integral of g
  double discrete = 0;    ///< the sum of tau g over the steps
};

}  // namespace hamjet
