#include <cmath>
#include <csignal>

#include "command_test.hpp"
#include "text/html_text.hpp"

// hamjet transfer, validity and assign as a user runs them: what they leave, and every mistake that
// a scene may make.

namespace hamjet::test {
namespace {

/// A circular Kepler orbit, on which the linear answer is that of Clohessy and Wiltshire.
const std::string circle = R"(schema = 1
title = "circle"
[system]
model = "kepler"
mu_km3_s2 = 398600.4415
)" + changed(orbit_elements, "e = 0.1", "e = 0") +
                           R"([jet]
order = 3
duration_orbits = 0.9
)" + gauss8("tolerance = 1e-13");

constexpr const char* transfer = R"([transfer]
frame = "RTN"
times_orbits = [0.2, 0.3, 0.7]
[transfer.start]
position_m = [0, -1000, 200]
[transfer.end]
position_m = [0, 100, 0]
)";

constexpr const char* assignment = R"([transfer]
frame = "RTN"
times_orbits = [0.2, 0.3]
[assignment]
[[assignment.deputy]]
position_m = [0, -1000, 0]
[[assignment.deputy]]
position_m = [0, 1000, 0]
[[assignment.slot]]
position_m = [0, 900, 0]
[[assignment.slot]]
position_m = [0, -900, 0]
)";

class TransferCommand : public CommandTest {
 protected:
  TransferCommand() {
    write("circle.toml", circle);
    write("transfer.toml", circle + transfer);
    write("assignment.toml", circle + assignment);
    write("validity.toml", circle + "[validity]\ntimes_orbits = [0.3, 0.9]\n");
  }

  /// The transfer scene with one text replaced.
  std::string with(const std::string& from, const std::string& to) const {
    write("changed.toml", circle + changed(transfer, from, to));
    return "changed.toml";
  }
};

TEST_F(TransferCommand, LeavesTablesPageAndSummary) {
  const CommandResult result = succeed({"transfer", "transfer.toml"});
  EXPECT_NE(result.out.find("The least velocity change found"), std::string::npos);
  EXPECT_NE(result.out.find("report: out/transfer-transfer/report.html"), std::string::npos);
  const std::filesystem::path directory = directory_ / "out/transfer-transfer";
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names,
            (std::vector<std::string>{"conditions.csv", "figure.svg", "report.html",
                                      "singular_times.csv", "summary.json", "transfers.csv"}));
  const Json summary = read_json(directory / "summary.json");
  EXPECT_EQ(summary["exit_code"], 0);
  EXPECT_EQ(summary["counts"]["answered"], 3);
  const Table table = read_table(directory / "transfers.csv");
  EXPECT_EQ(table.rows.size(), 3U);
  EXPECT_NE(content(directory / "report.html")
                .find(io::escape_html(summary["verdict"].get<std::string>())),
            std::string::npos);
}

TEST_F(TransferCommand, TheLinearAnswerIsThatOfClohessyAndWiltshire) {
  // Closed form: with n the mean motion, t the time, s = sin nt, c = cos nt, the position after t
  // is
  //   x = (4 - 3 c) x0 + s/n u0 + 2 (1 - c)/n v0
  //   y = 6 (s - nt) x0 + y0 - 2 (1 - c)/n u0 + (4 s - 3 nt)/n v0 ,   z = c z0 + s/n w0 ,
  // with the velocity (u, v, w) seen from the rotating axes.
  succeed({"transfer", "transfer.toml", "-q", "--set", "jet.order=1", "--set",
           "transfer.tolerance_m=1000"});
  const Json summary = read_json(directory_ / "out/transfer-transfer/summary.json");
  const double time = summary["best"]["time_s"];
  const double n = std::sqrt(398600.4415 / 1e12);
  const double s = std::sin(n * time), c = std::cos(n * time);
  const double a = s / n, b = 2 * (1 - c) / n, d = (4 * s - 3 * n * time) / n;
  // [a b; -b d] (u0, v0) = (0, 1100)
  const double u0 = -b * 1100 / (a * d + b * b);
  const double v0 = a * 1100 / (a * d + b * b);
  const double w0 = -c * 200 * n / s;
  const auto change = summary["best"]["start_change_m_s"].get<std::vector<double>>();
  EXPECT_NEAR(change[0], u0, 1e-9);
  EXPECT_NEAR(change[1], v0, 1e-9);
  EXPECT_NEAR(change[2], w0, 1e-9);
}

TEST_F(TransferCommand, PrintsItsSummaryAsJson) {
  const CommandResult result = succeed({"transfer", "transfer.toml", "--json"});
  EXPECT_EQ(Json::parse(result.out), read_json(directory_ / "out/transfer-transfer/summary.json"));
  EXPECT_EQ(succeed({"transfer", "transfer.toml", "-q"}).out, "");
}

TEST_F(TransferCommand, OptimalImpulsesAreInTableSummaryAndPage) {
  const CommandResult result =
      succeed({"transfer", "transfer.toml", "--set", "transfer.impulses=optimal"});
  EXPECT_NE(result.out.find("  optimal          "), std::string::npos);
  const std::filesystem::path directory = directory_ / "out/transfer-transfer";
  const Json summary = read_json(directory / "summary.json");
  const Json plan = summary["optimal_impulses"]["plan"];
  const Table table = read_table(directory / "impulses.csv");
  ASSERT_EQ(table.rows.size(), plan["impulses"].size());
  double total = 0;
  for (const auto& row : table.rows) total += std::stod(row.back());
  EXPECT_NEAR(total, plan["total_change_m_s"].get<double>(), 1e-12);
  EXPECT_LE(total, summary["best"]["total_change_m_s"].get<double>());
  EXPECT_LE(plan["miss_m"].get<double>(), 1e-3);
  EXPECT_TRUE(summary["primer_vector"]["further_impulse_helps"].get<bool>());
  const std::string page = content(directory / "report.html");
  EXPECT_NE(page.find("Primer vector along the transfer"), std::string::npos);
  EXPECT_NE(page.find("to first order about this plan no impulses cost less"), std::string::npos);
  succeed({"transfer", "transfer.toml", "-q"});
  EXPECT_FALSE(std::filesystem::exists(directory / "impulses.csv"));
  EXPECT_TRUE(read_json(directory / "summary.json")["optimal_impulses"].is_null());
}

// A miss of a picometre cannot be reached.
TEST_F(TransferCommand, OptimalImpulsesThatMissFailTheCommand) {
  const CommandResult result =
      hamjet({"transfer", "transfer.toml", "--set", "transfer.impulses=optimal", "--set",
              "transfer.refined_miss_m=1e-12"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("optimal impulses: the plan of the linear theory was not brought to"),
            std::string::npos);
  EXPECT_NE(result.out.find("  optimal          not found"), std::string::npos);
  const Json summary = read_json(directory_ / "out/transfer-transfer/summary.json");
  EXPECT_EQ(summary["exit_code"], 1);
  EXPECT_TRUE(summary["optimal_impulses"]["failure"].is_string());
}

TEST_F(TransferCommand, StartAndEndInDifferentFrames) {
  expect_error({"transfer", with("[0, 100, 0]", "[0, 100, 0]\nframe = \"inertial\"")}, 3,
               {"changed.toml:28:9: transfer.end.frame: different frames, got inertial, where "
                "changed.toml:22:9: transfer.frame has",
                "RTN with rotating derivatives"});
}

TEST_F(TransferCommand, ZeroTransferTime) {
  expect_error(
      {"transfer", with("[0.2, 0.3, 0.7]", "[0, 0.3]")}, 3,
      {"changed.toml:23:17: transfer.times_orbits.0: zero transfer time", "must not be 0"});
  expect_error({"transfer", "transfer.toml", "--set", "transfer.times_orbits=0"}, 3,
               {"--set transfer.times_orbits: zero transfer time"});
}

TEST_F(TransferCommand, BareLocalVerticalFrame) {
  expect_error({"transfer", with("\"RTN\"", "\"LVLH\"")}, 3,
               {"transfer.frame: ambiguous, got \"LVLH\"", "x radial outward",
                "z toward the Earth's centre", "must be \"RTN\""});
}

TEST_F(TransferCommand, AtHalfARevolutionF1DoesNotExist) {
  // On Kepler's circle the normal position after half a revolution is -z0 whatever the velocity.
  const std::string scene = with("[0.2, 0.3, 0.7]", "0.5\nkind = \"F1\"");
  const CommandResult result = hamjet({"transfer", scene, "-o", "half"});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("no transfer time has an answer"), std::string::npos) << result.err;
  const Json summary = read_json(directory_ / "half/summary.json");
  EXPECT_EQ(summary["exit_code"], 4);
  EXPECT_TRUE(summary["best"].is_null());
  EXPECT_EQ(summary["counts"]["answered"], 0);
  ASSERT_EQ(summary["position_singular_times"].size(), 1U);
  EXPECT_NEAR(summary["position_singular_times"][0]["time_canonical"].get<double>(), 3.14159265,
              1e-7);
  const std::string table = content(directory_ / "half/transfers.csv");
  EXPECT_EQ(table.find("nan"), std::string::npos);
}

TEST_F(TransferCommand, BeyondValidityIsMarkedAndFailsOnlyAStrictScene) {
  // A thousand kilometres from the chief no cubic polynomial is right to a metre.
  const std::string far = changed(transfer, "[0, -1000, 200]", "[0, -1000000, 0]");
  write("far.toml", circle + far);
  const CommandResult marked = hamjet({"transfer", "far.toml"});
  EXPECT_EQ(marked.exit_code, 0);
  EXPECT_NE(in_one_line(marked.err).find("transfer.start: far from its chief, got 1000 km"),
            std::string::npos)
      << marked.err;
  EXPECT_NE(in_one_line(marked.out)
                .find("3 with an answer within 1 m, 3 of them only after "
                      "correction by flying"),
            std::string::npos)
      << marked.out;
  Json summary = read_json(directory_ / "out/far-transfer/summary.json");
  EXPECT_EQ(summary["counts"]["beyond_tolerance"], 3);
  // The cheapest answer is one that flying has brought to its place.
  EXPECT_EQ(summary["best"]["answer"], "refined");
  EXPECT_LE(summary["best"]["miss_m"].get<double>(), 1e-3);
  EXPECT_EQ(summary["counts"]["beyond_tolerance_and_refined_away_from_singularities"],
            summary["counts"]["refined"]);
  const CommandResult strict =
      hamjet({"transfer", "far.toml", "--set", "transfer.strict=true", "-o", "strict"});
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_NE(strict.err.find("strict: of 3 transfer times"), std::string::npos) << strict.err;
  EXPECT_EQ(read_json(directory_ / "strict/summary.json")["exit_code"], 1);
}

TEST_F(TransferCommand, ScenesWithoutTheTableAreShownTheSmallestOne) {
  expect_error(
      {"transfer", "circle.toml"}, 3,
      {"circle.toml: transfer: missing, must be a table [transfer]", "transfer = {times_s"});
  expect_error({"validity", "circle.toml"}, 3,
               {"validity: missing", "validity = {tolerance_m = 1"});
  expect_error({"assign", "circle.toml"}, 3, {"assignment: missing", "assignment = {deputy = ["});
  // The examples keep the promises of their comments.
  write("small.toml", changed(circle, "[system]",
                              "transfer = {times_s = [1200, 1800], start = "
                              "{position_m = [0, -1000, 0]}, end = {position_m = [0, -100, 0]}}\n"
                              "validity = {tolerance_m = 1, count = 12}\n"
                              "assignment = {deputy = [{position_m = [0, -100, 0]}], slot = "
                              "[{position_m = [0, 100, 0]}]}\n[system]"));
  succeed({"check", "small.toml"});
  expect_error({"transfer", "assignment.toml"}, 3, {"transfer.start: missing", "hamjet assign"});
}

TEST_F(TransferCommand, NeedsAnOrbitAndASymplecticIntegrator) {
  expect_error({"transfer", "transfer.toml", "--set", "integrator.gauss8.method=fehlberg78",
                "--set", "integrator.gauss8.stages=null"},
               3, {"transfer.toml: integrator: only a symplectic map"});
  expect_error({"transfer", "transfer.toml", "--set", "jet.variables=[\"x\", \"px\"]"}, 3,
               {"jet.variables", "must be all of"});
  expect_error({"transfer", "transfer.toml", "--set", "precision=extended"}, 3,
               {"extended precision"});
}

TEST_F(TransferCommand, ResultsOfOtherStudiesInTheSameDirectoryGo) {
  succeed({"transfer", "transfer.toml", "-o", "same", "-q"});
  succeed({"assign", "assignment.toml", "-o", "same", "-q"});
  EXPECT_FALSE(std::filesystem::exists(directory_ / "same/transfers.csv"));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "same/report.html"));
  EXPECT_TRUE(std::filesystem::exists(directory_ / "same/costs.csv"));
  succeed({"run", "quick.toml", "-o", "same", "-q"});
  EXPECT_FALSE(std::filesystem::exists(directory_ / "same/costs.csv"));
  succeed({"transfer", "transfer.toml", "-o", "same", "-q"});
  EXPECT_FALSE(std::filesystem::exists(directory_ / "same/gauss8/jet.csv"));
}

TEST_F(TransferCommand, StopsAtASignalAndLeavesNothing) {
  const auto before = files();
  options_.signal = Signal{SIGINT};
  options_.limit = std::chrono::seconds(20);
  const CommandResult result =
      hamjet({"transfer", "transfer.toml", "--set", "jet.order=8", "--set",
              "transfer.times_orbits=null", "--set", "transfer.count=10000"});
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_EQ(result.err, "hamjet: interrupted; nothing was written\n");
  EXPECT_EQ(files(), before);
}

TEST_F(TransferCommand, ValidityIsProvedForEachOrder) {
  succeed({"validity", "validity.toml", "-q"});
  const Json summary = read_json(directory_ / "out/validity-validity/summary.json");
  EXPECT_EQ(summary["study"], "validity");
  const Json& times = summary["validity"]["times"];
  ASSERT_EQ(times.size(), 2U);
  for (const Json& time : times) {
    ASSERT_EQ(time["orders"].size(), 3U);
    EXPECT_LT(time["orders"][0]["proved_m"], time["orders"][2]["proved_m"]);
    for (const Json& order : time["orders"]) EXPECT_LE(order["miss_m"], 1.0);
  }
  EXPECT_EQ(read_table(directory_ / "out/validity-validity/validity.csv").rows.size(), 6U);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "out/validity-validity/report.html"));
}

TEST_F(TransferCommand, TakesAStoredJet) {
  // The jet's duration, 0.7 revolutions here, is the one transfer time.
  succeed({"run", "transfer.toml", "-q", "-o", "jets", "--set", "jet.duration_orbits=0.7"});
  succeed({"transfer", "transfer.toml", "-q", "-o", "stored", "--jet", "jets"});
  succeed({"transfer", "transfer.toml", "-q", "-o", "computed", "--set",
           "transfer.times_orbits=[0.7]"});
  const Json stored = read_json(directory_ / "stored/summary.json")["best"];
  const Json computed = read_json(directory_ / "computed/summary.json")["best"];
  EXPECT_NEAR(stored["time_s"].get<double>(), computed["time_s"].get<double>(), 1e-9);
  EXPECT_NEAR(stored["total_change_m_s"].get<double>(), computed["total_change_m_s"].get<double>(),
              1e-6);
  expect_error({"transfer", "transfer.toml", "--jet", "nowhere"}, 5, {"nowhere/summary.json"});
  expect_error({"transfer", "transfer.toml", "--jet", "jets", "-o", "jets"}, 2,
               {"--jet and -o: are the same directory"});
  EXPECT_TRUE(std::filesystem::exists(directory_ / "jets/gauss8/jet.csv"));
  expect_error({"transfer", "transfer.toml", "--run", "gauss8"}, 2, {"--run requires --jet"});
  expect_error({"transfer", "transfer.toml", "--jet", "jets", "--set", "nominal.i_deg=31"}, 3,
               {"jets: the jet of gauss8 is about another orbit"});
}

TEST_F(TransferCommand, AStoredJetNeedsNoTimeOfTheScene) {
  write("timeless.toml", circle + changed(transfer, "times_orbits = [0.2, 0.3, 0.7]\n", ""));
  succeed({"run", "circle.toml", "-q", "-o", "jets", "--set", "jet.duration_orbits=0.7"});
  succeed({"transfer", "timeless.toml", "-q", "-o", "timeless", "--jet", "jets"});
  succeed({"transfer", "transfer.toml", "-q", "-o", "timed", "--jet", "jets"});
  EXPECT_EQ(read_json(directory_ / "timeless/summary.json")["best"],
            read_json(directory_ / "timed/summary.json")["best"]);
  // Without the jet the time is missing, and with it what else is wrong is named.
  expect_error({"transfer", "timeless.toml"}, 3, {"timeless.toml", "times_s", "count"});
  expect_error({"transfer", "timeless.toml", "--jet", "jets", "--set", "transfer.frame=x"}, 3,
               {"transfer.frame", "RTN"});
  expect_error({"transfer", "circle.toml", "--jet", "jets"}, 3, {"transfer: missing"});
}

using TransferCommandAtLength = TransferCommand;

// TheLeastBetweenTheListedTimesIsThatOfAFinerList of the study is the short form.
TEST_F(TransferCommandAtLength, OnShippedScenesTheLeastIsThatOfAListFourTimesAsFine) {
  for (const std::string scene : {"scenes/transfer-earth-orbit", "scenes/transfer-sun-synchronous",
                                  "examples/two-satellites/two-satellites"}) {
    const std::string file = std::string(HAMJET_SOURCE_DIR) + "/data/" + scene + ".toml";
    const auto summary_of = [&](int count, const std::string& out) {
      succeed(
          with_overrides({"transfer", file, "-q", "-o", out},
                         {"transfer.impulses=\"two\"", "transfer.count=" + std::to_string(count)}));
      return read_json(directory_ / out / "summary.json");
    };
    const int count = scene.find("two-satellites") == std::string::npos ? 200 : 96;
    const Json coarse = summary_of(count, "coarse");
    const Json fine = summary_of(4 * count, "fine");
    const double least = coarse["least_between_listed_times"]["total_change_m_s"];
    EXPECT_LE(least, fine["best"]["total_change_m_s"].get<double>()) << scene;
    EXPECT_LT(least, coarse["best"]["total_change_m_s"].get<double>()) << scene;
  }
}

TEST_F(TransferCommand, DeputiesGoToTheSlotsThatCostLeast) {
  succeed({"assign", "assignment.toml", "-q"});
  const Json summary = read_json(directory_ / "out/assignment-assign/summary.json");
  ASSERT_EQ(summary["transfers"].size(), 2U);
  // Each deputy has a slot 100 m away, and one 1900 m away.
  EXPECT_EQ(summary["transfers"][0]["slot"], 1);
  EXPECT_EQ(summary["transfers"][1]["slot"], 0);
  const Table costs = read_table(directory_ / "out/assignment-assign/costs.csv");
  ASSERT_EQ(costs.rows.size(), 4U);
  const double total = costs.number(1, "total_change_m_s") + costs.number(2, "total_change_m_s");
  EXPECT_NEAR(summary["total_change_m_s"].get<double>(), total, 1e-6 * total);
  EXPECT_EQ(summary["kind"], "auto");
  // In a chart no generating function is used.
  succeed({"assign", "assignment.toml", "-q", "-o", "chart", "--set", "jet.coordinates=spherical"});
  EXPECT_TRUE(read_json(directory_ / "chart" / "summary.json")["kind"].is_null());
}

TEST_F(TransferCommand, DeputiesAndSlotsOfDifferentNumber) {
  write("uneven.toml",
        circle + changed(assignment, "[[assignment.slot]]\nposition_m = [0, -900, 0]\n", ""));
  const CommandResult said = succeed({"assign", "uneven.toml"});
  const Json summary = read_json(directory_ / "out/uneven-assign/summary.json");
  ASSERT_EQ(summary["transfers"].size(), 1U);
  const std::size_t sent = summary["transfers"][0]["deputy"];
  EXPECT_EQ(summary["deputies_without_slot"], Json({1 - sent}));
  EXPECT_EQ(summary["slots_without_deputy"], Json::array());
  EXPECT_NE(said.out.find(fmt::format("deputies without a slot: {}\n", 1 - sent)),
            std::string::npos)
      << said.out;
  // The deputy that is sent is the cheaper one.
  const Table costs = read_table(directory_ / "out/uneven-assign/costs.csv");
  ASSERT_EQ(costs.rows.size(), 2U);
  EXPECT_LE(costs.number(sent, "total_change_m_s"), costs.number(1 - sent, "total_change_m_s"));
}

}  // namespace
}  // namespace hamjet::test
