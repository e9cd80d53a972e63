#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/uncertainty/covariance.hpp"
#include "hamjet/uncertainty/encounter.hpp"
#include "support/reference_data.hpp"

namespace hamjet::test {

/// A real conjunction whose probability NASA's CARA Analysis Tools publish; see data/references.
/// The epoch is that of the closest approach, and motion is by Kepler's problem, in units of the
/// first spacecraft's distance and mu = 1. Both states are Gaussian in Poincaré's elements.
struct RealEncounter {
  int number = 0;
  EncounterProblem problem{kepler(), {}, ClockTime::epoch()};  ///< a problem of order 3
  double probability = 0;                                      ///< from plain samples
  double lower = 0;  ///< the 95 % interval of the probability
  double upper = 0;
};

inline RealEncounter real_encounter(const nlohmann::json& data) {
  constexpr double mu = 398600.4418;
  RealEncounter e;
  e.number = data["case"];
  const auto& first = data["objects"][0]["position_km"];
  const double length =
      std::hypot(first[0].get<double>(), first[1].get<double>(), first[2].get<double>());
  const double speed = std::sqrt(mu / length);
  e.problem.radius = data["radius_m"].get<double>() / (1000 * length);
  e.problem.order = 3;
  e.problem.settings.tolerance = 1e-12;
  double period = 1e9;
  for (std::size_t craft = 0; craft < 2; ++craft) {
    const auto& object = data["objects"][craft];
    SixNumbers<double> state{};
    Eigen::Matrix<double, 6, 6> covariance;
    for (std::size_t i = 0; i < 6; ++i) {
      state[i] = i < 3 ? object["position_km"][i].get<double>() / length
                       : object["velocity_km_s"][i - 3].get<double>() / speed;
      for (std::size_t j = 0; j <= i; ++j) {
        const auto unit = [&](std::size_t k) { return 1000 * (k < 3 ? length : speed); };
        const double entry = object["covariance_rtn"][i][j].get<double>() / (unit(i) * unit(j));
        covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = entry;
        covariance(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) = entry;
      }
    }
    const Eigen::Vector3d position(state[0], state[1], state[2]);
    const Eigen::Vector3d velocity(state[3], state[4], state[5]);
    Eigen::Matrix3d axes;
    axes.col(0) = position.normalized();
    axes.col(2) = position.cross(velocity).normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    Eigen::Matrix<double, 6, 6> both = Eigen::Matrix<double, 6, 6>::Zero();
    both.topLeftCorner<3, 3>() = both.bottomRightCorner<3, 3>() = axes;
    const Matrix<double> factor = both * Covariance(covariance).factor();
    UncertainSpacecraft& spacecraft = e.problem.spacecraft[craft];
    spacecraft.state.assign(state.begin(), state.end());
    spacecraft.factor.leftCols(factor.cols()) = factor;
    spacecraft.straight.emplace(CanonicalChart<double>(ChartName::poincare, state, 1.0), state);
    const double a = 1 / (2 / position.norm() - velocity.squaredNorm());
    period = std::min(period, 2 * std::numbers::pi * std::pow(a, 1.5));
  }
  e.problem.from = -period / 4;
  e.problem.to = period / 4;
  e.probability = data["monte_carlo"];
  e.lower = data["interval"][0];
  e.upper = data["interval"][1];
  return e;
}

inline std::vector<RealEncounter> real_encounters() {
  std::vector<RealEncounter> result;
  for (const auto& data : read_reference_file("cara_conjunctions.json")) {
    result.push_back(real_encounter(data));
  }
  return result;
}

}  // namespace hamjet::test
