#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "energy_optimal_flights.hpp"

// Thrust of least energy beside a direct method of the test's own: a thrust that is linear between
// nodes, whose energy is made least by sequential quadratic programming. It knows no costates.

namespace hamjet::thrusted {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// The thrust of 3 (n + 1) numbers, one vector a node.
class DirectMethod {
 public:
  DirectMethod(const Numbers& start, const Numbers& end, double time, int parts)
      : time_(time), parts_(parts), thrust_(Eigen::VectorXd::Zero(3 * (parts + 1))) {
    for (Eigen::Index i = 0; i < 6; ++i) {
      start_[i] = static_cast<double>(start[static_cast<std::size_t>(i)]);
      end_[i] = static_cast<double>(end[static_cast<std::size_t>(i)]);
    }
  }

  /// The least energy. The constraint's curvature is left out of the quadratic model, so that steps
  /// shrink by the size of the deviation over that of the orbit.
  double least_energy() {
    const Eigen::MatrixXd weight = weight_of_thrust();
    const Eigen::MatrixXd inverse = weight.inverse();
    for (int round = 0; round < 30; ++round) {
      fly();
      const Vector6 missing = end_ - place_;
      const Eigen::Matrix<double, 6, 6> gramian = slope_ * inverse * slope_.transpose();
      const Eigen::VectorXd next =
          inverse * slope_.transpose() * gramian.ldlt().solve(missing + slope_ * thrust_);
      const double change = (next - thrust_).norm() / next.norm();
      thrust_ = next;
      if (change < 1e-13) break;
    }
    fly();
    EXPECT_LT((end_ - place_).norm(), 1e-13);
    return thrust_.dot(weight * thrust_) / 2;
  }

 private:
  /// The integral of |u|^2 is u^T W u.
  Eigen::MatrixXd weight_of_thrust() const {
    Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(thrust_.size(), thrust_.size());
    const double h = time_ / parts_;
    for (int k = 0; k < parts_; ++k) {
      for (int i = 0; i < 3; ++i) {
        const int a = 3 * k + i, b = a + 3;
        weight(a, a) += h / 3;
        weight(b, b) += h / 3;
        weight(a, b) += h / 6;
        weight(b, a) += h / 6;
      }
    }
    return weight;
  }

  using Slopes = Eigen::Matrix<double, 6, Eigen::Dynamic>;

  void rate(const Vector6& z, const Slopes& s, const Eigen::Vector3d& u, int part, double share,
            Vector6& dz, Slopes& ds) const {
    const Eigen::Vector3d q = z.head<3>();
    const double r = q.norm();
    dz << z.tail<3>(), -q / (r * r * r) + u;
    const Eigen::Matrix3d gradient =
        (3 * q * q.transpose() / (r * r) - Eigen::Matrix3d::Identity()) / (r * r * r);
    ds.topRows<3>() = s.bottomRows<3>();
    ds.bottomRows<3>() = gradient * s.topRows<3>();
    for (int i = 0; i < 3; ++i) {
      ds(3 + i, 3 * part + i) += 1 - share;
      ds(3 + i, 3 * part + 3 + i) += share;
    }
  }

  /// The end, and its slope by the thrust, by the classical Runge-Kutta method.
  void fly() {
    const int steps = 4000 / parts_;
    const double h = time_ / parts_ / steps;
    Vector6 z = start_;
    Slopes s = Slopes::Zero(6, thrust_.size());
    std::array<Vector6, 4> dz;
    std::array<Slopes, 4> ds;
    ds.fill(s);
    for (int part = 0; part < parts_; ++part) {
      for (int step = 0; step < steps; ++step) {
        const std::array<double, 4> at = {0, 0.5, 0.5, 1};
        for (std::size_t k = 0; k < 4; ++k) {
          const double share = (step + at[k]) / steps;
          const Eigen::Vector3d u =
              (1 - share) * thrust_.segment<3>(3 * part) + share * thrust_.segment<3>(3 * part + 3);
          const double ahead = h * at[k];
          if (k == 0) {
            rate(z, s, u, part, share, dz[0], ds[0]);
          } else {
            rate(z + ahead * dz[k - 1], s + ahead * ds[k - 1], u, part, share, dz[k], ds[k]);
          }
        }
        z += h / 6 * (dz[0] + 2 * dz[1] + 2 * dz[2] + dz[3]);
        s += h / 6 * (ds[0] + 2 * ds[1] + 2 * ds[2] + ds[3]);
      }
    }
    place_ = z;
    slope_ = s;
  }

  double time_;
  int parts_;
  Vector6 start_, end_, place_;
  Slopes slope_;
  Eigen::VectorXd thrust_;
};

// Thrust that is linear between nodes costs more than the least, and the excess falls with the
// fourth power of the interval: a linear interpolation errs by its square, and the energy is
// stationary.
TEST(DirectMethod, NoThrustOfManyNodesIsCheaper) {
  const Scene scene = thrust_scene(10e3, {4.0});
  const TransferResult result = study_transfer(scene);
  const EnergyOptimalTransfer& transfer = result.thrust->transfers.at(0);
  ASSERT_TRUE(transfer.is_found()) << transfer.failure;
  const Numbers start = start_of(scene, scene.transfer->start, std::vector<double>(6));
  const Numbers end =
      flown(start_of(scene, scene.transfer->start, transfer.refined->costates), transfer.time);
  const double least = transfer.energy_m2_s3 / energy_unit(scene);
  std::array<double, 3> excess{};
  for (std::size_t k = 0; k < 3; ++k) {
    excess[k] = DirectMethod(start, end, transfer.time, 10 << k).least_energy() / least - 1;
    EXPECT_GT(excess[k], 0);
  }
  EXPECT_NEAR(std::log2(excess[0] / excess[1]), 4, 0.3);
  EXPECT_NEAR(std::log2(excess[1] / excess[2]), 4, 0.3);
  EXPECT_LT(excess[2], 1e-5);
}

}  // namespace
}  // namespace hamjet::thrusted
