#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hamjet/dynamics/mean_elements.hpp"
#include "scene_samples.hpp"
#include "support/errors.hpp"

// Size and shape of an orbit, and the place on it, in every way that a scene may give them.
// Expected: the same orbit by a_km, e, argp_deg and ta_deg.

namespace hamjet::io {
namespace {

constexpr double mu = 398600.4415, radius = 6378, degree = std::numbers::pi / 180;

Scene scene_with(const std::string& nominal) {
  return parse_scene(
      changed(orbit, "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.5, 1]\n", nominal),
      "file.toml");
}

void expect_refused(const std::string& nominal, const std::vector<std::string>& words) {
  expect_scene_error(
      changed(orbit, "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.5, 1]\n", nominal), words);
}

constexpr const char* orbit_plane = "i_deg = 63.4\nraan_deg = 30\n";

/// `tolerance` is relative to the largest number, which determines the rounding of a scene's
/// numbers.
void expect_same_start(const Scene& found, const Scene& expected, double tolerance) {
  const double length = expected.units.length_km, speed = length / expected.units.time_s;
  for (std::size_t i = 0; i < 6; ++i) {
    const double unit = found.units.length_km / (i < 3 ? 1.0 : found.units.time_s);
    EXPECT_NEAR(found.nominal[i] * unit / (i < 3 ? length : speed), expected.nominal[i],
                tolerance * 2)
        << i;
  }
}

// With rp = radius + 622 and ra = radius + 3122: a = (rp + ra)/2 = 8250, e = (ra - rp)/(ra + rp).
// With nu = 40: tan(E/2) = sqrt((1 - e)/(1 + e)) tan(nu/2), M = E - e sin E.
TEST(SceneElements, EverySizeWithEveryPlaceIsTheSameOrbit) {
  const double a = 8250, e = 1250. / 8250, nu = 40, perigee = 70;
  const double E = 2 * std::atan(std::sqrt((1 - e) / (1 + e)) * std::tan(nu * degree / 2));
  const double M = E - e * std::sin(E);
  const double period = 2 * std::numbers::pi * std::sqrt(a * a * a / mu);
  const std::string sizes[] = {
      fmt::format("a_km = {}\ne = {}\n", a, e),
      fmt::format("perigee_height_km = {}\napogee_height_km = {}\n", 7000 - radius, 9500 - radius),
      fmt::format("period_s = {}\ne = {}\n", period, e)};
  const std::string places[] = {
      fmt::format("ta_deg = {}\n", nu), fmt::format("ea_deg = {}\n", E / degree),
      fmt::format("ma_deg = {}\n", M / degree), fmt::format("u_deg = {}\n", nu + perigee)};
  const std::string argp = fmt::format("argp_deg = {}\n", perigee);
  const Scene expected = scene_with(sizes[0] + orbit_plane + argp + places[0]);
  for (const std::string& size : sizes) {
    for (const std::string& place : places) {
      SCOPED_TRACE(size + place);
      expect_same_start(scene_with(size + orbit_plane + argp + place), expected, 1e-15);
    }
  }
}

TEST(SceneElements, ACircleHasAHeightAndALatitude) {
  const std::string circle_text = fmt::format("a_km = {}\ne = 0\n", radius + 500);
  const Scene expected = scene_with(circle_text + orbit_plane + "argp_deg = 0\nta_deg = 123\n");
  for (const std::string& size :
       {circle_text, std::string("height_km = 500\n"),
        std::string("perigee_height_km = 500\napogee_height_km = 500\n")}) {
    for (const char* const place :
         {"u_deg = 123\n", "argp_deg = 0\nu_deg = 123\n", "argp_deg = 23\nta_deg = 100\n",
          "argp_deg = 23\nma_deg = 100\n", "argp_deg = 23\nea_deg = 100\n",
          "argp_deg = 23\nu_deg = 123\n"}) {
      SCOPED_TRACE(size + place);
      EXPECT_EQ(scene_with(size + orbit_plane + place).nominal, expected.nominal);
    }
  }
}

// Expected: components with a factor sin or cos of a right angle are 0.
TEST(SceneElements, RightAnglesAreExact) {
  const auto state = [](const char* place) {
    return scene_with(std::string("period_s = 7000\ne = 0.3\ni_deg = 90\nraan_deg = 180\n"
                                  "argp_deg = 0\n") +
                      place)
        .nominal;
  };
  for (const char* const place : {"ma_deg = 180\n", "ea_deg = 180\n", "u_deg = -180\n"}) {
    const std::vector<double> apogee = state(place);
    EXPECT_EQ(apogee[0], 1) << place;
    for (const std::size_t i : {1U, 2U, 3U, 4U}) EXPECT_EQ(apogee[i], 0) << place << i;
  }
  EXPECT_EQ(state("u_deg = 90\n")[0], 0);
}

// Expected: the period that was given; Vallado's example 2-1 has M = 235.4 at E = 220.512074767522.
TEST(SceneElements, AgreeWithClosedFormsAndAPublishedExample) {
  const std::string angles = std::string(orbit_plane) + "argp_deg = 10\n";
  const Scene period = parse_scene(
      "system = {model = \"kepler\", mu_km3_s2 = 398600.4415}\njet.duration_orbits = 1\n[nominal]\n"
      "period_s = 5400\ne = 0.01\nma_deg = 77\n" +
          angles,
      "file.toml");
  EXPECT_NEAR(period.duration * period.units.time_s, 5400, 5400 * 1e-15);
  expect_same_start(scene_with("a_km = 9000\ne = 0.4\n" + angles + "ma_deg = 235.4\n"),
                    scene_with("a_km = 9000\ne = 0.4\n" + angles + "ea_deg = 220.512074767522\n"),
                    1e-14);
}

TEST(SceneElements, ADeputyHasThemToo) {
  const auto deputy = [](const std::string& place) {
    const std::string tables = std::string("i_deg = 30\nraan_deg = 0\n") + place;
    return parse_scene(
               "[system]\nmodel = \"zonal-gravity\"\nmu_km3_s2 = 398600.4415\n"
               "radius_km = 6378\n[jet]\nduration_orbits = 1\n[nominal]\n"
               "height_km = 622\nu_deg = 0\ni_deg = 30\nraan_deg = 0\n[deputy]\n" +
                   tables,
               "file.toml")
        .deputy->start;
  };
  const RelativeState expected = deputy("a_km = 7001\ne = 0\nargp_deg = 0\nta_deg = -0.01\n");
  const RelativeState found = deputy("height_km = 623\nu_deg = -0.01\n");
  EXPECT_EQ(found.position_m, expected.position_m);
  EXPECT_EQ(found.velocity_m_s, expected.velocity_m_s);
}

// The start is the osculating state of the mean one, which MeanElements judges.
TEST(SceneElements, MayBeMeanOnes) {
  const auto field = [](const std::string& J2, const std::string& elements) {
    return parse_scene("[system]\nmodel = \"zonal-gravity\"\nmu_km3_s2 = 398600.4415\n" + J2 +
                           "radius_km = 6378\n[jet]\nduration_orbits = 1\n[nominal]\n"
                           "height_km = 622\nu_deg = 30\ni_deg = 98\nraan_deg = 10\n" +
                           elements,
                       "file.toml");
  };
  const std::string flat = "J2 = 1.0826e-3\n";
  const Scene mean = field(flat, "elements = \"mean\"\n");
  const CartesianState expected = osculating_of_mean(
      state_from_elements({7000, 0, 98, 10, 0, 30}, 398600.4415), {398600.4415, 6378, 1.0826e-3});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(mean.nominal[i] * mean.units.length_km, convert<double>(expected.position_km[i]),
                1e-11);
  }
  const Scene osculating = field(flat, "elements = \"osculating\"\n");
  EXPECT_EQ(osculating.nominal, field(flat, "").nominal);
  EXPECT_GT(std::abs(mean.nominal[0] - osculating.nominal[0]), 1e-5);
  test::expect_error(ErrorKind::scene,
                     "nominal.elements: mean elements in a field without J2, got \"mean\"",
                     [&] { field("", "elements = \"mean\"\n"); });
  test::expect_error(ErrorKind::scene, "nominal.elements: no mean elements here",
                     [&] { field("J2 = 0.9\n", "elements = \"mean\"\n"); });
}

TEST(SceneElements, EachPieceIsThereOnce) {
  const std::string angles = std::string(orbit_plane) + "argp_deg = 0\nta_deg = 0\n";
  const std::string forms =
      "must be one of: a_km with e, perigee_height_km with apogee_height_km, "
      "period_s with e, height_km of a circle";
  expect_refused(angles, {"file.toml:8:1: nominal: no size of the orbit, got none", forms});
  expect_refused("e = 0.1\n" + angles, {"nominal: no size of the orbit", forms});
  expect_refused("a_km = 7000\n" + angles, {"nominal.e: missing beside a_km", forms});
  expect_refused("period_s = 7000\n" + angles, {"nominal.e: missing beside period_s", forms});
  expect_refused("apogee_height_km = 700\n" + angles,
                 {"nominal.perigee_height_km: missing beside apogee_height_km", forms});
  expect_refused("a_km = 7000\ne = 0\nheight_km = 700\n" + angles,
                 {"file.toml:11:13: nominal.height_km: size and shape given twice, got a_km and "
                  "height_km",
                  forms});
  expect_error(
      [] {
        parse_scene(
            "system = {model = \"kepler\", mu_km3_s2 = 4e5}\njet.duration_s = 1\n"
            "nominal = {a_km = 7000, e = 0, i_deg = 0, raan_deg = 0, u_deg = 0}\n",
            "file.toml", {{"nominal.height_km", "700"}});
      },
      ErrorKind::scene,
      {"--set nominal.height_km: size and shape given twice, got height_km and a_km",
       "; what is not wanted is removed by --set nominal.a_km=null --set nominal.e=null"},
      "an override");
  expect_refused("height_km = 700\ne = 0\n" + angles,
                 {"nominal.e: size and shape given twice, got height_km and e", forms});
  expect_refused("period_s = 7000\ne = 0\napogee_height_km = 700\n" + angles,
                 {"given twice, got apogee_height_km and"});
  const std::string circle_text = std::string("height_km = 700\n") + orbit_plane;
  const std::string ellipse = std::string("a_km = 7000\ne = 0.1\n") + orbit_plane;
  expect_refused(ellipse + "argp_deg = 0\n",
                 {"nominal: missing, got none of a choice, must be exactly one of: ta_deg, ea_deg, "
                  "ma_deg, u_deg"});
  expect_refused(ellipse + "argp_deg = 0\nta_deg = 0\nma_deg = 0\n",
                 {"nominal.ma_deg: more than one key of a choice, got ta_deg, ma_deg"});
  expect_refused(ellipse + "ta_deg = 0\n", {"nominal.argp_deg: missing, must be a number from -360 "
                                            "to 360, or u_deg in place of it and the anomaly"});
  expect_refused(ellipse + "u_deg = 0\n",
                 {"nominal.argp_deg: missing beside u_deg", "on a circle alone"});
  expect_refused(circle_text + "ma_deg = 0\n",
                 {"nominal.argp_deg: missing", "u_deg in place of it"});
  expect_refused(circle_text + "u_deg = 361\n", {"nominal.u_deg: out of range, got 361"});
}

TEST(SceneElements, HeightsAreAboveARadius) {
  const std::string place = std::string(orbit_plane) + "argp_deg = 0\nta_deg = 0\n";
  expect_refused("height_km = -6378\n" + place,
                 {"nominal.height_km: at the centre or beyond, got -6378, must be above -6378, for "
                  "heights are above system.radius_km = 6378"});
  expect_refused("perigee_height_km = 700\napogee_height_km = 699\n" + place,
                 {"nominal.apogee_height_km: too low for its perigee, got 699, must be at least "
                  "perigee_height_km = 700"});
  expect_refused("perigee_height_km = 700\napogee_height_km = 1e300\n" + place,
                 {"nominal.apogee_height_km: too high for its perigee"});
  expect_refused("period_s = 0\ne = 0\n" + place, {"nominal.period_s: not positive"});
  expect_refused("period_s = 1\ne = 1\n" + place, {"nominal.e: out of range, got 1"});
  expect_scene_error(
      "system = {model = \"kepler\", mu_km3_s2 = 398600.4415}\n"
      "jet.duration_s = 1\n[nominal]\nheight_km = 500\nu_deg = 0\n" +
          std::string(orbit_plane),
      {"file.toml:4:13: nominal.height_km: a height in a scene without a radius, "
       "got 500, must be a_km with e, or beside system.radius_km, which the model "
       "zonal-gravity has without J_n too"});
}

}  // namespace
}  // namespace hamjet::io
