#pragma once

#include "../gauss/contraction.hpp"

namespace hamjet {

/// Follows the changes of one orbit's iteration, relative to the size of the iterate; other orbits
/// of the same iteration may finish earlier.
struct LaneJudge {
  bool is_done = false;
  bool has_failed = false;

  void judge(double size) {
    const auto outcome = contraction_.judge(size);
    is_done = outcome != Contraction<double>::goes_on;
    has_failed = outcome == Contraction<double>::fails;
  }

 private:
  Contraction<double> contraction_;
};

}  // namespace hamjet
