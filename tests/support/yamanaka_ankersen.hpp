#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <vector>

// Linear relative motion about an ellipse in closed form. Source: Yamanaka and Ankersen, New state
// transition matrix for relative motion on an arbitrary elliptical orbit, J. Guidance, Control, and
// Dynamics 25 (2002) 60, eq. 82.

namespace hamjet::test {

/// An ellipse with mu = 1 and its perigee at distance 1 on the first axis.
class UnitEllipse {
 public:
  explicit UnitEllipse(double e) : e_(e), p_(1 + e), h_(std::sqrt(p_)) {}

  double rho(double anomaly) const { return 1 + e_ * std::cos(anomaly); }
  /// dt / d(anomaly).
  double slowness(double anomaly) const { return 1 / (rate_ * rho(anomaly) * rho(anomaly)); }
  std::vector<double> state_at(double anomaly) const {
    const double r = p_ / rho(anomaly);
    return {r * std::cos(anomaly),   r * std::sin(anomaly),         0,
            -std::sin(anomaly) / h_, (e_ + std::cos(anomaly)) / h_, 0};
  }
  /// Time since the perigee, by Kepler's equation.
  double time_at(double anomaly) const {
    const double a = p_ / (1 - e_ * e_);
    const double turns = std::floor((anomaly + std::numbers::pi) / (2 * std::numbers::pi));
    const double rest = anomaly - 2 * std::numbers::pi * turns;
    const double E = 2 * std::atan(std::sqrt((1 - e_) / (1 + e_)) * std::tan(rest / 2));
    return std::pow(a, 1.5) * (E - e_ * std::sin(E) + 2 * std::numbers::pi * turns);
  }

  /// The matrix from one true anomaly to another in (R, T, N) and their derivatives in the rotating
  /// axes.
  Eigen::Matrix<double, 6, 6> transition(double first, double last) const {
    const double elapsed = rate_ * (time_at(last) - time_at(first));
    const Eigen::Matrix4d plane = scaling(last).inverse() * in_plane_solutions(last, elapsed) *
                                  in_plane_solutions(first, 0).inverse() * scaling(first);
    // x = T, z = -R.
    constexpr Eigen::Index place[] = {1, 0, 4, 3};
    constexpr double sign[] = {1, -1, 1, -1};
    Eigen::Matrix<double, 6, 6> all = Eigen::Matrix<double, 6, 6>::Zero();
    for (Eigen::Index i = 0; i < 4; ++i) {
      for (Eigen::Index j = 0; j < 4; ++j)
        all(place[i], place[j]) = sign[i] * sign[j] * plane(i, j);
    }
    // Across the plane a harmonic oscillation in the anomaly, scaled alike.
    const double angle = last - first;
    Eigen::Matrix2d turn;
    turn << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
    const Eigen::Matrix2d across = scaling_across(last).inverse() * turn * scaling_across(first);
    for (Eigen::Index i = 0; i < 2; ++i) {
      for (Eigen::Index j = 0; j < 2; ++j) all(2 + 3 * i, 2 + 3 * j) = across(i, j);
    }
    return all;
  }

 private:
  /// Solutions of Tschauner and Hempel's equations at a true anomaly, as columns: in the plane
  /// (x, z, x', z') with x along the motion and z to the centre, in the variables scaled by rho,
  /// derivatives by the anomaly; J is the integral of the time.
  Eigen::Matrix4d in_plane_solutions(double anomaly, double J) const {
    const double s = rho(anomaly) * std::sin(anomaly);
    const double c = rho(anomaly) * std::cos(anomaly);
    const double r = rho(anomaly);
    const double ds = std::cos(anomaly) + e_ * std::cos(2 * anomaly);
    const double dc = -(std::sin(anomaly) + e_ * std::sin(2 * anomaly));
    Eigen::Matrix4d phi;
    phi << 1, -c * (1 + 1 / r), s * (1 + 1 / r), 3 * r * r * J,  //
        0, s, c, 2 - 3 * e_ * s * J,                             //
        0, 2 * s, 2 * c - e_, 3 * (1 - 2 * e_ * s * J),          //
        0, ds, dc, -3 * e_ * (ds * J + s / (r * r));
    return phi;
  }
  /// (x, z, x', z') scaled, from the unscaled (x, z, dx/dt, dz/dt).
  Eigen::Matrix4d scaling(double anomaly) const {
    Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
    m.topLeftCorner<2, 2>() = rho(anomaly) * Eigen::Matrix2d::Identity();
    m.bottomLeftCorner<2, 2>() = -e_ * std::sin(anomaly) * Eigen::Matrix2d::Identity();
    m.bottomRightCorner<2, 2>() = 1 / (rate_ * rho(anomaly)) * Eigen::Matrix2d::Identity();
    return m;
  }
  Eigen::Matrix2d scaling_across(double anomaly) const {
    Eigen::Matrix2d m;
    m << rho(anomaly), 0, -e_ * std::sin(anomaly), 1 / (rate_ * rho(anomaly));
    return m;
  }

  double e_;
  double p_;
  double h_;
  double rate_ = h_ / (p_ * p_);  ///< the anomaly's rate is this times rho^2
};

}  // namespace hamjet::test
