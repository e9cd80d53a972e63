#include "path_flow.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hamjet {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

PathFlow::PathFlow(const ComputedProblem& problem, std::vector<double> start,
                   const TimedImpulses& impulses, double momentum_unit, double duration)
    : duration_(duration) {
  constexpr double in_revolution = 48;
  std::vector<double> state = std::move(start);
  Matrix6 matrix = Matrix6::Identity();
  double now = 0;
  const auto fly_to = [&](double time) {
    if (time == now) return;
    Arc arc{now, std::make_unique<ComputedProblem>(problem), nullptr, matrix};
    arc.problem->nominal = state;
    arc.problem->start_time = problem.start_time + now;
    arc.flow = std::make_unique<LinearFlow>(*arc.problem, time - now, in_revolution);
    state = arc.flow->nominal(time - now);
    matrix = arc.flow->at(time - now) * matrix;
    arcs_.push_back(std::move(arc));
    now = time;
  };
  for (std::size_t k = 0; k < impulses.times.size(); ++k) {
    fly_to(impulses.times[k]);
    for (std::size_t i = 0; i < 3; ++i) {
      state[3 + i] += impulses.changes[k][static_cast<Eigen::Index>(i)] * momentum_unit;
    }
  }
  fly_to(duration);
}

Matrix6 PathFlow::at(double time) const {
  const auto behind =
      std::upper_bound(arcs_.begin(), arcs_.end(), std::abs(time),
                       [](double size, const Arc& arc) { return size < std::abs(arc.begin); });
  const Arc& arc = behind == arcs_.begin() ? arcs_.front() : *(behind - 1);
  return arc.flow->at(time - arc.begin) * arc.before;
}

ImpulseGrid PathFlow::grid() const {
  constexpr std::size_t most = 4000;
  std::size_t count = 0;
  for (const Arc& arc : arcs_) count += arc.flow->times().size() - 1;
  const std::size_t stride = count / most + 1;
  ImpulseGrid grid;
  for (const Arc& arc : arcs_) {
    for (std::size_t k = 0; k + 1 < arc.flow->times().size(); k += stride) {
      grid.add(arc.begin + arc.flow->times()[k], arc.flow->checkpoint(k) * arc.before);
    }
  }
  grid.add(duration_, at(duration_));
  return grid;
}

}  // namespace hamjet
