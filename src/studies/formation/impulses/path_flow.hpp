#pragma once

#include <memory>
#include <vector>

#include "hamjet/studies/propagation.hpp"
#include "impulse_search.hpp"

namespace hamjet {

/// The linear flow about the trajectory of a deputy that flies impulses. It holds farther from the
/// chief than the flow about the chief does.
class PathFlow {
 public:
  /// `start` is the deputy's state before any impulse, in canonical units; the impulses are in
  /// units of `momentum_unit`. Throws as LinearFlow.
  PathFlow(const ComputedProblem& problem, std::vector<double> start, const TimedImpulses& impulses,
           double momentum_unit, double duration);

  /// The matrix from time 0 to a canonical time.
  Eigen::Matrix<double, 6, 6> at(double time) const;
  /// A grid with 48 times per revolution (fewer if this would be more than some thousands), and the
  /// end.
  ImpulseGrid grid() const;

 private:
  struct Arc {
    double begin = 0;
    std::unique_ptr<ComputedProblem> problem;  ///< the flow refers to it
    std::unique_ptr<LinearFlow> flow;
    Eigen::Matrix<double, 6, 6> before;  ///< the matrix from time 0 to the beginning of this leg
  };

  double duration_;
  std::vector<Arc> arcs_;
};

}  // namespace hamjet
