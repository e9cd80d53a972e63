#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/uncertainty/encounter.hpp"
#include "support/reference_data.hpp"

namespace hamjet::test {

/// A case of S. Alfano, "Satellite Conjunction Monte Carlo Analysis", AAS 09-233 (2009), as
/// distributed with NASA's CARA Analysis Tools; see data/references. Motion is by Kepler's problem,
/// in units of the first spacecraft's distance and mu = 1.
struct PublishedEncounter {
  int number = 0;
  double length_m = 1, time_s = 1;
  double approach_s = 0;  ///< from the epoch to the closest approach of the means
  EncounterProblem problem{kepler(), {}, ClockTime::epoch()};  ///< a problem of order 3
  double probability = 0;                                      ///< from 1e8 samples
  double lower = 0;  ///< the 95 % interval of the probability
  double upper = 0;
  std::optional<double> short_encounter;  ///< by the integral in the plane of encounter
};

inline PublishedEncounter published_encounter(const nlohmann::json& data) {
  constexpr double mu = 3.986004418e14;
  PublishedEncounter e;
  e.number = data["case"];
  const auto& r = data["objects_at_epoch"][0]["position_m"];
  e.length_m = std::hypot(r[0].get<double>(), r[1].get<double>(), r[2].get<double>());
  e.time_s = std::sqrt(std::pow(e.length_m, 3) / mu);
  e.approach_s = data["tca_s_after_epoch"];
  const double window = data["window_s_about_tca"];
  e.problem.from = (e.approach_s - window) / e.time_s;
  e.problem.to = (e.approach_s + window) / e.time_s;
  e.problem.radius = data["hard_body_radius_m"].get<double>() / e.length_m;
  e.problem.order = 3;
  e.problem.settings.tolerance = 1e-12;
  const auto unit = [&](std::size_t i) { return i < 3 ? e.length_m : e.length_m / e.time_s; };
  for (std::size_t craft = 0; craft < 2; ++craft) {
    const auto& object = data["objects_at_epoch"][craft];
    Eigen::Matrix<double, 6, 6> covariance;
    for (std::size_t i = 0; i < 6; ++i) {
      const double x = i < 3 ? object["position_m"][i] : object["velocity_m_s"][i - 3];
      e.problem.spacecraft[craft].state.push_back(x / unit(i));
      for (std::size_t j = 0; j < 6; ++j) {
        covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            object["covariance_m_m_s"][i][j].get<double>() / (unit(i) * unit(j));
      }
    }
    e.problem.spacecraft[craft].factor = covariance.llt().matrixL();
  }
  const auto& probability = data["probability"];
  e.probability = probability["monte_carlo_1e8_two_body"];
  e.lower = probability["monte_carlo_95_percent"][0];
  e.upper = probability["monte_carlo_95_percent"][1];
  if (!probability["short_encounter_2d"].is_null()) {
    e.short_encounter = probability["short_encounter_2d"].get<double>();
  }
  return e;
}

inline std::vector<PublishedEncounter> published_encounters() {
  std::vector<PublishedEncounter> result;
  for (const auto& data : read_reference_file("alfano2009.json")) {
    result.push_back(published_encounter(data));
  }
  return result;
}

}  // namespace hamjet::test
