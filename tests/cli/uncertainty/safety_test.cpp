#include <algorithm>
#include <cmath>
#include <numbers>

#include "../command_test.hpp"

// Passive safety in `hamjet uncertainty`: table [uncertainty.safety].

namespace hamjet::test {
namespace {

// A deputy that drifts towards its chief is to be stopped a kilometre ahead of it; another one
// waits a kilometre behind. The burn of 0.1 m/s has a size that is wrong by a hundredth.
const std::string stopped =
    "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\na_km = 7000\ne = 0\n"
    "i_deg = 50\nraan_deg = 0\nargp_deg = 0\nta_deg = 0\n[deputy]\nposition_m = [0, 1000, 0]\n"
    "[jet]\norder = 2\nduration_orbits = 1\n[uncertainty]\nsamples = 0\n"
    "[uncertainty.burn]\nvelocity_change_m_s = [0, -0.1, 0]\nmagnitude = 0.01\n"
    "[uncertainty.safety]\nkeep_apart_m = 50\nconfidence = 0.9999\nkeep_out_m = [200, 400, 200]\n";
const std::string waiting = "[[uncertainty.safety.deputy]]\nposition_m = [0, -1000, 0]\n";

/// The least separation in a revolution of a deputy that is a kilometre ahead (or so much more) and
/// has the velocity along the orbit, after Clohessy and Wiltshire:
///
///   R = 2 v (1 - cos n t) / n ,  T = ahead + 4 v sin(n t) / n - 3 v t .
double least_of_drift(double velocity_m_s, double ahead_m) {
  const double n = std::sqrt(398600.4415 / std::pow(7000.0, 3));
  double least = ahead_m;
  for (int k = 0; k <= 100000; ++k) {
    const double angle = 2 * std::numbers::pi * k / 100000;
    const double r = 2 * velocity_m_s * (1 - std::cos(angle)) / n;
    const double t = ahead_m + velocity_m_s * (4 * std::sin(angle) - 3 * angle) / n;
    least = std::min(least, std::hypot(r, t));
  }
  return least;
}

/// What linear motion leaves out of 2 km at a radius of 7000 km, 0.3 m, a few times in a
/// revolution, and a hundredth of the separation to be kept.
constexpr double accuracy_m = 2;

class Safety : public CommandTest {};

TEST_F(Safety, TellsEveryPairWithTheBurnDoneAndNotDone) {
  write("stopped.toml", stopped + waiting);
  const std::string out = in_one_line(succeed({"uncertainty", "stopped.toml", "-o", "out"}).out);
  for (const char* const words :
       {"passive safety", "chief and deputy", "deputy and deputy 2", "not done", "99 % beyond (m)",
        "with the burn not done", "keeps out up to", "least separations are within"}) {
    EXPECT_NE(out.find(words), std::string::npos) << words << " is not in " << out;
  }
  // A table of 80 characters breaks in two, of which each part says which rows are which.
  const std::string row = "chief and deputy, burn not done";
  EXPECT_NE(out.find(row), std::string::npos) << out;
  EXPECT_NE(out.find(row), out.rfind(row)) << out;
  const Json pairs = read_json(directory_ / "out/summary.json")["safety"]["pairs"];
  const auto pair = [&](const std::string& first, const std::string& second, const Json& share) {
    for (const Json& one : pairs) {
      if (one["first"] == first && one["second"] == second && one["burn_share"] == share)
        return one;
    }
    ADD_FAILURE() << first << ' ' << second << ' ' << share;
    return Json();
  };
  // Three pairs, of which two have a part in the burn, and that not done and done.
  ASSERT_EQ(pairs.size(), 5U);
  const Json still = pair("chief", "deputy 2", nullptr);
  EXPECT_NEAR(still["separation_m"].get<double>(), 1000, accuracy_m);
  const Json drifting = pair("chief", "deputy", 0.0);
  const double missed = least_of_drift(0.1, 1000);
  EXPECT_LT(missed, 400);
  EXPECT_NEAR(drifting["mean_separation_m"].get<double>(), missed, accuracy_m);
  EXPECT_NEAR(drifting["separation_m"].get<double>(), missed, accuracy_m);
  EXPECT_NEAR(pair("deputy", "deputy 2", 0.0)["separation_m"].get<double>(),
              least_of_drift(0.1, 2000), accuracy_m);
  // One case in a hundred is slower by 2.326 standard deviations of 1 mm/s.
  const Json done = pair("chief", "deputy", 1.0);
  const double slow = least_of_drift(0.001 * 2.3263478740408408, 1000);
  EXPECT_LT(slow, 965);
  EXPECT_LT(done["separation_interval_m"][0].get<double>() - accuracy_m, slow);
  EXPECT_GT(done["separation_interval_m"][1].get<double>() + accuracy_m, slow);
  EXPECT_NEAR(done["separation_m"].get<double>(), slow, 10);
  EXPECT_LT(done["flight_difference_m"].get<double>(), 0.5);
  EXPECT_EQ(done["nearer"], 0);
  EXPECT_NEAR(done["keep_out_flown_ratio"].get<double>(), 1, 1e-3);
  // A deputy that drifts as the margin says comes within 400 m of the chief along the orbit, but no
  // slower one does.
  const double deviations = done["keep_out_deviations"];
  EXPECT_LT(least_of_drift(0.001 * deviations, 1000), 400 + accuracy_m);
  EXPECT_GT(least_of_drift(0.001 * 0.9 * deviations, 1000), 400);
  const Table table = read_table(directory_ / "out/safety.csv");
  EXPECT_EQ(table.rows.size(), 5U);
}

TEST_F(Safety, ChecksWhatTheSceneAsksFor) {
  const auto run = [&](const std::string& keys) {
    write("scene.toml", stopped + keys);
    return hamjet({"uncertainty", "scene.toml", "-o", "out"});
  };
  const auto summary = [&] { return read_json(directory_ / "out/summary.json"); };
  // Without the burn, which nothing scatters, the deputy passes at the drift's least separation.
  const double missed = least_of_drift(0.1, 1000);
  const auto separation = [](double metres) {
    return "burn_shares = [0]\nleast_separation_m = " + std::to_string(metres) + "\n";
  };
  EXPECT_EQ(run(separation(missed - accuracy_m)).exit_code, 0);
  EXPECT_EQ(summary()["exit_code"], 0);
  EXPECT_TRUE(summary()["failed_checks"].empty());
  const CommandResult failed = run(separation(missed + accuracy_m));
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_NE(failed.err.find("uncertainty.safety.least_separation_m"), std::string::npos)
      << failed.err;
  EXPECT_NE(in_one_line(failed.out).find("check failed: chief and deputy, burn not done: 99 % of"),
            std::string::npos)
      << failed.out;
  EXPECT_EQ(summary()["exit_code"], 1);
  EXPECT_EQ(summary()["failed_checks"].size(), 1U);
  // With the burn, a deputy so many standard deviations of 1 mm/s too slow comes within 400 m.
  double least = 0;
  double most = 40;  // there 700 m of drift a revolution
  for (int k = 0; k < 30; ++k) {
    const double middle = (least + most) / 2;
    (least_of_drift(0.001 * middle, 1000) > 400 ? least : most) = middle;
  }
  const auto deviations = [&](double part) {
    return run("burn_shares = [1]\nleast_deviations = " + std::to_string(part * least) + "\n")
        .exit_code;
  };
  // A tenth is more than what the ellipsoid's other axes make of it.
  EXPECT_EQ(deviations(0.9), 0);
  EXPECT_EQ(deviations(1.1), 1);
}

// A relative ellipse of 1 km, about 2 km ahead, comes to its chief once in a revolution, which
// nodes a revolution apart never see: 4 km apart there. Expected: both orbits by scipy's DOP853 at
// 1e-13.
TEST_F(Safety, SeesWhatHappensWithinRevolutions) {
  write(
      "ellipse.toml",
      "system = { model = \"zonal-gravity\", mu_km3_s2 = 398600.4415, radius_km = 6378.1363, J2 = "
      "1.08262668355315e-3 }\nnominal = { a_km = 7000, e = 0.001, i_deg = 98, raan_deg = 10, "
      "argp_deg = 0, ta_deg = 40 }\njet = { order = 2, duration_orbits = 2 }\n[deputy]\n"
      "a_dlambda_m = 2000\na_dex_m = 766.0444431\na_dey_m = -642.7876097\n[uncertainty]\n"
      "position_m = [0.05, 0.05, 0.05]\nsamples = 0\n[uncertainty.safety]\nkeep_apart_m = 1000\n"
      "samples = 200\n");
  succeed({"uncertainty", "ellipse.toml", "-o", "out"});
  const Json pair = read_json(directory_ / "out/summary.json")["safety"]["pairs"][0];
  EXPECT_NEAR(pair["mean_separation_m"].get<double>(), 53.18154, 1e-4);
  EXPECT_LT(pair["separation_m"].get<double>(), 54);
  EXPECT_EQ(pair["nearer"], 200);
}

// 30 km along the track bend by (3 * 30 km)^2 / (2 * 7000 km) = 579 m in the rarest cases.
TEST_F(Safety, WarnsOfDeviationsAlongTheTrackThatLeaveTheOrbit) {
  std::string text = stopped;
  text.replace(text.find("samples = 0"), 11,
               "samples = 0\nposition_m = [1, 30000, 1]\nvelocity_m_s = [0, 0, 0]");
  write("long.toml", text);
  const std::string elements = in_one_line(succeed({"uncertainty", "long.toml"}).out);
  EXPECT_EQ(elements.find("not to be trusted"), std::string::npos) << elements;
  const std::string out = in_one_line(succeed({"uncertainty", "long.toml", "--set",
                                               "uncertainty.gaussian_in=positions", "-o", "out"})
                                          .out);
  EXPECT_NE(out.find("its least separation is not to be trusted"), std::string::npos) << out;
  EXPECT_FALSE(read_json(directory_ / "out/summary.json")["safety"]["warnings"].empty());
  write("stopped.toml", stopped);
  succeed({"uncertainty", "stopped.toml", "-o", "out"});
  EXPECT_TRUE(read_json(directory_ / "out/summary.json")["safety"]["warnings"].empty());
}

TEST_F(Safety, RefusesWhatDoesNotFit) {
  const auto refuse = [&](std::string scene, const std::string& from, const std::string& to,
                          const std::vector<std::string>& words) {
    scene.replace(scene.find(from), from.size(), to);
    write("scene.toml", scene);
    expect_error({"uncertainty", "scene.toml"}, 3, words);
  };
  refuse(stopped, "keep_apart_m = 50", "keep_apart_m = 80000",
         {"uncertainty.safety.keep_apart_m", "too large"});
  refuse(stopped, "keep_apart_m = 50", "keep_apart_m = 5e-324",
         {"uncertainty.safety.keep_apart_m", "too small", "must be 0.0007 or more"});
  refuse(stopped, "keep_apart_m = 50\n", "", {"uncertainty.safety.keep_apart_m", "missing"});
  refuse(stopped, "keep_apart_m = 50", "keep_apart_m = 50\nburn_shares = [0, 1.5]",
         {"uncertainty.safety.burn_shares.1", "out of range"});
  refuse(stopped, "keep_apart_m = 50", "keep_apart_m = 50\nburn_shares = [0.5, 0.5]",
         {"uncertainty.safety.burn_shares.1", "or twice"});
  refuse(stopped + "least_deviations = 3\n", "keep_out_m = [200, 400, 200]\n", "",
         {"uncertainty.safety.least_deviations", "there is no ellipsoid"});
  refuse(stopped + "burn_shares = [1]\n",
         "[uncertainty.burn]\nvelocity_change_m_s = [0, -0.1, 0]\nmagnitude = 0.01\n",
         "position_m = [1, 1, 1]\n[uncertainty.deputy]\nposition_m = [1, 1, 1]\n",
         {"uncertainty.safety.burn_shares", "there is no burn"});
  refuse(stopped + waiting, "position_m = [0, -1000, 0]", "frame = \"RTN\"",
         {"uncertainty.safety.deputy", "frame", "which is in the frame of the table [deputy]"});
}

}  // namespace
}  // namespace hamjet::test
