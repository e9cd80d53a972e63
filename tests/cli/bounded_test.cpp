#include <algorithm>
#include <cmath>

#include "command_test.hpp"

// The commands `poincare` and `bounded`: frozen orbits, and deputies that stay.

namespace hamjet::test {
namespace {

class LongMotion : public CommandTest {
 protected:
  static std::string scene(const std::string& inclination_deg, const std::string& table) {
    return "[system]\nmodel = \"zonal-gravity\"\nmu_km3_s2 = 398600.4415\nradius_km = 6378.1363\n"
           "J2 = 1.0826e-3\nJ3 = -2.53e-6\n[nominal]\na_km = 7100\ne = 0.01\ni_deg = " +
           inclination_deg +
           "\nraan_deg = 0\nargp_deg = 30\nta_deg = 0\n"
           "[jet]\norder = 3\nduration_orbits = 1\n" +
           table;
  }
};

TEST_F(LongMotion, PoincareWritesTheFrozenOrbit) {
  write("low.toml", scene("50", ""));
  const std::string out = in_one_line(succeed({"poincare", "low.toml"}).out);
  for (const char* const words :
       {"The frozen orbit of the chief's energy", "It is stable: its multipliers are",
        "amplitude turns a revolution", "(chief)", "results: out/low-poincare"}) {
    EXPECT_NE(out.find(words), std::string::npos) << words << " is not in " << out;
  }
  const Json summary = read_json(directory_ / "out/low-poincare/summary.json");
  EXPECT_EQ(summary["study"], "poincare");
  EXPECT_EQ(summary["exit_code"], 0);
  EXPECT_LT(summary["frozen_orbit"]["residual"].get<double>(), 1e-20);
  // Cook's first order: e = -(J3 R sin i)/(2 J2 a), to the periodic terms of J2.
  const double e =
      2.53e-6 / 1.0826e-3 * 6378.1363 / 7100 * std::sin(50 * std::acos(-1.0) / 180) / 2;
  EXPECT_NEAR(summary["frozen_orbit"]["e"].get<double>(), e, 1.5e-3);
  // The page has its four plots, and says the same first.
  const std::string page = content(directory_ / "out/low-poincare/report.html");
  for (const char* const heading :
       {"Multipliers", "Frequency against amplitude", "Where the normal form stops being right",
        "Circles of the normal form"}) {
    EXPECT_NE(page.find(std::string("<h2>") + heading), std::string::npos) << heading;
  }
  EXPECT_NE(page.find("The frozen orbit of the chief"), std::string::npos);
  const Table table = read_table(directory_ / "out/low-poincare/poincare.csv");
  ASSERT_EQ(table.rows.size(), summary["circles"].size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_EQ(table.number(i, "rotation_number"),
              summary["circles"][i]["rotation_number"].get<double>());
  }
}

TEST_F(LongMotion, PoincareWritesTheEventOfAScene) {
  const std::string kepler =
      "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\na_km = 9000\ne = 0.2\n"
      "i_deg = 50\nraan_deg = 30\nargp_deg = 70\nta_deg = 90\n"
      "[jet]\norder = 4\nduration_orbits = 3\n[event]\n";
  write("apsis.toml", kepler + "surface = \"apsis\"\ndirection = \"rising\"\nnumber = 2\n");
  const std::string out = in_one_line(succeed({"poincare", "apsis.toml"}).out);
  EXPECT_NE(out.find("The chief meets r . v = 0, rising (event 2) after"), std::string::npos)
      << out;
  const Json summary = read_json(directory_ / "out/apsis-poincare/summary.json");
  // From the true anomaly of 90 degrees, cos E = e: the second pericentre is a period less M, and a
  // period, later (Kepler's equation).
  const double E = std::acos(0.2);
  const double n = std::sqrt(398600.4415 / std::pow(9000.0, 3));
  const double pi = std::acos(-1.0);
  EXPECT_NEAR(summary["time_s"].get<double>(), (4 * pi - (E - 0.2 * std::sin(E))) / n, 1e-8);
  // Degree 4 leaves what grows with the fifth power, linear polynomials with the second.
  const Table misses = read_table(directory_ / "out/apsis-poincare/event.csv");
  ASSERT_EQ(misses.rows.size(), 5U);
  EXPECT_NEAR(std::log10(misses.number(4, "linear_position_miss_m") /
                         misses.number(3, "linear_position_miss_m")),
              2, 0.1);
  EXPECT_LT(misses.number(3, "position_miss_m"), 1e-3 * misses.number(3, "linear_position_miss_m"));
  // Time and six components, of 210 monomials each.
  const Table map = read_table(directory_ / "out/apsis-poincare/event-map.csv");
  EXPECT_EQ(map.rows.size(), 7U * 210);
  // A number of events that the duration does not hold is refused, and so are keys of other
  // surfaces.
  for (const auto& [keys, message] : std::vector<std::pair<std::string, std::string>>{
           {"surface = \"apsis\"\nnumber = 7\n", "the chief has 6; must be at most 6"},
           {"surface = \"distance\"\n", "event.distance_km: missing"},
           {"surface = \"apsis\"\nnormal = [0, 0, 1]\n", "event.normal: not of this surface"},
           {"surface = \"plane\"\nnormal = [0, 0, 0]\n", "event.normal: no direction"}}) {
    write("bad.toml", kepler + keys);
    expect_error({"poincare", "bad.toml"}, 3, {message});
  }
}

TEST_F(LongMotion, BoundedWritesDeputiesThatStay) {
  write("low.toml", scene("50", "[bounded]\nsizes_km = [2]\nrevolutions = 20\n"));
  const std::string out = in_one_line(succeed({"bounded", "low.toml"}).out);
  for (const char* const words :
       {"with the chief's mean nodal period and drift of the node; flown over 20 revolutions",
        "poincare-map", "refined", "j2-invariant", "mean-elements",
        "report: out/low-bounded/report.html"}) {
    EXPECT_NE(out.find(words), std::string::npos) << words << " is not in " << out;
  }
  const Json summary = read_json(directory_ / "out/low-bounded/summary.json");
  ASSERT_EQ(summary["deputies"].size(), 4U);
  const Json& map = summary["deputies"][0];
  EXPECT_NEAR(map["size_m"].get<double>(), 2000, 1);
  EXPECT_LT(std::abs(map["window_along_drift"].get<double>()), 1e-6);
  EXPECT_GT(map["window_along_doubt"].get<double>(), 0);
  // The start as a scene's deputy: `hamjet motion` has it at the size.
  const auto listed = [&](const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += map["RTN-rotating." + name].dump() + ",";
    return list;
  };
  const std::string position = listed({"R_m", "T_m", "N_m"});
  const std::string velocity = listed({"vR_m_s", "vT_m_s", "vN_m_s"});
  write("two.toml", scene("50", "[deputy]\nposition_m = [" + position + "]\nvelocity_m_s = [" +
                                    velocity + "]\n"));
  succeed({"motion", "two.toml", "-q"});
  const Json motion = read_json(directory_ / "out/two-motion/summary.json");
  EXPECT_NEAR(motion["farthest"]["separation_m"].get<double>(), 2000, 2);
}

TEST_F(LongMotion, BoundedKeepsADeputyInABox) {
  const std::string box = "[bounded.box]\nhalf_widths_m = [3, 3, 3]\ndays = 0.5\n";
  write("kept.toml",
        scene("50",
              "[bounded]\nsizes_km = [0.1]\nalong_track = -1\ncross_track = 0\nrevolutions = 10\n" +
                  box + "reference = \"rest\"\nposition_m = [0, -100, 0]\n"));
  const std::string out = in_one_line(succeed({"bounded", "kept.toml"}).out);
  EXPECT_NE(
      out.find("Kept for 0.5 days in a box of +-3, 3 and 3 m along R, T and N about its place"),
      std::string::npos)
      << out;
  const Json told = read_json(directory_ / "out/kept-bounded/summary.json")["box"];
  const Table table = read_table(directory_ / "out/kept-bounded/box.csv");
  ASSERT_EQ(table.rows.size(), told["returns"].get<std::size_t>());
  ASSERT_GE(table.rows.size(), 1U);
  double sum = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    for (const std::string which : {"first", "second"}) {
      const auto part = [&](const char* axis) { return table.number(i, which + axis); };
      sum += std::hypot(part("_r_m_s"), part("_t_m_s"), part("_n_m_s"));
    }
  }
  EXPECT_NEAR(told["total_change_m_s"].get<double>(), sum, 1e-12 * sum);
  EXPECT_NEAR(told["change_m_s_a_day"].get<double>(), sum / 0.5, 1e-12 * sum);
  EXPECT_LE(told["farthest_of_all"].get<double>(), 1.000001);
  EXPECT_EQ(told["held"], true);
  EXPECT_NE(content(directory_ / "out/kept-bounded/report.html").find("In the box"),
            std::string::npos);
  EXPECT_TRUE(told["burns_total_change_m_s"].is_null());
  // Burns last as long as their changes take, and their sums are those of the rows.
  succeed({"bounded", "kept.toml", "-q", "-o", "burns", "--set",
           "thruster={thrust_N=1e-3, mass_kg=10, specific_impulse_s=200}"});
  const Json burned = read_json(directory_ / "burns/summary.json")["box"];
  const Table burns = read_table(directory_ / "burns/box.csv");
  ASSERT_EQ(burns.rows.size(), table.rows.size());
  double change = 0;
  double farthest = 0;
  for (std::size_t i = 0; i < burns.rows.size(); ++i) {
    const double length_s = burns.number(i, "first_burn_s") + burns.number(i, "second_burn_s");
    change += burns.number(i, "burns_m_s");
    farthest = std::max(farthest, burns.number(i, "burns_farthest"));
    // The mass falls by less than a ten-thousandth.
    EXPECT_NEAR(burns.number(i, "burns_m_s"), 1e-4 * length_s, 1e-8 * length_s);
    EXPECT_LE(burns.number(i, "burns_miss_m"), 3e-5);
    EXPECT_NEAR(burns.number(i, "first_burn_m_s") + burns.number(i, "second_burn_m_s"),
                burns.number(i, "burns_m_s"), 1e-15);
    // The middle of a burn is the time of its impulse.
    EXPECT_NEAR(burns.number(i, "first_burn_start_s") + burns.number(i, "first_burn_s") / 2,
                burns.number(i, "time_s"), 1e-3);
    EXPECT_EQ(burns.at(i, "burns_failure"), "");
  }
  EXPECT_NEAR(burned["burns_total_change_m_s"].get<double>(), change, 1e-12 * change);
  EXPECT_EQ(burned["burns_farthest_of_all"].get<double>(), farthest);
  // By the rocket equation.
  EXPECT_NEAR(burned["burns_propellant_kg"].get<double>(),
              -10 * std::expm1(-change / (200 * 9.80665)), 1e-9 * change);
  EXPECT_EQ(burned["burns_held"], true);
  // Propellant for a part of the returns: their sums are those of the burns that there are.
  const double half = burned["burns_propellant_kg"].get<double>() / 2;
  const CommandResult dry =
      hamjet({"bounded", "kept.toml", "-q", "-o", "dry", "--set",
              "thruster={thrust_N=1e-3, mass_kg=10, specific_impulse_s=200, propellant_kg=" +
                  std::to_string(half * 1e6) + "e-6}"});
  EXPECT_EQ(dry.exit_code, 1);
  EXPECT_NE(in_one_line(dry.err).find("kg left"), std::string::npos) << dry.err;
  const Json of_dry = read_json(directory_ / "dry/summary.json")["box"];
  EXPECT_LE(of_dry["burns_propellant_kg"].get<double>(), half);
  EXPECT_EQ(of_dry["held"], true);
  EXPECT_EQ(of_dry["burns_held"], false);
  const Table part = read_table(directory_ / "dry/box.csv");
  double spent = 0;
  for (std::size_t i = 0; i < part.rows.size(); ++i) {
    if (part.at(i, "burns_failure").empty()) spent += part.number(i, "burns_m_s");
  }
  EXPECT_NEAR(of_dry["burns_total_change_m_s"].get<double>(), spent, 1e-12 * spent);
  const CommandResult weak = hamjet(
      {"bounded", "kept.toml", "-q", "-o", "weak", "--set", "thruster={acceleration_m_s2=1e-9}"});
  EXPECT_EQ(weak.exit_code, 1);
  EXPECT_NE(weak.err.find("bounded.box: burns do not keep the deputy: return 1: "),
            std::string::npos)
      << weak.err;
  // Ways back of a quarter of a revolution bulge by half of 3 n^2 x t^2, n the mean motion, out of
  // a box this narrow.
  write("left.toml", scene("50",
                           "[bounded]\nsizes_km = [0.1]\nalong_track = -1\ncross_track = "
                           "0\nrevolutions = 10\n[bounded.box]\nhalf_widths_m = [0.1, 0.1, "
                           "0.1]\ndays = 0.5\nreference = \"rest\"\nposition_m = [0, -100, "
                           "0]\nreturn_orbits = [0.25]\n"));
  const CommandResult left = hamjet({"bounded", "left.toml"});
  EXPECT_EQ(left.exit_code, 1);
  EXPECT_NE(left.err.find("bounded.box: the deputy was not kept inside"), std::string::npos);
  const Json of_left = read_json(directory_ / "out/left-bounded/summary.json");
  EXPECT_EQ(of_left["box"]["held"], false);
  EXPECT_EQ(of_left["exit_code"], 1);
  // What cannot be a box.
  const std::string head = scene("50", "[bounded]\nsizes_km = [0.1]\n");
  write("flat.toml", head + "[bounded.box]\nhalf_widths_m = [3, 0, 3]\n");
  write("nowhere.toml", head + box + "reference = \"rest\"\n");
  write("two.toml", head + box + "position_m = [0, 1, 0]\n");
  write("late.toml", head + box + "return_orbits = [0.25, 9]\n");
  expect_error({"bounded", "flat.toml"}, 3, {"bounded.box.half_widths_m"});
  expect_error({"bounded", "nowhere.toml"}, 3, {"bounded.box.position_m: missing"});
  expect_error({"bounded", "two.toml"}, 3, {"bounded.box.position_m: not of this reference"});
  expect_error({"bounded", "late.toml"}, 3,
               {"bounded.box.return_orbits.1: out of range, got 9, must be from 0.01 to 5"});
}

TEST_F(LongMotion, RefusesWithTheReason) {
  write("low.toml", scene("50", ""));
  write("flat.toml", scene("0.1", "[bounded]\nrevolutions = 20\n"));
  write("wide.toml", scene("50", "[bounded]\nsizes_km = [1, 9000]\n"));
  expect_error({"bounded", "low.toml"}, 3,
               {"low.toml: bounded: missing, must be a table [bounded]; the smallest is"});
  expect_error({"bounded", "wide.toml"}, 3, {"bounded.sizes_km.1: out of range, got 9000"});
  for (const char* const command : {"bounded", "poincare"}) {
    expect_error({command, "flat.toml"}, 3,
                 {"flat.toml: nominal: no chief with a node", "got an inclination of 0.1 deg",
                  "within 0.57 deg of the equatorial plane"});
  }
  EXPECT_FALSE(std::filesystem::exists(directory_ / "out"));
}

// In such a field states come back after no time at all, after two revolutions, or not at all:
// which of these Newton's method comes to is for rounding to decide.
TEST_F(LongMotion, PoincareRefusesReturnsThatAreNoRevolution) {
  const std::string follower = HAMJET_SOURCE_DIR "/data/scenes/bounded-follower.toml";
  for (const char* const J2 : {"0.25", "0.3"}) {
    const CommandResult result =
        hamjet({"poincare", follower, "--set", std::string("system.J2=") + J2});
    EXPECT_EQ(result.exit_code, 4) << result.out;
    const bool none = result.err.find("frozen orbit: none was found") != std::string::npos;
    EXPECT_TRUE(none || result.err.find("still") != std::string::npos) << result.err;
  }
}

// Near the equator a smaller eccentricity asks for an inclination below 0.
TEST_F(LongMotion, BoundedFailsWhereNoSizeHasADeputy) {
  const CommandResult result =
      hamjet({"bounded", HAMJET_SOURCE_DIR "/data/scenes/bounded-sun-synchronous.toml", "--set",
              "nominal.i_deg=0.7", "--set", "bounded.revolutions=20", "--set",
              "bounded.sizes_km=[1000]", "-o", "flat"});
  EXPECT_EQ(result.exit_code, 4) << result.out;
  EXPECT_NE(result.err.find("none of the sizes has a deputy"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("inclination would have to be below 0"), std::string::npos)
      << result.err;
  EXPECT_EQ(read_json(directory_ / "flat/summary.json")["exit_code"], 4);
}

TEST_F(LongMotion, BoundedSaysWhichDeputiesPassInsideTheBody) {
  std::string low =
      scene("50", "[bounded]\nsizes_km = [1, 1000]\nphase_deg = 0\nrevolutions = 10\n");
  low.replace(low.find("7100"), 4, "6450");
  write("low.toml", low);
  const CommandResult result = hamjet({"bounded", "low.toml"});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  const std::string out = in_one_line(result.out);
  EXPECT_NE(out.find("4 of the 8 orbits cannot be flown"), std::string::npos) << out;
  EXPECT_NE(out.find("1000 km by refined: no orbit that can be flown"), std::string::npos) << out;
  EXPECT_EQ(out.find("1 km by refined: no orbit"), std::string::npos) << out;
}

// Frozen eccentricities of a thousandth take an orbit a kilometre above the equator's radius below
// it.
TEST_F(LongMotion, PoincareSaysThatTheOrbitIsInsideTheBody) {
  std::string low = scene("50", "");
  low.replace(low.find("7100"), 4, "6379");
  write("inside.toml", low);
  write("outside.toml", scene("50", ""));
  const CommandResult inside = hamjet({"poincare", "inside.toml"});
  EXPECT_EQ(inside.exit_code, 1) << inside.err;
  const std::string out = in_one_line(inside.out);
  EXPECT_NE(out.find("no orbit that can be flown: its perigee lies"), std::string::npos) << out;
  EXPECT_EQ(in_one_line(succeed({"poincare", "outside.toml"}).out).find("can be flown"),
            std::string::npos);
  const auto frozen = [&](const char* name) {
    return read_json(directory_ / "out" / (std::string(name) + "-poincare") / "summary.json")
        .at("frozen_orbit");
  };
  EXPECT_EQ(frozen("inside")["inside_body"], true);
  EXPECT_LT(frozen("inside")["a_km"].get<double>() * (1 - frozen("inside")["e"].get<double>()),
            6378.1363);
  EXPECT_EQ(frozen("outside")["inside_body"], false);
}

}  // namespace
}  // namespace hamjet::test
