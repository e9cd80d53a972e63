#include "arc.hpp"

#include <utility>

namespace hamjet {

Arc propagate_arc(AdvanceMap& map, const Eigen::VectorXd& point,
                  const Eigen::VectorXd& control_guess, std::size_t steps) {
  Arc arc;
  arc.points.push_back(point);
  arc.jacobian = Eigen::MatrixXd::Identity(point.size(), point.size());
  Eigen::VectorXd control = control_guess;
  for (std::size_t k = 0; k < steps; ++k) {
    AdvancedPoint next = map.advance(arc.points.back(), control);
    control = next.control;
    arc.points.push_back(std::move(next.point));
    arc.controls.push_back(std::move(next.control));
    arc.jacobian = next.jacobian * arc.jacobian;
    arc.jacobians.push_back(std::move(next.jacobian));
  }
  return arc;
}

DiscreteTrajectory trajectory_of(const Arc& arc) {
  DiscreteTrajectory trajectory;
  for (const Eigen::VectorXd& point : arc.points) {
    trajectory.states.emplace_back(point.head(point.size() / 2));
    trajectory.costates.emplace_back(point.tail(point.size() / 2));
  }
  trajectory.controls = arc.controls;
  return trajectory;
}

}  // namespace hamjet
