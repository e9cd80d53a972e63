
#include "charts/driven_flow_box.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "driven_scenes.hpp"
#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "studies/exact_flow.hpp"
#include "studies/formation/charts/deputy_flows.hpp"
#include "studies/formation/jets_about_time.hpp"
#include "studies/made_up_field.hpp"
#include "studies/random_direction.hpp"
#include "support/temporary_directory.hpp"

// Flow boxes of forces that depend on the time. Expected: flights with the full equations, by
// Boost.odeint about a driven body of the tests' own, and by the library's integrator about the
// real Earth, which the polynomials do not use for deputies.

namespace hamjet {
namespace {

using test::driven_flight;

double apart_m(const SixNumbers<double>& deviation, const SixNumbers<double>& chief,
               const std::vector<double>& flown, double length_m) {
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) square += std::pow(chief[i] + deviation[i] - flown[i], 2);
  return std::sqrt(square) * length_m;
}

/// A chief about the real Earth, the polynomials of a jet, and deputies that are flown.
struct RealChief {
  RealChief(const std::string& nominal, const std::string& duration_s,
            const std::string& field = "")
      : scene(io::parse_scene("schema = 1\n[system]\nmodel = \"earth\"\n" + field +
                                  "[nominal]\nepoch_utc = \"2026-03-01T06:00:00\"\n" + nominal +
                                  "\n[jet]\norder = 4\nduration_s = " + duration_s + "\n",
                              "chief.toml")),
        problem(make_problem(scene)),
        start(six_numbers(problem.nominal)),
        length_m(scene.units.length_km * 1000) {}

  std::unique_ptr<DeputyFlow> flow(JetCoordinates coordinates) const {
    return DeputyFlowPropagation(scene, problem, scene.integrators.front(), coordinates)
        .advance_to(scene.duration);
  }
  double miss_m(const DeputyFlow& flow, const SixNumbers<double>& deviation) const {
    std::vector<double> deputy = problem.nominal;
    for (std::size_t i = 0; i < 6; ++i) deputy[i] += deviation[i];
    return apart_m(flow.predict(deviation, scene.order).deviation, flow.chief_end(),
                   exact_flow(problem.system, deputy, problem.start_time, scene.duration),
                   length_m);
  }

  Scene scene;
  ComputedProblem problem;
  SixNumbers<double> start;
  double length_m;
};

const std::string low = "height_km = 514\ni_deg = 97.5\nraan_deg = 30\nu_deg = 0";

TEST(DrivenFlowBox, ADeputy220KilometresAlongTheOrbitAfterADay) {
  const RealChief chief(low, "86400");
  const CanonicalChart<double> elements(ChartName::nodal, chief.start, 1);
  SixNumbers<double> moved = elements.coordinates(chief.start);
  moved[0] += 220e3 / chief.length_m / std::hypot(chief.start[0], chief.start[1], chief.start[2]);
  SixNumbers<double> deviation = elements.state(moved);
  for (std::size_t i = 0; i < 6; ++i) deviation[i] -= chief.start[i];
  EXPECT_LT(chief.miss_m(*chief.flow(JetCoordinates::flow_box), deviation), 0.01);
  EXPECT_GT(chief.miss_m(*chief.flow(JetCoordinates::cartesian), deviation), 1e4);
}

/// Deputies at this separation, with this separation times the mean motion as velocity: at random,
/// and where the energy changes most.
std::vector<SixNumbers<double>> deputies(const RealChief& chief, double separation_m) {
  const auto& z = chief.start;
  const double r = std::hypot(z[0], z[1], z[2]);
  const double a = 1 / (2 / r - (z[3] * z[3] + z[4] * z[4] + z[5] * z[5]));
  std::vector<SixNumbers<double>> result;
  std::mt19937_64 generator(5);
  for (int k = 0; k < 5; ++k) {
    std::array<std::vector<double>, 2> directions = {random_direction(generator, 3),
                                                     random_direction(generator, 3)};
    if (k == 0) directions = {{{z[0], z[1], z[2]}, {z[3], z[4], z[5]}}};
    SixNumbers<double> deviation;
    for (std::size_t part = 0; part < 2; ++part) {
      const auto& d = directions[part];
      const double size = separation_m / chief.length_m * (part == 0 ? 1 : std::pow(a, -1.5)) /
                          std::hypot(d[0], d[1], d[2]);
      for (std::size_t i = 0; i < 3; ++i) deviation[3 * part + i] = d[i] * size;
    }
    result.push_back(deviation);
  }
  return result;
}

double worst_m(const RealChief& chief, const DeputyFlow& flow, double separation_m) {
  double worst = 0;
  for (const auto& deputy : deputies(chief, separation_m)) {
    worst = std::max(worst, chief.miss_m(flow, deputy));
  }
  return worst;
}

TEST(DrivenFlowBox, ReachesEightTimesAsFarAboutTheRealEarth) {
  struct Case {
    const char* name;
    std::string nominal;
    const char* duration_s;
    double cartesian_m;  ///< a separation beyond the reach of order 4 in positions and velocities
  };
  const std::string tilted = "\nraan_deg = 30\nargp_deg = 40\nta_deg = 20";
  const Case cases[] = {
      {"low orbit, two revolutions", low, "11400", 9400},
      {"low orbit, a day", low, "86400", 1440},
      {"e = 0.3", "a_km = 10000\ne = 0.3\ni_deg = 60" + tilted, "19900", 4400},
      {"Molniya",
       "a_km = 26562\ne = 0.74\ni_deg = 63.4\nraan_deg = 30\nargp_deg = 270\nta_deg = 11", "86164",
       480},
      {"geostationary", "a_km = 42165\ne = 0.0001\ni_deg = 0.05" + tilted, "86164", 71500}};
  for (const Case& one : cases) {
    const RealChief chief(one.nominal, one.duration_s);
    EXPECT_GT(worst_m(chief, *chief.flow(JetCoordinates::cartesian), one.cartesian_m), 1)
        << one.name;
    EXPECT_LT(worst_m(chief, *chief.flow(JetCoordinates::flow_box), 8 * one.cartesian_m), 1)
        << one.name;
  }
}

/// Deputies that are 24 km away fly by the chief's angle at the end some 500 km before or after it.
/// Expected: that the polynomials are right over times in which a field of degree 70 changes.
TEST(DrivenFlowBox, ReachesAsFarInAFieldOfShortWaves) {
  const test::TemporaryDirectory folder;
  const auto file = folder.path() / "made_up.gfc";
  test::write_made_up_field(file);
  const RealChief chief(low, "11400",
                        "gravity_file = \"" + file.string() + "\"\ngravity_degree = 70\n");
  EXPECT_LT(worst_m(chief, *chief.flow(JetCoordinates::flow_box), 24e3), 0.2);
}

/// The miss of each degree falls as the separation to the power of the next one.
TEST(DrivenFlowBox, EachDegreeIsRight) {
  Scene scene = driven_chief(3);
  scene.duration = 8;
  const ComputedProblem problem = make_problem(scene);
  const auto flow = DeputyFlowPropagation(scene, problem, precise_gauss(), JetCoordinates::flow_box)
                        .advance_to(scene.duration);
  const std::vector<double> direction = {2, -1, 3, 1, 2, -1};
  for (int degree = 1; degree <= 3; ++degree) {
    std::array<double, 2> misses;
    const std::array<double, 2> sizes = {degree == 1 ? 1e-4 : 1e-3, degree == 1 ? 4e-4 : 4e-3};
    for (std::size_t k = 0; k < 2; ++k) {
      SixNumbers<double> deviation;
      std::vector<double> deputy = scene.nominal;
      for (std::size_t i = 0; i < 6; ++i) {
        deviation[i] = sizes[k] * direction[i];
        deputy[i] += deviation[i];
      }
      misses[k] = apart_m(flow->predict(deviation, degree).deviation, flow->chief_end(),
                          driven_flight(deputy, late, scene.duration), 1);
    }
    EXPECT_NEAR(std::log(misses[1] / misses[0]) / std::log(4), degree + 1, 0.35) << degree;
  }
}

/// The coordinates at the end as series agree with the crossing that variables and values give.
TEST(DrivenFlowBox, EndCoordinates) {
  Scene scene = driven_chief(3);
  const ComputedProblem problem = make_problem(scene);
  const IntegratorSettings settings = precise_gauss();
  JetPropagation jets(problem, settings);
  const FlowJet<double> jet = jets.advance_to(scene.duration);
  const auto box = driven_flow_box(scene, problem, scene.duration, jet);
  const std::vector<Series<double>> end = box->end_coordinates();
  const FlowMap<double> coordinates(end);
  const FlowMap<double> values(box->values());
  const SixNumbers<double> start = six_numbers(scene.nominal);
  SixNumbers<double> state = start;
  std::vector<double> deviation = {2e-4, -1e-4, 3e-4, 1e-4, 2e-4, -1e-4};
  for (std::size_t i = 0; i < 6; ++i) state[i] += deviation[i];
  const SixNumbers<double> u = box->variables(state);
  const auto crossing =
      box->crossing(u, six_numbers(values.evaluate(std::vector<double>(u.begin(), u.end()))));
  const std::vector<double> found = coordinates.evaluate(deviation);
  EXPECT_NEAR(found[0], -crossing.time, 1e-10);
  const CanonicalChart<double> chart(ChartName::nodal, box->chief_end(), 1);
  const auto at_crossing = chart.coordinates(crossing.state);
  const auto chief = chart.coordinates(box->chief_end());
  EXPECT_NEAR(at_crossing[0], chief[0], 1e-12);
  EXPECT_NEAR(found[2], at_crossing[1] - chief[1], 1e-10);
  EXPECT_NEAR(found[5], at_crossing[5] - chief[5], 1e-10);
  // It is the flow that carries a deputy there.
  const std::vector<double> flown = driven_flight(std::vector<double>(state.begin(), state.end()),
                                                  late, scene.duration + crossing.time);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(flown[i], crossing.state[i], 1e-9);
}

/// Powers of the time against an integration: the coefficients of degree d, which have powers up to
/// the order less d, miss it by a multiple of the next one.
TEST(DrivenFlowBox, JetsAboutATime) {
  const Scene scene = driven_chief(3);
  const ComputedProblem problem = make_problem(scene);
  const IntegratorSettings settings = precise_gauss();
  JetPropagation jets(problem, settings);
  const double time = 3;
  const FlowJet<double> jet = jets.advance_to(time);
  const std::vector<FlowJet<double>> powers =
      jets_about_time(*problem.system, problem.start_time + time, jet);
  ASSERT_EQ(powers.size(), 4U);
  const SeriesSpace& space = jet[0].space();
  const auto largest_miss = [&](double t, int degree) {
    JetPropagation later = jets;
    const FlowJet<double> there = later.advance_to(time + t);
    double largest = 0;
    for (std::size_t c = 0; c < 6; ++c) {
      for (std::size_t j = space.first(degree); j < space.first(degree + 1); ++j) {
        double sum = 0;
        for (std::size_t k = powers.size(); k-- > 0;) sum = sum * t + powers[k][c][j];
        largest = std::max(largest, std::abs(sum - there[c][j]));
      }
    }
    return largest;
  };
  for (int degree = 0; degree <= 3; ++degree) {
    EXPECT_NEAR(std::log2(largest_miss(0.02, degree) / largest_miss(0.01, degree)), 4 - degree, 0.1)
        << degree;
  }
}

TEST(DrivenFlowBox, AnOrbitThatIsNoEllipseIsRefused) {
  const RealChief chief("position_km = [7000, 0, 0]\nvelocity_km_s = [0, 11, 2]", "3600");
  try {
    chief.flow(JetCoordinates::flow_box);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    // The scene asks for what its start does not have.
    EXPECT_EQ(error.kind(), ErrorKind::scene);
    EXPECT_NE(std::string(error.what()).find("flow-box at the start"), std::string::npos);
  }
}

/// Near a high apogee times about an end lie hours before the scene's start and after its end. The
/// speeds along the motion there are small, and a deputy of 10 km is far from all that bends.
TEST(DrivenFlowBox, FewMinutesAfterAHighApogee) {
  for (const std::string a_km : {"66000", "150000"}) {
    const RealChief chief(
        "a_km = " + a_km + "\ne = 0.5\ni_deg = 30\nraan_deg = 30\nargp_deg = 40\nta_deg = 180",
        "600\ncoordinates = \"flow-box\"");
    EXPECT_LT(worst_m(chief, *chief.flow(JetCoordinates::flow_box), 1e4), 1e-3) << a_km;
  }
}

/// A deputy that crosses the section at a time at which no forces are known has no place, and does
/// not take the places of the others.
TEST(DrivenFlowBox, ACrossingBeyondWhatIsKnown) {
  const RealChief chief(low, "86400");
  const auto flow = chief.flow(JetCoordinates::flow_box);
  std::vector<SixNumbers<double>> starts(2);
  starts[0] = deputies(chief, 1e3)[0];
  // Faster along the motion by a tenth: it is revolutions behind after a day.
  for (std::size_t i = 3; i < 6; ++i) starts[1][i] = 0.1 * chief.start[i];
  std::vector<DeputyPrediction> predicted(2);
  DeputyPredictor(*flow).predict(starts, chief.scene.order, predicted);
  EXPECT_FALSE(std::isfinite(predicted[1].deviation[0]));
  EXPECT_EQ(predicted[0].deviation, flow->predict(starts[0], chief.scene.order).deviation);
}

}  // namespace
}  // namespace hamjet
