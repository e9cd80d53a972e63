#include "studies/bounded/bounded_formation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "charts/secular_motion.hpp"
#include "formation_scenes.hpp"
#include "hamjet/error.hpp"
#include "poincare/independent_flight.hpp"
#include "report/bounded/bounded_report.hpp"
#include "report/bounded/frozen_orbit_report.hpp"
#include "studies/bounded/frozen_orbit_study.hpp"
#include "studies/bounded/mean_element_deputies.hpp"
#include "studies/bounded/relative_orbit_extent.hpp"
#include "studies/formation/charts/deputy_flows.hpp"

namespace hamjet {
namespace {

/// A chief at the start of a circle of 7000 km at 50 degrees, in J2.
Scene oblate_circle(int order, double eccentricity = 0) {
  Scene scene = kepler_chief(0, 7000, std::sqrt(std::pow(7000.0, 3) / 398600.4415), order);
  scene.system.model = SystemModel::zonal_gravity;
  scene.system.J[2] = 1.0826266835e-3;
  scene.system.J[3] = -2.5326564853e-6;
  scene.canonical_radius = 6378.1363 / 7000;
  const double angle = 50 * std::numbers::pi / 180;
  const double speed = std::sqrt(1 + eccentricity);
  scene.nominal = {1, 0, 0, 0, speed * std::cos(angle), speed * std::sin(angle)};
  scene.bounded = BoundedSettings{};
  scene.bounded->revolutions = 40;
  scene.bounded->sizes_m = {1e4};
  return scene;
}

const BoundedDeputy& deputy_by(const BoundedFormation& formation, BoundedRule rule) {
  for (const BoundedDeputy& deputy : formation.deputies) {
    if (deputy.rule == rule) return deputy;
  }
  throw Error(ErrorKind::usage, "no such deputy");
}

// Clohessy and Wiltshire: a difference of eccentricity by de moves a deputy about a circle by a de
// along R and 2 a de along T, and one of the node by what cross_track says along N; the largest
// distance is the size that was asked for.
TEST(BoundedFormation, HasTheSizeAndShapeOfClohessyAndWiltshire) {
  const BoundedFormation formation = study_bounded(oblate_circle(3));
  const BoundedDeputy& deputy = deputy_by(formation, BoundedRule::poincare_map);
  ASSERT_EQ(deputy.failure, "");
  EXPECT_NEAR(deputy.size_m, 1e4, 2);
  const Eigen::Vector3d widths = half_widths_m(deputy.first);
  // The remaining differences are of the order of J2 and of the square of the size over the
  // distance.
  constexpr double left = 5e-3;
  EXPECT_NEAR(widths[0], 7e6 * deputy.amplitude, left * widths[0]);
  EXPECT_NEAR(widths[1], 2 * widths[0], left * widths[1]);
  EXPECT_NEAR(widths[2], 0.5 * 1e4, left * widths[2]);
}

// Over the window the flown deputy of the map stays nearer than the deputy of first-order J2
// invariance, and the refined one stays at least as near.
TEST(BoundedFormation, StaysBetterThanByTheoriesOfFirstOrder) {
  Scene scene = oblate_circle(4, 0.05);
  scene.bounded->sizes_m = {3e5};
  const BoundedFormation formation = study_bounded(scene);
  ASSERT_EQ(formation.deputies.size(), 4U);
  const auto drift = [&](BoundedRule rule) {
    const BoundedDrift& found = deputy_by(formation, rule).drifts.back();
    EXPECT_EQ(found.revolutions, 40);
    return std::hypot(found.along, found.cross);
  };
  const double map = drift(BoundedRule::poincare_map);
  EXPECT_LT(map, 1e-6);
  EXPECT_LE(drift(BoundedRule::refined), map);
  EXPECT_GT(drift(BoundedRule::j2_invariant), 10 * map);
  EXPECT_GT(drift(BoundedRule::mean_elements), drift(BoundedRule::j2_invariant));
}

// The start in each form describes the same deputy: all six forms give back the canonical
// deviations.
TEST(BoundedFormation, TellsTheStartInEveryForm) {
  const Scene scene = oblate_circle(3, 0.05);
  const BoundedFormation formation = study_bounded(scene);
  const MetricUnits units{scene.units.length_km * 1000, scene.units.time_s};
  for (const BoundedDeputy& deputy : formation.deputies) {
    for (std::size_t f = 0; f < deputy.forms.size(); ++f) {
      const DeputyCoordinates form(scene.nominal, units, 1, static_cast<DeputyForm>(f));
      const auto deviation = form.deviation(deputy.forms[f]);
      for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(deviation[i], deputy.state[i] - scene.nominal[i], 1e-14) << f;
      }
    }
  }
}

// The chief's own orbit, flown a little later, keeps its distance: a deputy behind needs no impulse
// on the orbit and field of heyoka's box control, which costs 0.0617 m/s a day. The distance
// changes along the orbit by twice the eccentricity alone.
TEST(BoundedFormation, ADeputyBehindStaysInItsBox) {
  Scene scene = oblate_circle(3);
  scene.system.J[2] = 1082.645e-6;
  scene.system.J[3] = 0;
  scene.canonical_radius = 6371.0 / 7121;
  const double angle = 98.2 * std::numbers::pi / 180;
  scene.nominal = {1, 0, 0, 0, std::cos(angle), std::sin(angle)};
  scene.units = {7121, std::sqrt(std::pow(7121.0, 3) / 398600.4418)};
  scene.bounded->sizes_m = {100};
  scene.bounded->along_track = -1;
  scene.bounded->cross_track = 0;
  scene.bounded->revolutions = 200;
  const BoundedFormation formation = study_bounded(scene);
  const BoundedDeputy& deputy = deputy_by(formation, BoundedRule::poincare_map);
  ASSERT_EQ(deputy.failure, "");
  EXPECT_EQ(deputy.amplitude, 0);
  for (const auto* orbit : {&deputy.first, &deputy.last}) {
    for (const RelativeState& state : *orbit) {
      EXPECT_NEAR(state.position_m[1], -100, 0.5);
      EXPECT_LT(std::abs(state.position_m[0]), 0.5);
      EXPECT_LT(std::abs(state.position_m[2]), 0.5);
    }
  }
  EXPECT_LT(std::abs(deputy.drifts.back().along), 1e-8);
}

// Both are flown on by Boost.odeint in long double, with an acceleration written by hand, to the
// end of the window and for one revolution more.
TEST(BoundedFormation, SizesInTheWindowAreThoseOfAnIndependentFlight) {
  Scene scene = oblate_circle(3, 0.05);
  scene.bounded->sizes_m = {1e6};
  scene.bounded->refine = false;
  const BoundedFormation formation = study_bounded(scene);
  const BoundedDeputy& deputy = deputy_by(formation, BoundedRule::mean_elements);
  ZonalGravity field;
  field.radius = scene.canonical_radius;
  field.J[2] = scene.system.J[2];
  field.J[3] = scene.system.J[3];
  const test::IndependentFlight fly(field);
  auto chief = test::long_state(six_numbers(scene.nominal));
  auto at = test::long_state(six_numbers(deputy.state));
  const long double window = formation.revolutions * formation.nodal_period;
  chief = fly(chief, window);
  at = fly(at, window);
  constexpr int looks = 200;
  double size = 0;
  for (int k = 0; k < looks; ++k) {
    size = std::max(size, static_cast<double>(
                              std::hypot(at[0] - chief[0], at[1] - chief[1], at[2] - chief[2])));
    chief = fly(chief, formation.nodal_period / looks);
    at = fly(at, formation.nodal_period / looks);
  }
  EXPECT_NEAR(deputy.last_size_m, size * 7e6, 1e-3 * deputy.last_size_m);
  EXPECT_LE(deputy.least_size_m, deputy.last_size_m);
  EXPECT_GE(deputy.largest_size_m, deputy.last_size_m);
  EXPECT_NEAR(deputy.size_m, 1e6, 1e3);
}

// A small drift alone does not make a deputy the requested formation.
TEST(BoundedFormation, ASizeThatIsNotHeldIsMarked) {
  BoundedFormation formation = study_bounded(oblate_circle(3));
  EXPECT_NE(io::bounded_verdict(formation).find("Sizes are held to a quarter"), std::string::npos);
  EXPECT_EQ(io::bounded_report(formation, {}).exit_code, 0);
  for (BoundedDeputy& deputy : formation.deputies) {
    if (deputy.rule != BoundedRule::refined) continue;
    EXPECT_TRUE(deputy.is_held());
    deputy.largest_size_m = 3 * deputy.wanted_m;
    EXPECT_FALSE(deputy.is_held());
  }
  EXPECT_NE(io::bounded_verdict(formation).find(
                "NOT HELD are the sizes of 1 of 2 deputies: where 10 km was asked for"),
            std::string::npos)
      << io::bounded_verdict(formation);
  const io::StudyReport report = io::bounded_report(formation, {});
  EXPECT_EQ(report.exit_code, 1);
  EXPECT_NE(report.table.find("NOT HELD"), std::string::npos);
}

// Schaub and Alfriend's rule makes Brouwer's rates equal to first order: what is left of the
// differences of mean argument of latitude and node falls with the square of the amplitude, where
// equal mean elements leave the first.
TEST(MeanElementDeputies, AreInvariantToFirstOrder) {
  const Scene scene = oblate_circle(2, 0.1);
  ZonalGravity field;
  field.radius = scene.canonical_radius;
  field.J[2] = 1e-6;
  SixNumbers<double> chief;
  std::copy_n(scene.nominal.begin(), 6, chief.begin());
  const auto rates = [&](const SixNumbers<double>& state) {
    // Osculating elements differ from the mean ones by periodic terms; the rates' energy is the
    // orbit's own, and L - G and H of the mean ones differ from these by the order of J2.
    const CanonicalChart<double> chart(ChartName::nodal, state, 1);
    const auto z = chart.coordinates(state);
    double radius = std::hypot(state[0], state[1], state[2]);
    double kinetic = 0;
    for (std::size_t i = 3; i < 6; ++i) kinetic += state[i] * state[i] / 2;
    const double s = state[2] / radius;
    const double energy =
        kinetic -
        (1 - field.J[2] * std::pow(field.radius / radius, 2) * (3 * s * s - 1) / 2) / radius;
    const auto r = secular_rates<double, double>(energy, (z[2] * z[2] + z[5] * z[5]) / 2, z[4], 1,
                                                 field.J[2] * field.radius * field.radius);
    return std::array<double, 2>{r.anomaly + r.pericentre, r.node};
  };
  const auto difference = [&](MeanElementRule rule, double amplitude) {
    const auto of_chief = rates(chief);
    const auto of_deputy =
        rates(mean_element_deputy(field, chief, rule, 0.3 * amplitude, amplitude));
    return std::hypot(of_deputy[0] - of_chief[0], of_deputy[1] - of_chief[1]);
  };
  const double coarse = difference(MeanElementRule::j2_invariant, 2e-2);
  const double fine = difference(MeanElementRule::j2_invariant, 1e-2);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3);
  EXPECT_GT(difference(MeanElementRule::equal_elements, 1e-2), 5 * fine);
}

// A follower that cross_track and along_track alone take too far is refused at its size; the other
// deputies are not refused.
TEST(BoundedFormation, SaysWhichSizeHasNoDeputy) {
  Scene scene = oblate_circle(2);
  scene.bounded->along_track = 0.95;
  scene.bounded->cross_track = 0.95;
  const BoundedFormation formation = study_bounded(scene);
  for (const BoundedDeputy& deputy : formation.deputies) {
    EXPECT_NE(deputy.failure.find("alone take it"), std::string::npos);
  }
  const auto json = io::bounded_json(formation);
  EXPECT_TRUE(json["deputies"][0]["RTN-rotating.R_m"].is_null());
  EXPECT_TRUE(json["deputies"][0]["failure"].is_string());
  EXPECT_EQ(json["exit_code"], 4);
  EXPECT_NE(io::bounded_verdict(formation).find("No deputy"), std::string::npos);
}

TEST(BoundedFormation, RefusesWhatIsNoOrbitAndWhatLiesInTheEquator) {
  Scene scene = oblate_circle(2);
  scene.bounded.reset();
  EXPECT_THROW(study_bounded(scene), Error);
  scene = oblate_circle(2);
  scene.nominal = {1, 0, 0, 0, 1, 0};
  try {
    study_bounded(scene);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::scene);
    EXPECT_NE(std::string(error.what()).find("equatorial"), std::string::npos);
  }
}

// All ellipses of Kepler's problem are closed.
TEST(FrozenOrbitStudy, RefusesAFieldInWhichAllOrbitsAreFrozen) {
  Scene scene = oblate_circle(2, 0.1);
  scene.system.J = {};
  try {
    study_frozen_orbit(scene);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::numerical);
    EXPECT_NE(std::string(error.what()).find("every ellipse"), std::string::npos);
  }
}

// The study of the frozen orbit reports what was refined in extended precision, and finds the
// chief's own circle: its amplitude is the distance of the two eccentricity vectors.
TEST(FrozenOrbitStudy, FindsTheFrozenOrbitAndTheChiefsCircle) {
  const Scene scene = oblate_circle(4, 0.02);
  const FrozenOrbitStudy study = study_frozen_orbit(scene);
  EXPECT_LT(study.residual, 1e-20);
  EXPECT_LT(std::abs(study.area_defect), 1e-18);
  EXPECT_TRUE(study.is_stable());
  ASSERT_EQ(study.failure, "");
  const LibrationCircle& chief = study.circles.back();
  ASSERT_TRUE(chief.is_chiefs);
  // Osculating eccentricities at the section are those of the pairs to the order of J2.
  EXPECT_NEAR(chief.amplitude, 0.02, 0.003);
  ASSERT_TRUE(chief.miss.has_value());
  EXPECT_LT(*chief.miss, 1e-6);
  EXPECT_GT(study.reach, 0.05);
  const auto json = io::frozen_orbit_json(study);
  EXPECT_EQ(json["circles"].size(), study.circles.size());
  EXPECT_EQ(json["frozen_orbit"]["stable"], true);
}

// Far from the body J2 turns the pericentre by (3/4) J2 (R/a)^2 (5 cos^2 i - 1) of a turn a
// revolution. From 2000 units the sum of the multipliers differs from 2 by less than a bit of
// double precision: there is no normal form rather than a wrong one.
TEST(FrozenOrbitStudy, TellsNoTurnThatRoundingMakes) {
  const auto far = [](double distance) {
    Scene scene = oblate_circle(2, 0.01);
    scene.nominal = {distance, 0, 0, 0, 0.6 / std::sqrt(distance), 0.8 / std::sqrt(distance)};
    return scene;
  };
  const double radius = far(1).canonical_radius;
  const auto turn = [&](double distance) {
    return 0.75 * far(distance).system.J[2] * radius * radius / (distance * distance) *
           (5 * 0.36 - 1);
  };
  const FrozenOrbitStudy near = study_frozen_orbit(far(20));
  ASSERT_EQ(near.failure, "");
  // The next order is that of J2 and of the square of the eccentricity.
  EXPECT_NEAR(std::abs(near.circles.front().rotation_number) / turn(20), 1, 0.005);
  for (const double distance : {2000., 8000.}) {
    const FrozenOrbitStudy study = study_frozen_orbit(far(distance));
    EXPECT_TRUE(study.is_stable()) << distance;
    EXPECT_TRUE(study.circles.empty()) << distance;
    EXPECT_NE(study.failure.find("normal form: "), std::string::npos) << study.failure;
    EXPECT_EQ(study.failure.find("unstable"), std::string::npos) << study.failure;
  }
}

}  // namespace
}  // namespace hamjet
