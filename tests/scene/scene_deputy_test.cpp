#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hamjet/relative_motion/chief_frame.hpp"
#include "scene_samples.hpp"

// Deputies that are given by an orbit of their own, in the keys of [nominal].

namespace hamjet::io {
namespace {

/// At the start the axes R, T, N are x, y, z, and the chief turns by 1/8 rad/s: 0.5 km/s at 4 km.
constexpr const char* circle = R"([system]
model = "kepler"
mu_km3_s2 = 1
[nominal]
position_km = [4, 0, 0]
velocity_km_s = [0, 0.5, 0]
[jet]
duration_s = 64
)";

/// 4 m, 3 m and -2 m from the chief of the circle, 1 m/s, 2 m/s and 0.5 m/s faster.
constexpr const char* beside = R"(position_km = [4.004, 0.003, -0.002]
velocity_km_s = [0.001, 0.502, 0.0005]
)";

constexpr const char* to_the_end = R"([transfer]
times_s = [16, 32]
[transfer.end]
position_m = [0, 0, 4]
)";

Scene deputy_scene(const std::string& tables) {
  return parse_scene(std::string(circle) + tables, "file.toml");
}

void expect_near(const Eigen::Vector3d& found, const Eigen::Vector3d& expected, double tolerance) {
  EXPECT_LT((found - expected).norm(), tolerance) << found.transpose();
}

TEST(SceneDeputy, RelativeStatesAreInItsFrame) {
  const Scene scene =
      deputy_scene("[deputy]\nposition_m = [1, 2, 3]\nvelocity_m_s = [0.5, 0, -1]\n");
  ASSERT_TRUE(scene.deputy);
  EXPECT_EQ(scene.deputy->frame, RelativeFrame::rtn_rotating);
  EXPECT_EQ(scene.deputy->start.position_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(scene.deputy->start.velocity_m_s, Eigen::Vector3d(0.5, 0, -1));
}

// Expected: v' = v - omega x rho, with omega x rho = (-y, x, 0) / 8.
TEST(SceneDeputy, TheDifferenceOfTwoStatesIsWrittenInTheFrame) {
  const auto start = [](const std::string& frame) {
    return deputy_scene("[deputy]\n" + frame + beside).deputy->start;
  };
  const Eigen::Vector3d place(4, 3, -2);
  const Eigen::Vector3d difference(1, 2, 0.5);
  const Eigen::Vector3d seen_from_turning_axes(1 + 3. / 8, 2 - 4. / 8, 0.5);
  expect_near(start("").position_m, place, 1e-10);
  expect_near(start("").velocity_m_s, seen_from_turning_axes, 1e-10);
  expect_near(start("derivatives = \"inertial\"\n").position_m, place, 1e-10);
  expect_near(start("derivatives = \"inertial\"\n").velocity_m_s, difference, 1e-10);
  expect_near(start("frame = \"inertial\"\n").position_m, place, 1e-10);
  expect_near(start("frame = \"inertial\"\n").velocity_m_s, difference, 1e-10);
}

std::string elements(double a, double e, double i, double node, double perigee, double anomaly) {
  return fmt::format("a_km = {}\ne = {}\ni_deg = {}\nraan_deg = {}\nargp_deg = {}\nta_deg = {}\n",
                     a, e, i, node, perigee, anomaly);
}

Scene scene_about_the_earth(const std::string& nominal, const std::string& deputy) {
  return parse_scene(
      "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[jet]\nduration_orbits = "
      "1\n[nominal]\n" +
          nominal + "[deputy]\n" + deputy,
      "file.toml");
}

// On one circle both turn at the same rate: nothing moves as seen from the turning axes.
TEST(SceneDeputy, ADeputyOnTheChiefsCircleIsAtRest) {
  const double angle_deg = 0.1;
  const double angle = angle_deg * std::numbers::pi / 180;
  const Scene scene = scene_about_the_earth(elements(7000, 0, 98, 30, 0, 0),
                                            elements(7000, 0, 98, 30, 0, -angle_deg));
  expect_near(scene.deputy->start.position_m,
              7e6 * Eigen::Vector3d(std::cos(angle) - 1, -std::sin(angle), 0), 1e-8);
  expect_near(scene.deputy->start.velocity_m_s, Eigen::Vector3d::Zero(), 1e-11);
}

/// The state of an ellipse in m and m/s: in the plane of the orbit from the perigee, then turned
/// about z, x and z.
std::pair<Eigen::Vector3d, Eigen::Vector3d> state_of(const std::array<double, 6>& elements) {
  const double mu = 398600.4415e9;
  const double degree = std::numbers::pi / 180;
  const auto [a_km, e, i, node, perigee, anomaly] = elements;
  const double p = a_km * 1000 * (1 - e * e);
  const double c = std::cos(anomaly * degree);
  const double s = std::sin(anomaly * degree);
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(node * degree, Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(i * degree, Eigen::Vector3d::UnitX()) *
                                Eigen::AngleAxisd(perigee * degree, Eigen::Vector3d::UnitZ()))
                                   .toRotationMatrix();
  return {turn * Eigen::Vector3d(c, s, 0) * (p / (1 + e * c)),
          turn * Eigen::Vector3d(-s, e + c, 0) * std::sqrt(mu / p)};
}

TEST(SceneDeputy, ElementsAreThoseOfAnEllipse) {
  const std::array<double, 6> chief = {6892.9, 0.0012, 97.44, 30, 90, 10};
  const std::array<double, 6> deputy = {6892.91, 0.00145, 97.441, 30.004, 90.2, 9.7};
  const auto text = [](const std::array<double, 6>& s) {
    return elements(s[0], s[1], s[2], s[3], s[4], s[5]);
  };
  const Scene scene = scene_about_the_earth(text(chief), text(deputy));
  const auto [r, v] = state_of(chief);
  const auto [r_deputy, v_deputy] = state_of(deputy);
  const Eigen::Vector3d h = r.cross(v);
  Eigen::Matrix3d axes;
  axes << r.normalized().transpose(), h.cross(r).normalized().transpose(),
      h.normalized().transpose();
  const Eigen::Vector3d omega = h / r.squaredNorm();
  const Eigen::Vector3d place = axes * (r_deputy - r);
  EXPECT_GT(place.norm(), 1000);
  expect_near(scene.deputy->start.position_m, place, 1e-7);
  expect_near(scene.deputy->start.velocity_m_s, axes * (v_deputy - v - omega.cross(r_deputy - r)),
              1e-10);
}

TEST(SceneDeputy, TheChiefsOwnOrbitIsNoDistanceAway) {
  const std::string orbit = elements(26600, 0.74, 63.4, 227.89, 281.5, 123.75);
  const Scene scene = scene_about_the_earth(orbit, orbit);
  EXPECT_EQ(scene.deputy->start.position_m, Eigen::Vector3d::Zero());
  EXPECT_EQ(scene.deputy->start.velocity_m_s, Eigen::Vector3d::Zero());
}

TEST(SceneDeputy, ATransferStartsFromIt) {
  const Scene scene = deputy_scene("[deputy]\n" + std::string(beside) + to_the_end);
  EXPECT_EQ(scene.transfer->frame, RelativeFrame::rtn_rotating);
  EXPECT_EQ(scene.transfer->start.position_m, scene.deputy->start.position_m);
  EXPECT_EQ(scene.transfer->start.velocity_m_s, scene.deputy->start.velocity_m_s);
  const Scene inertial =
      deputy_scene("[deputy]\n" + std::string(beside) +
                   changed(to_the_end, "[transfer]", "[transfer]\nframe = \"inertial\""));
  EXPECT_EQ(inertial.transfer->frame, RelativeFrame::inertial);
  expect_near(inertial.transfer->start.velocity_m_s, {1, 2, 0.5}, 1e-10);
}

TEST(SceneDeputy, StartsAndEndsHaveOrbitsToo) {
  const std::string transfer = "[transfer]\nframe = \"RTN\"\ntimes_s = 16\n";
  const std::string relative = "position_m = [0, 1, 0]\n";
  const auto tables = [&](const std::string& end, const std::string& slot) {
    return transfer + "[transfer.start]\n" + beside + "[transfer.end]\n" + end +
           "[[assignment.deputy]]\n" + beside + "[[assignment.slot]]\n" + slot;
  };
  const Scene scene = deputy_scene(tables(relative, beside));
  expect_near(scene.transfer->start.velocity_m_s, {1.375, 1.5, 0.5}, 1e-10);
  expect_near(scene.assignment->deputies[0].velocity_m_s, {1.375, 1.5, 0.5}, 1e-10);
  EXPECT_TRUE(scene.transfer->end.is_along_axes());
  // At arrival the chief is elsewhere, so that an orbit keeps its numbers, in units of 4 km.
  const ArrivalState& slot = scene.assignment->slots[0];
  ASSERT_TRUE(slot.own_state.has_value());
  EXPECT_EQ((*slot.own_state)[0] * 4, 4.004);
  const Scene in_form = deputy_scene(tables("arc_m = 4\ncross_rate_m_s = 2\n", relative));
  ASSERT_TRUE(in_form.transfer->end.in_form.has_value());
  EXPECT_EQ(in_form.transfer->end.in_form->form, DeputyForm::curvilinear);
  EXPECT_EQ(in_form.transfer->end.in_form->numbers, (std::array<double, 6>{0, 4, 0, 0, 0, 2}));
  // A message is for one moment, but there are as many arrivals as times.
  expect_scene_error(circle + tables("opm_file = \"a.opm\"\n", relative),
                     {"transfer.end.opm_file: unknown key"});
  expect_scene_error(circle + tables(relative, "position_m = [0, 1, 0]\narc_m = 4\n"),
                     {"assignment.slot.0.position_m: two forms of a deputy"});
}

// On the chief's own circle, 1/1000 of a radian ahead, the deputy rests in the turning axes; in
// each form one number says it. The orbit is tilted, for without a node there are no elements.
TEST(SceneDeputy, OtherFormsOfOnePlaceOnTheCircle) {
  const std::string tilted = changed(circle, "[0, 0.5, 0]", "[0, 0.3, 0.4]");
  for (const char* form : {"arc_m = 4", "a_dlambda_m = 4", "dtheta_deg = 0.057295779513082321"}) {
    for (const std::string table : {"[deputy]\n",
                                    "[transfer]\ntimes_s = 16\nframe = \"RTN\"\n"
                                    "end.position_m = [0, 0, 1]\n[transfer.start]\n"}) {
      const Scene scene = parse_scene(tilted + table + form + "\n", "file.toml");
      const RelativeState& start = scene.deputy ? scene.deputy->start : scene.transfer->start;
      const double angle = 1e-3;
      expect_near(start.position_m, {4000 * (std::cos(angle) - 1), 4000 * std::sin(angle), 0},
                  1e-11);
      expect_near(start.velocity_m_s, {0, 0, 0}, 1e-12);
    }
  }
}

TEST(SceneDeputy, ErrorsOfOtherForms) {
  const std::string tilted = changed(circle, "[0, 0.5, 0]", "[0, 0.3, 0.4]") + "[deputy]\n";
  expect_scene_error(tilted + "arc_m = 4\na_da_m = 1\n",
                     {"deputy.a_da_m: two forms of a deputy, got arc_m and a_da_m"});
  expect_scene_error(tilted + "position_m = [1, 0, 0]\narc_m = 4\n", {"two forms of a deputy"});
  expect_scene_error(tilted + "da_m = -5000\n",
                     {"deputy.da_m: no state of a deputy, got element-differences of -5000",
                      "the orbit is no ellipse"});
  expect_scene_error(std::string(circle) + "[deputy]\na_da_m = 1\n",
                     {"deputy.a_da_m: no state of a deputy", "equatorial plane and has no node"});
  expect_scene_error(tilted + "arc_m = 9000\n", {"deputy: too far from its chief"});
}

TEST(SceneDeputy, Errors) {
  const auto refused = [](const std::string& deputy, const std::vector<std::string>& words) {
    expect_scene_error(std::string(circle) + "[deputy]\n" + deputy, words);
  };
  refused(std::string(beside) + "position_m = [1, 0, 0]\n",
          {"file.toml:12:14: deputy.position_m: two forms of a deputy, got position_km and "
           "position_m, must be one of"});
  refused("position_km = [4, 0, 0]\n", {"deputy.velocity_km_s: missing"});
  refused(std::string(beside) + "a_km = 1\n", {"deputy.a_km: both forms of an orbit"});
  refused("frame = \"RTN\"\n", {"deputy.position_m: missing"});
  refused("position_km = [-4, 0, 0]\nvelocity_km_s = [0, 0, 0]\n",
          {"deputy: too far from its chief, got 8 km", "below 4 km"});
  refused("position_km = [4.001, 0, 0]\nvelocity_km_s = [0, -0.1, 0]\n",
          {"deputy: too fast beside its chief, got 0.6 km/s", "below 0.5 km/s"});
  refused("position_km = [4.001, 0, 0]\nvelocity_km_s = [0, 1e308, 0]\n", {"too fast"});
  refused("frame = \"LVLH\"\nposition_m = [1, 0, 0]\n", {"deputy.frame: ambiguous"});
  expect_scene_error(changed(circle, "[0, 0.5, 0]", "[0.25, 0, 0]") + std::string("[deputy]\n") +
                         changed(beside, "0.502", "0.002"),
                     {"deputy.frame: not defined at this chief, got RTN", "must be \"inertial\""});
}

TEST(SceneDeputy, OfAMessageIsOfTheChiefsMomentAxesAndCentre) {
  const std::string folder = std::string(HAMJET_SOURCE_DIR) + "/data/scenes/";
  const std::string head =
      "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[jet]\nduration_s = 60\n"
      "[deputy]\nopm_file = \"eutelsat-w4.opm\"\n[nominal]\n";
  const auto read = [&](const std::string& text) {
    return parse_scene(text, folder + "none.toml");
  };
  const std::string message = "opm_file = \"eutelsat-w4.opm\"\n";
  EXPECT_EQ(read(head + message).deputy->start.position_m, Eigen::Vector3d::Zero());
  const auto refused = [&](const std::string& text, const std::vector<std::string>& words) {
    expect_error([&] { read(text); }, ErrorKind::scene, words, text);
  };
  const std::string numbers = "position_km = [42164, 0, 0]\nvelocity_km_s = [0, 3.07, 0]\n";
  refused(head + numbers, {"deputy.opm_file: a dated state beside a chief without a date"});
  const auto dated = [&](const std::string& epoch, const std::string& frame) {
    return head + numbers + "[ephemeris]\nepoch = \"" + epoch +
           "\"\ntime_system = \"UTC\"\ncenter_name = \"EARTH\"\nreference_frame = \"" + frame +
           "\"\n";
  };
  refused(dated("2021-06-03T00:00:01", "TOD"),
          {"deputy.opm_file: a state of another moment than the chief's, got 2021-06-03T00:00:00",
           "must be 2021-06-03T00:00:01.000000000000 UTC"});
  refused(dated("2021-06-03T00:00:00", "EME2000"),
          {"deputy.opm_file: a state in other axes than the chief's, got TOD of date, must be "
           "EME2000"});
  const std::string same = changed(dated("2021-06-03T00:00:00", "TOD"), "[42164, 0, 0]",
                                   "[6655.9942, -40218.5751, -82.9177]");
  EXPECT_NO_THROW(read(changed(same, "[0, 3.07, 0]", "[3.11548208, 0.47042605, -0.00101495]")));
  // A warning follows that this centre does not have the mu of the Earth.
  expect_error(ErrorKind::scene,
               "deputy.opm_file: a state about another centre than the chief's, got EARTH, must be "
               "EARTH BARYCENTER\nwarning: ",
               [&] { read(changed(same, "\"EARTH\"", "\"EARTH BARYCENTER\"")); });
}

// Each spacecraft of an encounter has polynomials about its own trajectory.
TEST(SceneDeputy, OfACollisionMayBeAnywhere) {
  const std::string collision =
      "[uncertainty]\nposition_m = [1, 1, 1]\n[uncertainty.collision]\nradius_m = 2\n";
  const auto start = [&](const std::string& deputy, const std::string& tables) {
    return deputy_scene("[deputy]\nframe = \"inertial\"\n" + deputy + tables);
  };
  // The deputy comes from the other side, against the chief's motion.
  const std::string opposite = "position_km = [-4, 0, 0]\nvelocity_km_s = [0, 0.5, 0]\n";
  const Scene met = start(opposite, collision);
  EXPECT_EQ(met.deputy->start.position_m, Eigen::Vector3d(-8000, 0, 0));
  EXPECT_EQ(met.deputy->start.velocity_m_s, Eigen::Vector3d(0, 0, 0));
  EXPECT_TRUE(met.warnings.empty());
  const std::string head_on = "position_m = [0, 5, 0]\nvelocity_m_s = [0, -1000, 0]\n";
  EXPECT_EQ(start(head_on, collision).deputy->start.velocity_m_s, Eigen::Vector3d(0, -1000, 0));
  for (const std::string& deputy : {opposite, head_on}) {
    expect_error([&] { start(deputy, ""); }, ErrorKind::scene, {"deputy"}, deputy);
  }
}

TEST(SceneDeputy, FarFromItsChiefIsWarnedOf) {
  EXPECT_TRUE(deputy_scene("[deputy]\nposition_m = [0, 199, 0]\n").warnings.empty());
  const Scene far = deputy_scene("[deputy]\nposition_m = [0, 201, 0]\n");
  ASSERT_EQ(far.warnings.size(), 1U);
  EXPECT_NE(far.warnings[0].find("deputy: far from its chief, got 201 m, should be well below "
                                 "200 m"),
            std::string::npos)
      << far.warnings[0];
}

}  // namespace
}  // namespace hamjet::io
