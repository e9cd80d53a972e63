#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "../command_test.hpp"
#include "hamjet/formats/conjunction_data_message.hpp"
#include "support/reference_data.hpp"

// Collisions in `hamjet uncertainty`: table [uncertainty.collision].

namespace hamjet::test {
namespace {

class Collision : public CommandTest {
 protected:
  static std::string scene(const std::string& collision, const std::string& deputy_uncertainty) {
    return "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\n"
           "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.5, 1]\n"
           "[deputy]\nposition_m = [0, 100, 0]\n"
           "[jet]\norder = 2\nduration_s = 3000\n"
           "[uncertainty]\nposition_m = [10, 10, 10]\nsamples = 0\n" +
           deputy_uncertainty + "[uncertainty.collision]\n" + collision;
  }
};

TEST_F(Collision, OfTheShippedSceneIsThePublishedOne) {
  const std::string path =
      std::string(HAMJET_SOURCE_DIR) + "/data/scenes/conjunction-geosynchronous.toml";
  const std::string out =
      in_one_line(succeed({"uncertainty", path, "--set", "uncertainty.samples=0", "--set",
                           "uncertainty.collision.samples=50000", "-o", "out"})
                      .out);
  for (const char* const words :
       {"collision nearer than 15 m", "weighted samples, as good as",
        "closest approach of the means", "as a short encounter 1.467e-01 (Foster, Alfano)",
        "does not hold"}) {
    EXPECT_NE(out.find(words), std::string::npos) << words << " is not in " << out;
  }
  const Json published = read_reference_file("alfano2009.json")[0]["probability"];
  const Json collision = read_json(directory_ / "out/summary.json")["collision"];
  EXPECT_LE(collision["interval"][0], published["monte_carlo_95_percent"][1]);
  EXPECT_GE(collision["interval"][1], published["monte_carlo_95_percent"][0]);
  EXPECT_NEAR(collision["approaches"][0]["short_encounter"]["alfano"].get<double>(),
              published["short_encounter_2d"].get<double>(), 1e-6);
  EXPECT_EQ(collision["approaches"][0]["flights"], 64);
  const Table table = read_table(directory_ / "out/collision.csv");
  EXPECT_EQ(table.header, "time_s,probability_by_time");
  EXPECT_EQ(table.rows.size(), 201U);
}

/// Two spacecraft on circles of one radius whose planes cross by an angle iota about the deputy's
/// start, which is ahead of the chief's by an angle phi.
struct CrossingCircles {
  static constexpr double mu = 398600.4415e9, radius = 7e6, phi = 100 / radius, iota = 1e-3;
  double speed = std::sqrt(mu / radius);
  double rate = speed / radius;

  std::string scene(const std::string& ephemeris) const {
    // The state of the deputy less that of the chief, along inertial axes.
    const std::array<double, 6> d = {radius * (std::cos(phi) - 1),
                                     radius * std::sin(phi),
                                     0,
                                     -speed * std::sin(phi) * std::cos(iota),
                                     speed * (std::cos(phi) * std::cos(iota) - 1),
                                     speed * std::sin(iota)};
    return fmt::format(
        "title = \"Crossing circles\"\n[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n"
        "[nominal]\nposition_km = [7000, 0, 0]\nvelocity_km_s = [0, {}, 0]\n[deputy]\n"
        "frame = \"inertial\"\nposition_m = [{}, {}, {}]\nvelocity_m_s = [{}, {}, {}]\n"
        "[jet]\norder = 1\nduration_s = 4000\n{}"
        "[uncertainty]\nposition_m = [10, 10, 10]\nvelocity_m_s = [0.01, 0.01, 0.01]\nsamples = 0\n"
        "[uncertainty.collision]\nradius_m = 20\nsamples = 2000\nwindow_s = [1000, 4000]\n",
        speed / 1000, d[0], d[1], d[2], d[3], d[4], d[5], ephemeris);
  }
  static std::string ephemeris(const std::string& system, const std::string& frame) {
    return "[ephemeris]\nepoch = \"2026-03-01T00:00:00\"\ntime_system = \"" + system +
           "\"\nreference_frame = \"" + frame +
           "\"\ncenter_name = \"EARTH\"\nobject_name = \"CHIEF\"\nobject_id = \"2026-001A\"\n"
           "originator = \"TESTERS\"\n";
  }
};

TEST_F(Collision, WritesAConjunctionDataMessageOfTheNearestApproach) {
  const CrossingCircles circles;
  write("circles.toml", circles.scene(CrossingCircles::ephemeris("UTC", "EME2000")));
  succeed({"uncertainty", "circles.toml", "-o", "out"});
  EXPECT_EQ(read_json(directory_ / "out/summary.json")["collision"]["message"], "encounter.cdm");
  const io::ConjunctionDataMessage message =
      io::read_cdm("encounter.cdm", content(directory_ / "out/encounter.cdm"));
  EXPECT_EQ(message.originator, "TESTERS");
  EXPECT_EQ(message.objects[0].object_name, "CHIEF");
  EXPECT_EQ(message.objects[0].international_designator, "2026-001A");
  EXPECT_EQ(message.objects[1].object_name, "DEPUTY");
  EXPECT_EQ(message.objects[1].reference_frame, "EME2000");
  // Of the cosine of the angle between both, cos(2 theta - phi) (1 - cos iota) varies, so that they
  // are nearest half a phi beyond each half revolution.
  const double after = (std::numbers::pi + CrossingCircles::phi / 2) / circles.rate;
  const auto seconds = std::chrono::duration<double>(
      message.tca.day - std::chrono::sys_days(std::chrono::year(2026) / 3 / 1));
  const double tca = seconds.count() + static_cast<double>(message.tca.picoseconds) * 1e-12;
  // The rounding of two positions, some 1e-9 m, over 7.5 m/s.
  EXPECT_NEAR(tca, after, 1e-7);
  EXPECT_NEAR(message.miss_distance_m, 100, 1e-4);
  EXPECT_NEAR((*message.relative_position_m)[1], 100, 1e-4);
  // The planes cross, and both velocities are perpendicular to their positions.
  const double across = circles.speed * CrossingCircles::iota;
  const double along = circles.speed * CrossingCircles::phi;
  EXPECT_NEAR(*message.relative_speed_m_s, std::hypot(across, along), 1e-5);
  EXPECT_NEAR((*message.relative_velocity_m_s)[2], -across, 1e-5);
  EXPECT_NEAR((*message.relative_velocity_m_s)[0], -along, 1e-5);
  // Half a revolution on.
  const io::ConjunctionObject& chief = message.objects[0];
  EXPECT_NEAR(chief.position_km[0], -7000, 1e-4);
  EXPECT_NEAR(chief.velocity_km_s[1], -circles.speed / 1000, 1e-7);
  // Clohessy and Wiltshire after half a revolution, of inertial velocities along R, T, N:
  //   R = 3 R0 + 4 vT0 / n ,  vT = -2 n R0 - 3 vT0 ,  N = -N0 ,  vN = -vN0 .
  const double n = circles.rate, p = 100, v = 1e-4;
  const auto& c = chief.covariance;
  EXPECT_NEAR(c[0][0] / (9 * p + 16 * v / (n * n)), 1, 1e-8);
  EXPECT_NEAR(c[4][4] / (4 * n * n * p + 9 * v), 1, 1e-8);
  EXPECT_NEAR(c[4][0] / (-6 * n * p - 12 * v / n), 1, 1e-8);
  EXPECT_NEAR(c[2][2] / p, 1, 1e-8);
  EXPECT_NEAR(c[5][5] / v, 1, 1e-8);
  EXPECT_NEAR(c[2][0] / p, 0, 1e-8);
  // The deputy is known exactly.
  for (const auto& row : message.objects[1].covariance) {
    for (const double entry : row) EXPECT_EQ(entry, 0);
  }
  const Json collision = read_json(directory_ / "out/summary.json")["collision"];
  EXPECT_NEAR(*message.collision_probability, collision["probability"].get<double>(), 1e-15);
}

// A covariance in all six directions and a burn's errors beside it are the covariance of their sum:
// as wrong by a tenth in size and by a tenth of a radian in direction, 0.1 m/s is wrong by 0.01 m/s
// in each direction.
TEST_F(Collision, TakesTheErrorsOfABurnBesideAFullCovariance) {
  const CrossingCircles circles;
  const auto probability = [&](const std::string& folder, const std::string& tables) {
    write("circles.toml", circles.scene("") + tables);
    succeed({"uncertainty", "circles.toml", "-o", folder});
    const Json collision = read_json(directory_ / folder / "summary.json")["collision"];
    return collision["approaches"][0]["short_encounter"]["alfano"].get<double>();
  };
  const double burned = probability(
      "burned", fmt::format("[uncertainty.deputy]\nposition_m = [10, 10, 10]\nvelocity_m_s = "
                            "[0.01, 0.01, 0.01]\n[uncertainty.burn]\nvelocity_change_m_s = [0, "
                            "0.1, 0]\nmagnitude = 0.1\ndirection_deg = {}\n",
                            18 / std::numbers::pi));
  const double v = 0.01 * std::sqrt(2.0);
  const double summed =
      probability("summed", fmt::format("[uncertainty.deputy]\nposition_m = [10, 10, 10]\n"
                                        "velocity_m_s = [{0}, {0}, {0}]\n",
                                        v));
  EXPECT_NEAR(burned / summed, 1, 1e-9);
}

TEST_F(Collision, SaysWhatAMessageLacks) {
  const CrossingCircles circles;
  struct Lack {
    std::string ephemeris;
    const char* words;
    const char* folder;
  };
  for (const Lack& lack :
       {Lack{"", "the scene has no dates", "undated"},
        Lack{CrossingCircles::ephemeris("TAI", "EME2000"), "got ephemeris.time_system TAI", "tai"},
        Lack{CrossingCircles::ephemeris("UTC", "ICRF"), "got ephemeris.reference_frame ICRF",
             "icrf"}}) {
    write("circles.toml", circles.scene(lack.ephemeris));
    const std::string out =
        in_one_line(succeed({"uncertainty", "circles.toml", "-o", lack.folder}).out);
    EXPECT_NE(out.find("no conjunction data message: "), std::string::npos) << out;
    EXPECT_NE(out.find(lack.words), std::string::npos) << out;
    EXPECT_FALSE(std::filesystem::exists(directory_ / lack.folder / "encounter.cdm"));
  }
}

TEST_F(Collision, RefusesWhatIsNoWindowAndWhatIsCertain) {
  const std::string deputy = "[uncertainty.deputy]\nposition_m = [10, 10, 10]\n";
  write("window.toml", scene("radius_m = 5\nwindow_s = [100, 50]\n", deputy));
  expect_error({"uncertainty", "window.toml"}, 3, {"uncertainty.collision.window_s", "no window"});
  write("late.toml", scene("radius_m = 5\nwindow_s = [100, 5000]\n", deputy));
  expect_error({"uncertainty", "late.toml"}, 3, {"window_s", "beyond the scene's end", "3000"});
  write("radius.toml", scene("radius_m = 0\n", deputy));
  expect_error({"uncertainty", "radius.toml"}, 3, {"uncertainty.collision.radius_m"});
  write("event.toml", scene("radius_m = 5\nevent = \"near\"\n", deputy));
  expect_error({"uncertainty", "event.toml"}, 3, {"event", "nearer"});
  std::string certain = scene("radius_m = 5\n", "");
  certain.replace(certain.find("[10, 10, 10]"), 12, "[0, 0, 0]");
  write("certain.toml", certain);
  expect_error({"uncertainty", "certain.toml"}, 3, {"known exactly", "must have a covariance"});
}

// Two circular orbits in one plane, one against the other: they meet head-on after a quarter of a
// revolution at twice the orbital speed, where the integral over the disc is exact to the curvature
// within milliseconds.
TEST_F(Collision, OfAHeadOnEncounterIsThatOfThePlane) {
  write("head-on.toml",
        "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\n"
        "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.546053286, 0]\n"
        "[deputy]\nposition_km = [-7000, 0, 0]\nvelocity_km_s = [0, 7.546053286, 0]\n"
        "[jet]\norder = 2\nduration_s = 1500\n"
        "[uncertainty]\nposition_m = [10, 10, 10]\nvelocity_m_s = [1e-3, 1e-3, 1e-3]\n"
        "samples = 2000\n[uncertainty.deputy]\nposition_m = [10, 10, 10]\n"
        "[uncertainty.collision]\nradius_m = 5\nwindow_s = [1400, 1500]\nsamples = 20001\n");
  const CommandResult outcome = succeed({"uncertainty", "head-on.toml"});
  EXPECT_EQ(outcome.err.find("far from its chief"), std::string::npos) << outcome.err;
  const Json summary = read_json(directory_ / "out/head-on-uncertainty/summary.json");
  const Json& collision = summary["collision"];
  EXPECT_EQ(collision["samples"], 20001);
  ASSERT_EQ(collision["approaches"].size(), 1U);
  const Json& approach = collision["approaches"][0];
  EXPECT_NEAR(approach["speed_m_s"].get<double>(), 2 * 7546.053286, 1e-2);
  EXPECT_EQ(approach["short_encounter"]["holds"], true);
  EXPECT_EQ(approach["short_encounter"]["cut_by_window"], false);
  const double plane = approach["short_encounter"]["alfano"];
  EXPECT_NEAR(collision["probability"].get<double>(), plane,
              4 * collision["standard_error"].get<double>() + 1e-3 * plane);
  // Moments of the deputy are by polynomials about its own trajectory, 14 000 km from the chief's.
  const Json& deputy = summary["times"][0]["states"][1];
  ASSERT_EQ(deputy["name"], "deputy");
  const Json& moments = deputy["families"][0]["orders"][1];
  for (std::size_t i = 0; i < 6; ++i) {
    for (const char* const key : {"mean", "standard_deviation"}) {
      // Five scatters are left by chance once in some 100 000 tries of twelve numbers.
      EXPECT_NEAR(moments[key][i].get<double>(), deputy["flown"][key][i].get<double>(),
                  5 * deputy["flown"][std::string(key) + "_scatter"][i].get<double>())
          << key << i;
    }
  }
}

TEST_F(Collision, NamesTheKeyOfWhatCannotBeSampled) {
  std::string flat = scene("radius_m = 5\nsampling = \"entries\"\n",
                           "[uncertainty.deputy]\nposition_m = [10, 10, 0]\n");
  flat.replace(flat.find("[10, 10, 10]"), 12, "[10, 10, 0]");
  write("flat.toml", flat);
  expect_error({"uncertainty", "flat.toml"}, 3,
               {"flat.toml: uncertainty.collision.sampling: not possible for this encounter",
                "\"plain\"", "certain in a direction"});
  // 7000 km are told to a ten thousand millionth.
  write("thin.toml", scene("radius_m = 6e-4\n", "[uncertainty.deputy]\nposition_m = [1, 1, 1]\n"));
  expect_error({"check", "thin.toml"}, 3,
               {"uncertainty.collision.radius_m: too small, got 0.0006, must be 0.0007 or more"});
  EXPECT_FALSE(std::filesystem::exists(directory_ / "out"));
}

/// Two that pass each other at right angles and the root of 2 of the speed, 4 m apart, so many
/// seconds before the start; their positions are uncertain by 5, 30 and 5 m along R, T, N.
std::string passing(double seconds_before, const std::string& collision) {
  const double along = 7.5 * seconds_before;
  return fmt::format(
      "system = {{ model = \"kepler\", mu_km3_s2 = 398600.4418 }}\n"
      "ephemeris = {{ epoch = \"2024-01-02T00:00:00\", time_system = \"UTC\", reference_frame = "
      "\"EME2000\", center_name = \"EARTH\", object_name = \"A\", object_id = \"2024-001A\", "
      "originator = \"TESTERS\" }}\n"
      "nominal = {{ position_km = [7000, {0}, 0], velocity_km_s = [0, 7.5, 0] }}\n"
      "deputy = {{ position_km = [7000.004, 0, {0}], velocity_km_s = [0, 0, 7.5] }}\n"
      "jet = {{ order = 2, duration_s = 60 }}\n[uncertainty]\nsamples = 0\n"
      "position_m = [5, 30, 5]\nvelocity_m_s = [0.03, 0.005, 0.005]\n[uncertainty.deputy]\n"
      "position_m = [5, 30, 5]\nvelocity_m_s = [0.03, 0.005, 0.005]\n"
      "[uncertainty.collision]\nradius_m = 10\nsamples = 20000\n{1}",
      along, collision);
}

// Across the velocity the deviations are 7.07 m along R and sqrt(30^2 + 5^2) / sqrt(2) of each, so
// 30.41 m of both, with the mean 4 m along R: of the disc of 10 m the integral is 0.16656 (scipy's
// dblquad). The states are those of the closest approach or of 5 ms later.
TEST_F(Collision, OfAStartWithinAPassageIsThatOfTheWholePassage) {
  constexpr double expected = 0.16656;
  for (const double late : {0.0, 0.005}) {
    write("scene.toml", passing(late, ""));
    const std::string out = in_one_line(succeed({"uncertainty", "scene.toml", "-o", "out"}).out);
    EXPECT_NE(out.find("the window is wider than the scene"), std::string::npos) << out;
    const Json collision = read_json(directory_ / "out/summary.json")["collision"];
    EXPECT_EQ(collision["window_widened"], true);
    EXPECT_LT(collision["window_s"][0], 0);
    EXPECT_NEAR(collision["window_s"][1].get<double>(), 60, 1e-9);
    const double error = 4 * collision["standard_error"].get<double>() + 1e-4;
    EXPECT_NEAR(collision["probability"].get<double>(), expected, error);
    ASSERT_EQ(collision["approaches"].size(), 1U);
    EXPECT_NEAR(collision["approaches"][0]["time_s"].get<double>(), -late, 1e-5);
    EXPECT_EQ(collision["approaches"][0]["short_encounter"]["holds"], true);
    EXPECT_TRUE(collision["warnings"].empty());
    const io::ConjunctionDataMessage message =
        io::read_cdm("encounter.cdm", content(directory_ / "out/encounter.cdm"));
    EXPECT_NEAR(*message.collision_probability, expected, error);
  }
}

TEST_F(Collision, WarnsOfAWindowThatCutsAPassage) {
  constexpr double expected = 0.16656;
  write("scene.toml", passing(0, "window_s = [0, 60]\n"));
  const std::string out = in_one_line(succeed({"uncertainty", "scene.toml", "-o", "out"}).out);
  EXPECT_NE(out.find("warning: an edge of the window 0 s to 60 s cuts a passage"),
            std::string::npos)
      << out;
  EXPECT_NE(out.find("of the whole passage 0.16"), std::string::npos) << out;
  EXPECT_NE(content(directory_ / "out/report.html").find("cuts a passage"), std::string::npos);
  const Json collision = read_json(directory_ / "out/summary.json")["collision"];
  EXPECT_EQ(collision["window_widened"], false);
  EXPECT_EQ(collision["warnings"].size(), 1U);
  EXPECT_LT(collision["probability"].get<double>(), 0.7 * expected);
  const Json& whole = collision["whole_passage"];
  const double error = 4 * whole["standard_error"].get<double>() + 1e-4;
  EXPECT_NEAR(whole["probability"].get<double>(), expected, error);
  const std::string text = content(directory_ / "out/encounter.cdm");
  const io::ConjunctionDataMessage message = io::read_cdm("encounter.cdm", text);
  EXPECT_NEAR(*message.collision_probability, expected, error);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 254U) << line;
}

// The closest approach was 5 ms before the window, and is told beside it, as that of the passage
// whose 3 deviations of 30.41 m and 10 m, at the root of 2 of 7.5 km/s, take 9.5 ms to each side.
TEST_F(Collision, SaysThatAnApproachIsOutsideTheWindow) {
  for (const auto& [late, is_in_window] : {std::pair{0.005, false}, {-0.005, true}}) {
    write("scene.toml", passing(late, "window_s = [0, 60]\n"));
    const std::string out = in_one_line(succeed({"uncertainty", "scene.toml", "-o", "out"}).out);
    EXPECT_EQ(out.find(" s (outside the window): ") == std::string::npos, is_in_window) << out;
    EXPECT_NE(out.find("straight while they pass, of the whole passage"), std::string::npos) << out;
    const Json collision = read_json(directory_ / "out/summary.json")["collision"];
    ASSERT_EQ(collision["approaches"].size(), 1U);
    const Json& approach = collision["approaches"][0];
    EXPECT_NEAR(approach["time_s"].get<double>(), -late, 1e-5);
    EXPECT_EQ(approach["in_window"], is_in_window);
    EXPECT_EQ(approach["short_encounter"]["cut_by_window"], true);
    EXPECT_EQ(approach["short_encounter"]["holds"], true);
  }
}

// A deputy that is uncertain by 100 km along a circle of 7000 km: (100 km)^2 / (2 * 7000 km) = 714
// m beside 5 m across. 1 km bends by 7 cm, beside 10 m of the radius and 7 m across.
TEST_F(Collision, WarnsOfDeviationsAlongTheTrackThatLeaveTheOrbit) {
  for (const auto& [along, warns] : {std::pair{100000, true}, {1000, false}}) {
    std::string text = passing(0, "");
    const std::size_t place = text.rfind("[5, 30, 5]");
    text.replace(place, 10, fmt::format("[5, {}, 5]", along));
    write("scene.toml", text);
    const std::string elements = in_one_line(succeed({"uncertainty", "scene.toml"}).out);
    EXPECT_EQ(elements.find("not to be trusted"), std::string::npos) << elements;
    EXPECT_EQ(elements.find("The start of the deputy is taken as Gaussian in elements") !=
                  std::string::npos,
              warns)
        << elements;
    const std::string out = in_one_line(succeed({"uncertainty", "scene.toml", "--set",
                                                 "uncertainty.gaussian_in=positions", "-o", "out"})
                                            .out);
    EXPECT_EQ(out.find("warning: the deputy is uncertain by 1e+05 m along its track") !=
                  std::string::npos,
              warns)
        << out;
    EXPECT_EQ(out.find("the probability is not to be trusted") != std::string::npos, warns);
    EXPECT_EQ(
        content(directory_ / "out/report.html").find("not to be trusted") != std::string::npos,
        warns);
    const Json collision = read_json(directory_ / "out/summary.json")["collision"];
    EXPECT_EQ(collision["warnings"].empty(), !warns) << collision["warnings"];
  }
}

TEST_F(Collision, TakesEveryConfidenceThatItsKeyAllows) {
  for (const std::string confidence : {"0.5", "0.999999"}) {
    write("scene.toml", passing(0, "confidence = " + confidence + "\n"));
    succeed({"uncertainty", "scene.toml", "-o", "out"});
    const Json collision = read_json(directory_ / "out/summary.json")["collision"];
    EXPECT_LT(collision["interval"][0], collision["probability"]);
    EXPECT_GT(collision["interval"][1], collision["probability"]);
  }
}

}  // namespace
}  // namespace hamjet::test
