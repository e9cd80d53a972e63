#pragma once

#include <limits>

namespace hamjet {

/// Follows the changes of one orbit's iteration, relative to what changes, as
/// Contraction does.
struct LaneJudge {
  bool is_done = false;
  bool has_failed = false;

  void judge(double size) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    constexpr double largest_remainder = 0x1p-12;
    constexpr double slowest = 0.5;
    constexpr int most_stalls = 1;
    constexpr int largest_count = 40;
    const double before = previous_;
    previous_ = size;
    if (!(size <= slowest * before)) {
      if (size <= 2 * epsilon) {
        is_done = true;
      } else if (++stalls_ > most_stalls) {
        is_done = has_failed = true;
      }
    } else if (count_ > 0 && size * size <= largest_remainder * epsilon * (before - size)) {
      is_done = true;
    }
    if (++count_ >= largest_count && !is_done) is_done = has_failed = true;
  }

 private:
  int count_ = 0;
  int stalls_ = 0;
  double previous_ = std::numeric_limits<double>::max();
};

}  // namespace hamjet
