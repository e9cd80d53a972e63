#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace hamjet {

/// Points along a trajectory of unknown length. If there are too many, every second one is dropped,
/// so that a million steps fit too; the last point always stays.
template <class Point, std::size_t LargestSize = 20001>
class ThinnedList {
 public:
  void add(Point point) {
    const bool is_kept = count_++ % stride_ == 0;
    if (has_extra_last_) points_.pop_back();
    has_extra_last_ = !is_kept;
    points_.push_back(std::move(point));
    if (!is_kept || points_.size() < LargestSize) return;
    for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = std::move(points_[2 * i]);
    points_.resize((points_.size() + 1) / 2);
    stride_ *= 2;
  }

  std::vector<Point> take() { return std::move(points_); }

 private:
  static_assert(LargestSize % 2 == 1, "halving keeps the last of an odd number of points");

  std::vector<Point> points_;
  long count_ = 0;
  long stride_ = 1;
  bool has_extra_last_ = false;
};

}  // namespace hamjet
