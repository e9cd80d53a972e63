#include "hamjet/relative_motion/chief_frame.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

void require_size(std::span<const double> numbers, const char* what) {
  if (numbers.size() < 6) {
    throw Error(ErrorKind::usage, std::string("relative state: the ") + what +
                                      " must begin with 6 numbers, (q, p) of an orbit");
  }
}

Eigen::Vector3d vector_at(std::span<const double> numbers, std::size_t first) {
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

}  // namespace

ChiefFrame::ChiefFrame(std::span<const double> chief, const MetricUnits& units, RelativeFrame frame)
    : units_(units) {
  require_size(chief, "chief");
  if (frame == RelativeFrame::coordinates) {
    to_velocity_ = units.velocities.by_momenta;
    to_momentum_ = to_velocity_.inverse();
    turn_ = units.velocities.by_positions;
  }
  if (is_along_coordinates(frame)) return;
  const Eigen::Vector3d r = vector_at(chief, 0);
  const Eigen::Vector3d v = vector_at(chief, 3);
  const Eigen::Vector3d h = r.cross(v);
  // Where |h| is below this fraction of |r| |v|, the direction of h is round-off.
  constexpr double least_sine = 1e-12;
  if (!(h.norm() > least_sine * r.norm() * v.norm())) {
    throw Error(ErrorKind::numerical,
                "relative state: the chief moves on a line through the centre and has no orbital "
                "plane, so that there is no RTN frame; the frame inertial remains");
  }
  axes_.row(0) = r.normalized();
  axes_.row(2) = h.normalized();
  axes_.row(1) = h.cross(r).normalized();
  if (frame == RelativeFrame::rtn_rotating) {
    const double rate = h.norm() / r.squaredNorm();
    turn_(0, 1) = rate;
    turn_(1, 0) = -rate;
  }
}

std::vector<double> ChiefFrame::deviation(const RelativeState& state) const {
  const Eigen::Vector3d position = state.position_m / units_.length_m;
  const Eigen::Vector3d momentum =
      to_momentum_ * (state.velocity_m_s / units_.velocity_m_s() - turn_ * position);
  const Eigen::Vector3d dq = axes_.transpose() * position;
  const Eigen::Vector3d dp = axes_.transpose() * momentum;
  return {dq[0], dq[1], dq[2], dp[0], dp[1], dp[2]};
}

RelativeState ChiefFrame::relative(std::span<const double> deviation) const {
  require_size(deviation, "deviation");
  const Eigen::Vector3d position = axes_ * vector_at(deviation, 0);
  const Eigen::Vector3d momentum = axes_ * vector_at(deviation, 3);
  return {position * units_.length_m,
          (to_velocity_ * momentum + turn_ * position) * units_.velocity_m_s()};
}

Eigen::Vector3d ChiefFrame::velocity_change_m_s(const Eigen::Vector3d& canonical) const {
  return to_velocity_ * (axes_ * canonical) * units_.velocity_m_s();
}

}  // namespace hamjet
