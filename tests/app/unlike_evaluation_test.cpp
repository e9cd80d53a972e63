#include <gtest/gtest.h>

#include <cmath>

#include "app/deputy_evaluation.hpp"
#include "hamjet/error.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "studies/exact_flow.hpp"
#include "studies/formation/formation_problem.hpp"

// Polynomials of a scene whose deputy is unlike its chief are of spacecraft like the deputy.

namespace hamjet::unlike_evaluation_tests {
namespace {

Scene scene_with(const std::string& deputy, const std::string& position = "[10, -300, 20]") {
  return io::parse_scene(
      "[system]\nmodel = \"earth\"\ngravity_degree = 4\natmosphere = \"harris-priester\"\n"
      "[spacecraft]\ndrag_m2_kg = 0.02\n[nominal]\nepoch_utc = \"2026-03-01T06:00:00\"\n"
      "height_km = 400\ni_deg = 97.5\nraan_deg = 30\nu_deg = 0\n[deputy]\n"
      "position_m = " +
          position + "\n" + deputy + "[jet]\norder = 3\nduration_s = 12000\n",
      "file.toml");
}

/// The deputy's final deviation from its chief, by the polynomials; the estimate of the miss too.
std::vector<double> predicted(const Scene& scene, double& miss_m) {
  const cli::EvaluatedScene evaluated = cli::evaluated_scene(scene);
  cli::DeputyEvaluation evaluation(evaluated, scene.order, 1);
  std::vector<double> start = deputy_deviation(scene);
  evaluation.add(start);
  std::vector<double> end;
  evaluation.run([&](const std::vector<double>& deviation, const cli::MissEstimate& estimate) {
    end = deviation;
    miss_m = estimate.miss_m();
  });
  return end;
}

TEST(UnlikeEvaluation, IsThatOfFlightsWithOwnCoefficients) {
  const Scene scene = scene_with("spacecraft = {drag_m2_kg = 0.05}\n");
  double miss_m = 0;
  const std::vector<double> end = predicted(scene, miss_m);
  std::vector<double> deputy = scene.nominal;
  const std::vector<double> start = deputy_deviation(scene);
  for (std::size_t i = 0; i < 6; ++i) deputy[i] += start[i];
  const auto flown = [&](const Scene& one, const std::vector<double>& state) {
    return exact_flow(make_problem(one).system, state, one.start_time, one.duration);
  };
  const std::vector<double> chief = flown(scene, scene.nominal);
  const std::vector<double> other = flown(with_deputy_coefficients(scene), deputy);
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) square += std::pow(end[i] - (other[i] - chief[i]), 2);
  const double length_m = scene.units.length_km * 1000;
  EXPECT_LT(std::sqrt(square) * length_m, std::max(miss_m, 1e-5));
  // With the chief's coefficient it would end tens of metres away.
  const std::vector<double> alike = predicted(scene_with(""), miss_m);
  double apart = 0;
  for (std::size_t i = 0; i < 3; ++i) apart += std::pow(end[i] - alike[i], 2);
  EXPECT_GT(std::sqrt(apart) * length_m, 10);
}

// Where both start alike, polynomials of the deviation add nothing, and the answer is the
// difference of two flights. A place 6778 km from the centre is rounded to 0.9 nm.
TEST(UnlikeEvaluation, OfTheChiefsPlaceIsNoBetterThanTwoFlights) {
  double miss_m = 0;
  predicted(scene_with("spacecraft = {drag_m2_kg = 0.05}\n", "[0, 0, 0]"), miss_m);
  EXPECT_GT(miss_m, 1e-9);
}

}  // namespace
}  // namespace hamjet::unlike_evaluation_tests
