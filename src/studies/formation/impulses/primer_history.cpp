#include <Eigen/LU>
#include <algorithm>

#include "../single_transfer.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "impulse_plan.hpp"
#include "impulse_search.hpp"

namespace hamjet {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

std::optional<PrimerHistory> primer_between(const ImpulseGrid& grid, const Eigen::Vector3d& first,
                                            const Eigen::Vector3d& last) {
  Matrix6 both;
  both << grid.effects.front().transpose(), grid.effects.back().transpose();
  Vector6 ends;
  ends << first, last;
  Eigen::FullPivLU<Matrix6> solver(both);
  solver.setThreshold(1e-9);
  if (!solver.isInvertible()) return std::nullopt;
  const Vector6 costate = solver.solve(ends);
  PrimerHistory history{primer_along(grid, costate), {}};
  history.largest =
      *std::max_element(history.magnitudes.begin(), history.magnitudes.end(),
                        [](const auto& a, const auto& b) { return a.magnitude < b.magnitude; });
  return history;
}

std::optional<PrimerHistory> primer_history(const Scene& scene, const ComputedProblem& problem,
                                            const CompanionFlow& flow, const TransferPoint& point) {
  const MetricUnits units = metric_units(scene);
  const TransferAnswer& answer = point.best();
  if (answer.start_change_m_s.isZero(0) || answer.end_change_m_s.isZero(0)) return std::nullopt;
  // The primer equals the direction of the impulse at each end, in inertial axes.
  const auto direction = [&](const std::vector<double>& chief, const Eigen::Vector3d& change) {
    const std::vector<double> z = ChiefFrame(chief, units, scene.transfer->frame)
                                      .deviation({Eigen::Vector3d::Zero(), change});
    return Eigen::Vector3d(Eigen::Vector3d(z[3], z[4], z[5]).normalized());
  };
  return primer_between(impulse_grid(flow, point.time),
                        direction(problem.nominal, answer.start_change_m_s),
                        direction(flow.chief(point.time), answer.end_change_m_s));
}

}  // namespace hamjet
