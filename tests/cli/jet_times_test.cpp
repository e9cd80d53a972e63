#include <fmt/format.h>
#include <sys/stat.h>

#include <cmath>
#include <thread>

#include "evaluation/eval_command_test.hpp"
#include "formats/hdf5/hdf5_jets.hpp"

// Jets at the times of `jet.times_...`, written by `hamjet run` and taken by `hamjet eval --time`.

namespace hamjet::test {
namespace {

/// A circle on which the angular velocity is 1e-3 per second.
const std::string timed_scene = circular_orbit +
                                "[jet]\norder = 6\nduration_s = 6000\n"
                                "times_s = [600, 1500, 4000, 6000]\n" +
                                gauss8("tolerance = 1e-14");
constexpr double radius_m = 7e6;
constexpr double rate = 1e-3;

/// A deputy on the circle above the chief's, 700 m higher: relative position along R and T after a
/// time, for it runs ahead by the difference of the angular velocities.
constexpr double higher = 1e-4;
std::pair<double, double> deputy_after(double time_s) {
  const double angle = rate * (std::pow(1 + higher, -1.5) - 1) * time_s;
  // 1 + higher, times the cosine, minus 1, computed without cancellation.
  const double r = radius_m * (higher - (1 + higher) * 2 * std::pow(std::sin(angle / 2), 2));
  return {r, radius_m * (1 + higher) * std::sin(angle)};
}

/// The start of the deputy, with the velocity as seen from the turning axes.
std::string deputy_start() {
  const double speed = radius_m * rate * (1 / std::sqrt(1 + higher) - (1 + higher));
  return fmt::format("{:.17g},0,0,0,{:.17g},0", radius_m * higher, speed);
}

/// The coefficients are right to ten tolerances of their largest, which reaches 6 pi for degree 1
/// within a revolution, and so is the deputy to 1e-14 x 10 x 20 of its 1000 m; coordinates of
/// 7000 km round to 1e-9 m, a hundred times over in the evaluation.
constexpr double allowed_m = 1e-6;

using JetTimes = EvalTest;

TEST_F(JetTimes, AreOfTheMotionAtEach) {
  store("circular", timed_scene);
  const Json json = eval_json({"circular", "--deviation", deputy_start(), "--time", "all"});
  const std::vector<double> times = {600, 1500, 4000, 6000};
  ASSERT_EQ(json["rows"].size(), times.size());
  EXPECT_EQ(json["times"], 4);
  EXPECT_EQ(json["points"], 4);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Json& row = json["rows"][i];
    EXPECT_NEAR(row["time_s"].get<double>(), times[i], 1e-12 * times[i]);
    const auto [r, t] = deputy_after(times[i]);
    EXPECT_NEAR(row["R_m"].get<double>(), r, allowed_m);
    EXPECT_NEAR(row["T_m"].get<double>(), t, allowed_m);
    EXPECT_NEAR(row["N_m"].get<double>(), 0, allowed_m);
    EXPECT_EQ(row["support"], "inside");
    EXPECT_LT(row["miss_estimate_m"].get<double>(), 1e-3);
  }
  // The times may be in any order, and the end may be given by its time.
  const Json two = eval_json({"circular", "--deviation", deputy_start(), "--time", "6000,1500"});
  EXPECT_EQ(two["rows"][0], json["rows"][3]);
  EXPECT_EQ(two["rows"][1], json["rows"][1]);
  const Table table = parse_table(
      succeed({"eval", "circular", "--deviation", deputy_start(), "--time", "600", "-q"}).out);
  EXPECT_EQ(table.header, "time_s," + rtn_header + ",miss_estimate_m,support");
}

TEST_F(JetTimes, AreInEveryFormatByThemselves) {
  const bool with_hdf5 = io::hdf5_available();
  store("circular", timed_scene,
        {"--set", with_hdf5 ? "output.formats=[\"dace\", \"hdf5\"]" : "output.formats=[\"dace\"]"});
  const std::vector<double> right = eval_one("circular", deputy_start(), {"--time", "1500"});
  std::vector<std::string> files = {"jet.csv", "jet.dace"};
  if (with_hdf5) files.emplace_back("jets.h5");
  for (const std::string& file : files) {
    std::vector<double> alone =
        eval_one("circular/gauss8/time-0002/" + file, deputy_start(), {"--time", "1500"});
    EXPECT_EQ(alone, right) << file;
  }
  succeed({"convert", "circular", "copy.dace", "--time", "1500"});
  EXPECT_EQ(content(directory_ / "copy.dace"),
            content(directory_ / "circular/gauss8/time-0002/jet.dace"));
  // The files of the end are where they always are.
  EXPECT_FALSE(std::filesystem::exists(directory_ / "circular/gauss8/time-0004"));
}

TEST_F(JetTimes, ThatAreNotThereAreRefused) {
  store("circular", timed_scene);
  const auto expect = [&](const std::string& time, const std::vector<std::string>& words) {
    expect_error({"eval", "circular", "--deviation", deputy_start(), "--time", time}, 2, words);
  };
  expect("601", {"no jet of the run gauss8 at 601 s", "600, 1500, 4000, 6000 s", "jet.times_s"});
  expect("soon", {"--time", "seconds between commas, or all", "soon"});
  expect("", {"--time: empty"});
  expect_error({"eval", "circular/gauss8/time-0001/jet.csv", "--deviation", deputy_start(),
                "--time", "1500"},
               2, {"has the jet at 600 s alone", "1500 s"});
  expect_error({"convert", "circular", "x.dace", "--time", "all"}, 2, {"--time: must be one time"});
  // A file that was changed since is noticed.
  const std::filesystem::path file = directory_ / "circular/gauss8/time-0003/jet.csv";
  write("circular/gauss8/time-0003/jet.csv", content(file) + " ");
  expect_error({"eval", "circular", "--deviation", deputy_start(), "--time", "4000"}, 5,
               {"time-0003/jet.csv"});
}

TEST_F(JetTimes, OfAScene) {
  const auto expect = [&](const std::string& setting, const std::vector<std::string>& words) {
    expect_error({"check", "circular.toml", "--set", setting}, 3, words);
  };
  write("circular.toml", timed_scene);
  expect("jet.times_s=[0, 10]", {"jet.times_s", "zero", "identity"});
  expect("jet.times_s=[10, 6001]", {"jet.times_s", "outside the span", "1.000"});
  expect("jet.times_s=[-10]", {"jet.times_s", "outside the span"});
  expect("jet.times_s=[20, 10]", {"jet.times_s", "out of order"});
  expect("jet.count=3", {"more than one", "times_s, count"});
  expect("jet.arcs=\"auto\"", {"jet.times_s", "one propagation"});
  expect("integrator=[{method=\"fehlberg78\", tolerance=1e-9}]",
         {"jet.times_s", "fehlberg78", "must be gauss"});
  const std::string told = succeed({"check", "circular.toml"}).out;
  EXPECT_NE(told.find("3 times to 4000 s too"), std::string::npos) << told;
}

// Every jet takes the rows from the first on, which a pipe gives once.
TEST_F(JetTimes, OfRowsFromAPipeOrStandardInput) {
  store("circular", timed_scene);
  std::string text = rtn_header + "\n";
  // The number of rows is larger than the number evaluated at once.
  for (int i = 0; i < 5000; ++i) text += fmt::format("{},0,0,0,0,0\n", i % 100);
  write("start.csv", text);
  std::vector<std::string> command = {"eval", "circular",     "--time",   "600,4000",
                                      "-q",   "--deviations", "start.csv"};
  const std::string right = succeed(command).out;
  EXPECT_EQ(parse_table(right).rows.size(), 10000U);
  command.back() = "-";
  options_.input = directory_ / "start.csv";
  EXPECT_TRUE(succeed(command).out == right);
  options_.input.clear();
  ASSERT_EQ(::mkfifo((directory_ / "pipe").c_str(), 0600), 0);
  command.back() = "pipe";
  std::thread writer([&] { std::ofstream(directory_ / "pipe") << text; });
  EXPECT_TRUE(succeed(command).out == right);
  writer.join();
}

}  // namespace
}  // namespace hamjet::test
