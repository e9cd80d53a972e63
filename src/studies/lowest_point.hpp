#pragma once

#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// Finds the smallest distance of an orbit's nominal from the centre, also between its points.
/// Momenta are taken as velocities.
class LowestPointSearch {
 public:
  explicit LowestPointSearch(const ComputedProblem& problem) : problem_(problem) {}

  /// Adds a point; the points must come in order, beginning with the start. Time and components are
  /// canonical.
  void record(double time, const std::vector<double>& state);

  /// Follows the nominal to the places where r.v changes from negative to positive, by integration
  /// from the last point before. If there are more than 64 such passages, only those that are
  /// lowest by interpolation are followed.
  LowestPoint take();

 private:
  struct Point {
    double time = 0;
    std::vector<double> state;
    double distance = 0;
    double radial = 0;  ///< r.v, positive if the distance grows with the time that passes
  };
  /// A step in which the distance stops falling.
  struct Passage {
    Point start;
    double duration = 0;
    double estimate = 0;  ///< estimate of the smallest squared distance
  };

  Point point(double time, const std::vector<double>& state, double direction) const;
  Point advanced(const Point& start, double duration, double direction) const;
  void keep_lower(const Point& candidate);
  void keep_passage(const Point& end);
  void refine(const Passage& passage);

  const ComputedProblem& problem_;
  Point last_;
  bool is_started_ = false;
  double direction_ = 1;  ///< direction of time
  std::vector<Passage> passages_;
  LowestPoint result_;
};

}  // namespace hamjet
