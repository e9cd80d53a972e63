#pragma once

namespace hamjet {

/// Least costs of an optimal-control problem, where a closed form is known.
struct ClosedFormCost {
  double continuous = 0;  ///< least integral of g
  double discrete = 0;    ///< least sum of tau g over the steps
};

}  // namespace hamjet
