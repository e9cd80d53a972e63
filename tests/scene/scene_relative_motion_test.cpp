#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "scene_samples.hpp"

// Tables [transfer], [validity] and [assignment]: every key as it is read, every rule broken once.

namespace hamjet::io {
namespace {

constexpr const char* transfer = R"([transfer]
frame = "RTN"
times_s = [16, 32]
[transfer.start]
position_m = [1, 2, 3]
velocity_m_s = [0.5, 0, -1]
[transfer.end]
position_m = [0, 0, 4]
)";

constexpr const char* assignment = R"([transfer]
frame = "inertial"
count = 4
[assignment]
[[assignment.deputy]]
position_m = [1, 0, 0]
[[assignment.deputy]]
position_m = [2, 0, 0]
velocity_m_s = [0, 3, 0]
[[assignment.slot]]
position_m = [3, 0, 0]
[[assignment.slot]]
position_m = [4, 0, 0]
)";

Scene scene_of(const std::string& tables) {
  return parse_scene(std::string(circle_scene) + tables, "file.toml");
}

struct TableChange {
  const char* from;
  const char* to;
  std::vector<std::string> words;
};

void expect_table_errors(const std::string& tables, const std::vector<TableChange>& changes) {
  ASSERT_NO_THROW(scene_of(tables));
  for (const TableChange& change : changes) {
    expect_scene_error(std::string(circle_scene) + changed(tables, change.from, change.to),
                       change.words);
  }
}

TEST(SceneTransfer, Defaults) {
  const Scene scene = scene_of(transfer);
  ASSERT_TRUE(scene.transfer);
  EXPECT_FALSE(scene.validity);
  EXPECT_FALSE(scene.assignment);
  const TransferSettings& settings = *scene.transfer;
  EXPECT_EQ(settings.frame, RelativeFrame::rtn_rotating);
  EXPECT_EQ(settings.start.position_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(settings.start.velocity_m_s, Eigen::Vector3d(0.5, 0, -1));
  EXPECT_EQ(settings.end.position_m, Eigen::Vector3d(0, 0, 4));
  EXPECT_EQ(settings.end.velocity_m_s, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(settings.times, (std::vector<double>{2, 4}));  // 8 s a unit
  EXPECT_EQ(settings.kind, "auto");
  EXPECT_EQ(settings.tolerance_m, 1);
  EXPECT_FALSE(settings.refine);
  EXPECT_EQ(settings.refined_miss_m, 1e-3);
  EXPECT_NEAR(settings.singular_margin, 0.01 * 2 * std::numbers::pi, 1e-15);
  EXPECT_FALSE(settings.strict);
}

TEST(SceneTransfer, EveryKey) {
  const TransferSettings settings =
      *scene_of(changed(transfer, "times_s = [16, 32]",
                        "times_orbits = -0.5\nkind = \"ppq-qqp\"\ntolerance_m = 0.25\n"
                        "refine = true\nrefined_miss_m = 1e-5\nsingular_margin_s = 4\n"
                        "strict = true\nderivatives = \"inertial\""))
           .transfer;
  EXPECT_EQ(settings.frame, RelativeFrame::rtn_inertial);
  ASSERT_EQ(settings.times.size(), 1U);
  EXPECT_NEAR(settings.times[0], -std::numbers::pi, 1e-15);
  EXPECT_EQ(settings.kind, "ppq-qqp");
  EXPECT_EQ(settings.tolerance_m, 0.25);
  EXPECT_TRUE(settings.refine);
  EXPECT_EQ(settings.refined_miss_m, 1e-5);
  EXPECT_EQ(settings.singular_margin, 0.5);
  EXPECT_TRUE(settings.strict);
}

TEST(SceneTransfer, Times) {
  const auto times = [](const char* key) {
    return scene_of(changed(transfer, "times_s = [16, 32]", key)).transfer->times;
  };
  EXPECT_EQ(times("count = 4"), (std::vector<double>{2, 4, 6, 8}));
  EXPECT_EQ(times("times_s = 24"), (std::vector<double>{3}));
  EXPECT_EQ(times("times_canonical = [-0.5, -1e3]"), (std::vector<double>{-0.5, -1e3}));
}

TEST(SceneTransfer, FramesOfTheEnds) {
  const std::string none = changed(transfer, "frame = \"RTN\"\n", "");
  const auto with = [&](const char* start, const char* end) {
    return changed(
        changed(none, "position_m = [1, 2, 3]", "position_m = [1, 2, 3]\n" + std::string(start)),
        "[0, 0, 4]", "[0, 0, 4]\n" + std::string(end));
  };
  const char* rtn = "frame = \"RTN\"";
  const char* rtn_inertial = "frame = \"RTN\"\nderivatives = \"inertial\"";
  const char* inertial = "frame = \"inertial\"";
  EXPECT_EQ(scene_of(with(rtn, rtn)).transfer->frame, RelativeFrame::rtn_rotating);
  EXPECT_EQ(scene_of(with(rtn_inertial, rtn_inertial)).transfer->frame,
            RelativeFrame::rtn_inertial);
  EXPECT_EQ(scene_of(with(inertial, inertial)).transfer->frame, RelativeFrame::inertial);
  const auto expect_different = [&](const std::string& tables,
                                    const std::vector<std::string>& words) {
    std::vector<std::string> all = words;
    all.emplace_back("different frames");
    expect_scene_error(circle_scene + tables, all);
  };
  expect_different(with(rtn, inertial), {"file.toml:24:9: transfer.end.frame: ", "got inertial",
                                         "file.toml:20:9: transfer.start.frame has RTN with "
                                         "rotating derivatives"});
  expect_different(with(rtn, rtn_inertial), {"transfer.end.frame", "got RTN with inertial"});
  expect_different(
      changed(transfer, "[0, 0, 4]", "[0, 0, 4]\nderivatives = \"inertial\""),
      {"transfer.end.derivatives: different frames, got RTN with inertial derivatives"});
  expect_different("[transfer]\nframe = \"inertial\"\n" + with(rtn, rtn).substr(11),
                   {"transfer.start.frame", "transfer.frame has inertial"});
  expect_different(with("", inertial), {"transfer.end.frame: ", "got inertial",
                                        "file.toml:18:1: transfer.start has RTN with rotating"});
  expect_scene_error(
      circle_scene + with(inertial, "frame = \"inertial\"\nderivatives = \"rotating\""),
      {"transfer.end.derivatives: the frame inertial has one kind"});
}

// As [deputy] and [validity] have it.
TEST(SceneTransfer, TheFrameIsThatOfTheDeputyElseRtn) {
  const std::string none = changed(transfer, "frame = \"RTN\"\n", "");
  EXPECT_EQ(scene_of(none).transfer->frame, RelativeFrame::rtn_rotating);
  EXPECT_EQ(scene_of(changed(none, "[transfer]", "[transfer]\nderivatives = \"inertial\""))
                .transfer->frame,
            RelativeFrame::rtn_inertial);
  const std::string deputy = "[deputy]\nposition_m = [1, 0, 0]\nframe = \"inertial\"\n";
  EXPECT_EQ(scene_of(deputy + none).transfer->frame, RelativeFrame::inertial);
  // The same holds for deputies and slots of an assignment, which need neither start nor end.
  const std::string unnamed = changed(assignment, "frame = \"inertial\"\n", "");
  EXPECT_EQ(scene_of(unnamed).transfer->frame, RelativeFrame::rtn_rotating);
  EXPECT_EQ(scene_of(deputy + unnamed).transfer->frame, RelativeFrame::inertial);
}

TEST(SceneTransfer, AFormIsNoFrameAndItsKeysAreSaid) {
  const std::string deputy = "[deputy]\nposition_m = [1, 0, 0]\nframe = ";
  expect_scene_error(circle_scene + deputy + "\"relative-elements\"\n",
                     {"file.toml:18:9: deputy.frame: the name of a form, not of a frame, got "
                      "\"relative-elements\"",
                      "must be \"RTN\", \"inertial\" or left out",
                      "the keys a_da_m, a_dlambda_m, a_dex_m, a_dey_m, a_dix_m, a_diy_m"});
  expect_scene_error(circle_scene + deputy + "\"Relative_Elements\"\n", {"a form, not of a frame"});
  expect_scene_error(circle_scene + deputy + "\"curvilinear\"\n",
                     {"a form, not of a frame", "arc_m"});
  expect_scene_error(
      circle_scene + changed(transfer, "\"RTN\"", "\"element-differences\""),
      {"transfer.frame: the name of a form, not of a frame", "is given by the keys da_m"});
}

TEST(SceneTransfer, LocalVerticalIsRefusedWithItsTwoMeanings) {
  for (const char* name : {"LVLH", "lvlh", "Lvlh"}) {
    const std::string frame = "frame = \"" + std::string(name) + "\"";
    expect_scene_error(
        circle_scene + changed(transfer, "frame = \"RTN\"", frame),
        {":17:9: transfer.frame: ambiguous, got \"" + std::string(name) + "\"", "x radial outward",
         "z toward the Earth's centre", "y opposite to the orbit normal", "must be \"RTN\""});
  }
}

TEST(SceneTransfer, Errors) {
  const char* times = "times_s = [16, 32]";
  expect_table_errors(
      transfer,
      {{"frame = ", "fram = ", {"transfer.fram: unknown key", "did you mean frame?"}},
       {"\"RTN\"", "\"RIC\"", {"transfer.frame: unknown value, got \"RIC\"", "RTN, inertial"}},
       {"\"RTN\"",
        "\"RTN\"\nderivatives = \"rotated\"",
        {"transfer.derivatives: unknown value", "did you mean rotating?"}},
       {times, "", {":16:1: transfer: missing", "times_s, times_orbits, times_canonical, count"}},
       {times, "times_s = 1\ncount = 2", {"more than one", "times_s, count"}},
       {times,
        "times_s = [0, 1]",
        {":18:12: transfer.times_s.0: zero transfer time", "must not be 0"}},
       {times, "times_s = 0.0", {":18:11: transfer.times_s: zero transfer time"}},
       {times, "times_s = []", {"times_s: empty"}},
       {times, "times_s = nan", {"times_s: not finite"}},
       {times, "times_s = \"1\"", {"times_s: wrong type, got the string"}},
       {times, "times_s = [1, true]", {"times_s.1: wrong type, got true"}},
       {times, "times_s = 5e-324", {"times_s: out of range"}},
       {times, "times_orbits = [1e308]", {"times_orbits.0: out of range"}},
       {times, "times_s = [2, 1]", {"times_s.1: out of order, got 1 after 2"}},
       {times, "times_s = [2, 2]", {"times_s.1: out of order"}},
       {times, "times_s = [2, -3]", {"times_s.1: out of order", "keep the sign"}},
       {times, "count = 0", {"count: out of range, got 0, must be an integer from 1 to 10000"}},
       {times, "count = 10001", {"count: out of range"}},
       {times, "count = 2.0", {"count: wrong type"}},
       {times, "times_s = 1\nkind = \"F5\"", {"transfer.kind: unknown kind, got \"F5\"", "auto"}},
       {times, "times_s = 1\nkind = \"qq-pp\"", {"unknown kind", "qqq-ppp"}},
       {times, "times_s = 1\ntolerance_m = 0", {"tolerance_m: not positive"}},
       {times, "times_s = 1\nrefine = 1", {"refine: wrong type, got 1, must be true or false"}},
       {times, "times_s = 1\nstrict = \"yes\"", {"strict: wrong type, got the string \"yes\""}},
       {times, "times_s = 1\nrefined_miss_m = -1", {"refined_miss_m: not positive"}},
       {times, "times_s = 1\nsingular_margin_s = -1", {"singular_margin_s: negative, got -1"}},
       {times, "times_s = 1\nsingular_margin_orbits = 1e308", {"out of range"}},
       {times,
        "times_s = 1\nsingular_margin_s = 1\nsingular_margin_orbits = 1",
        {"more than one key", "singular_margin_s, singular_margin_orbits"}},
       {"[1, 2, 3]", "[1, 2]", {":20:14: transfer.start.position_m: wrong length, got 2"}},
       {"position_m = [1, 2, 3]", "", {"transfer.start.position_m: missing"}},
       {"[1, 2, 3]", "[1, 2, inf]", {"position_m.2: not finite"}},
       {"[1, 2, 3]", "[3e3, 3e3, 0]", {"position_m: too large", "4243", "below 4000"}},
       {"[1, 2, 3]", "[1e300, 1e300, 0]", {"position_m: too large"}},
       {"[0.5, 0, -1]", "[0, 500, 0]", {"velocity_m_s: too large", "below 500"}},
       {"velocity_m_s",
        "velocity_km_s",
        {"start.position_m: two forms of a deputy, got velocity_km_s and position_m"}},
       {"[transfer.end]\nposition_m = [0, 0, 4]\n", "", {"transfer.end: missing, must be a table"}},
       {"[transfer.start]\nposition_m = [1, 2, 3]\nvelocity_m_s = [0.5, 0, -1]\n",
        "",
        {"transfer.start: missing"}}});
  std::string many = "times_s = [";
  for (int i = 1; i <= 10001; ++i) many += std::to_string(i) + ",";
  expect_scene_error(circle_scene + changed(transfer, times, many + "]"),
                     {"too many, got 10001 times"});
  const std::string still = changed(circle_scene, "duration_s = 64", "duration_s = 0");
  expect_scene_error(still + changed(transfer, times, "count = 3"), {"count: no time to divide"});
}

TEST(SceneTransfer, Waypoints) {
  const std::string tables = std::string(transfer) +
                             "[[transfer.waypoint]]\ntime_s = 8\nposition_m = [1, 0, 0]\n"
                             "[[transfer.waypoint]]\ntime_canonical = 2\nposition_m = [0, 7, 0]\n";
  const TransferSettings settings = *scene_of(tables).transfer;
  ASSERT_EQ(settings.waypoints.size(), 2U);
  EXPECT_EQ(settings.waypoints[0].time, 1);
  EXPECT_EQ(settings.waypoints[1].time, 2);
  EXPECT_EQ(settings.waypoints[1].position_m, Eigen::Vector3d(0, 7, 0));
  expect_table_errors(
      tables,
      {{"time_s = 8", "time_s = 0", {"waypoint.0.time_s: out of order, got 0", "after the start"}},
       {"time_s = 8", "time_s = 16", {"waypoint.1.time_canonical: out of order, got 2"}},
       {"time_s = 8", "time_s = -8", {"waypoint.0.time_s: out of order"}},
       {"time_canonical = 2", "time_canonical = 4", {"before the last transfer time, of 32 s"}},
       {"time_canonical = 2", "", {"transfer.waypoint.1: missing", "time_orbits"}},
       {"position_m = [0, 7, 0]", "", {"waypoint.1.position_m: missing"}},
       {"position_m = [0, 7, 0]",
        "position_m = [0, 7, 0]\nvelocity_m_s = [0, 0, 0]",
        {"waypoint.1.velocity_m_s", "a place in the frame of the table [transfer]"}}});
  const std::string limit = changed(transfer, "times_s", "impulse_gap_s = 4\ntimes_s");
  EXPECT_EQ(scene_of(limit).transfer->impulse_gap, 0.5);
}

TEST(SceneTransfer, HowFarADeputyMayBeDoesNotDependOnTheUnitOfLength) {
  for (const char* length_km : {"1e-6", "0.003", "2", "1e8"}) {
    const std::string orbit =
        std::string(circle_scene) + "[units]\nlength_km = " + length_km + "\n";
    const std::string far = changed(transfer, "[1, 2, 3]", "[3998, 0, 0]");
    EXPECT_NO_THROW(parse_scene(orbit + far, "file.toml")) << length_km;
    expect_scene_error(orbit + changed(transfer, "[1, 2, 3]", "[4002, 0, 0]"),
                       {"position_m: too large", "below 4000"});
    expect_scene_error(orbit + changed(transfer, "[0.5, 0, -1]", "[0, 502, 0]"),
                       {"velocity_m_s: too large", "below 500"});
  }
}

TEST(SceneTransfer, NeedsAPeriodForOrbitsOnly) {
  const std::string open = changed(circle_scene, "[0, 0.5, 0]", "[0, 0.8, 0]");
  EXPECT_NEAR(parse_scene(open + transfer, "x").transfer->singular_margin,
              0.01 * 2 * std::numbers::pi, 1e-15);
  const char* times = "times_s = [16, 32]";
  expect_scene_error(open + changed(transfer, times, "times_orbits = 1"),
                     {"transfer.times_orbits: no period", "times_s or times_canonical"});
  expect_scene_error(open + changed(transfer, times, "times_s = 1\nsingular_margin_orbits = 0.1"),
                     {"singular_margin_orbits: no period"});
}

TEST(SceneTransfer, ScenesThatHaveNoRelativeMotion) {
  expect_scene_error(oscillator + transfer,
                     {"transfer: not available for this system, got one degree of freedom"});
  expect_scene_error(
      changed(circle_scene, "order = 3", "order = 3\nvariables = [\"x\", \"px\"]") + transfer,
      {"transfer: not defined for these jet.variables, got x, px, must be all of"});
  expect_scene_error(
      changed(circle_scene, "title", "precision = \"extended\"\ntitle") + "[validity]\ncount = 2\n",
      {"validity: not available in extended precision", "double precision"});
}

TEST(SceneValidity, EveryKey) {
  const ValiditySettings defaults = *scene_of("[validity]\n").validity;
  EXPECT_EQ(defaults.tolerance_m, 1);
  ASSERT_EQ(defaults.times.size(), 12U);
  EXPECT_EQ(defaults.times.back(), 8);
  EXPECT_EQ(defaults.times[2], 2);
  EXPECT_EQ(defaults.semi_axes, (std::vector<double>{1, 1, 1}));
  EXPECT_EQ(defaults.samples, 40);
  EXPECT_EQ(defaults.frame, RelativeFrame::rtn_rotating);  // as of [transfer] and hamjet eval
  EXPECT_EQ(scene_of("[validity]\nderivatives = \"inertial\"\n").validity->frame,
            RelativeFrame::rtn_inertial);
  EXPECT_EQ(scene_of("[validity]\nframe = \"inertial\"\n").validity->frame,
            RelativeFrame::inertial);
  const ValiditySettings given = *scene_of(
                                      "[validity]\ntolerance_m = 2\ntimes_s = 8\n"
                                      "semi_axes = [1, 4, 2]\nsamples = 10\n")
                                      .validity;
  EXPECT_EQ(given.tolerance_m, 2);
  EXPECT_EQ(given.times, (std::vector<double>{1}));
  EXPECT_EQ(given.semi_axes, (std::vector<double>{0.25, 1, 0.5}));
  EXPECT_EQ(given.samples, 10);
}

TEST(SceneValidity, Errors) {
  expect_table_errors(
      "[validity]\ntolerance_m = 1\nsemi_axes = [1, 1, 1]\nsamples = 40\n",
      {{"tolerance_m = 1", "tolerance_m = 0", {"validity.tolerance_m: not positive"}},
       {"tolerance_m = 1", "tol = 1", {"validity.tol: unknown key"}},
       {"tolerance_m = 1",
        "times_s = 0",
        {"validity.times_s: the start itself, got 0, must not be 0"}},
       {"tolerance_m = 1", "times_s = 1\ncount = 1", {"more than one key"}},
       {"[1, 1, 1]", "[1, 0, 1]", {"validity.semi_axes.1: not positive, got 0"}},
       {"[1, 1, 1]", "[1, 1]", {"semi_axes: wrong length"}},
       {"samples = 40", "frame = \"LVLH\"", {"validity.frame: ambiguous"}},
       {"samples = 40", "derivatives = \"none\"", {"validity.derivatives", "rotating"}},
       {"samples = 40", "samples = 9", {"samples: out of range", "from 10 to 10000"}}});
}

TEST(SceneAssignment, EveryKey) {
  const Scene scene = scene_of(assignment);
  ASSERT_TRUE(scene.assignment);
  const AssignmentSettings& settings = *scene.assignment;
  EXPECT_EQ(settings.time, AssignmentTime::per_pair);
  ASSERT_EQ(settings.deputies.size(), 2U);
  ASSERT_EQ(settings.slots.size(), 2U);
  EXPECT_EQ(settings.deputies[1].position_m, Eigen::Vector3d(2, 0, 0));
  EXPECT_EQ(settings.deputies[1].velocity_m_s, Eigen::Vector3d(0, 3, 0));
  EXPECT_EQ(settings.slots[0].position_m, Eigen::Vector3d(3, 0, 0));
  EXPECT_EQ(settings.slots[0].velocity_m_s, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(scene.transfer->frame, RelativeFrame::inertial);
  EXPECT_EQ(scene.transfer->times.size(), 4U);
  const std::string common = changed(assignment, "[assignment]", "[assignment]\ntime = \"common\"");
  EXPECT_EQ(scene_of(common).assignment->time, AssignmentTime::common);
}

TEST(SceneAssignment, Errors) {
  const char* last = "[[assignment.slot]]\nposition_m = [4, 0, 0]\n";
  EXPECT_EQ(scene_of(changed(assignment, last, "")).assignment->slots.size(), 1U);
  expect_table_errors(
      assignment,
      {{"[assignment]", "[assignment]\ntime = \"pair\"", {"time: unknown value", "per-pair"}},
       {"[assignment]", "[assignment]\ntimes = 1", {"assignment.times: unknown key"}},
       {"[4, 0, 0]", "[4, 0]", {"assignment.slot.1.position_m: wrong length"}},
       {"[4, 0, 0]",
        "[4, 0, 0]\nframe = \"RTN\"",
        {"assignment.slot.1.frame: a slot, which is in the frame of the table [transfer], has no"}},
       {"[transfer]\nframe = \"inertial\"\ncount = 4\n",
        "",
        {"assignment: no table [transfer]", "frame and transfer times"}},
       {"[assignment]",
        "[transfer.start]\nposition_m = [1, 1, 1]\n[assignment]",
        {"transfer.end: missing"}}});
  std::string slots =
      "[transfer]\nframe = \"RTN\"\ncount = 1\n[[assignment.deputy]]\n"
      "position_m = [0, 0, 0]\n";
  for (int i = 0; i < 201; ++i) slots += "[[assignment.slot]]\nposition_m = [0, 0, 0]\n";
  expect_scene_error(circle_scene + slots, {"assignment.slot: too many, got 201", "at most 200"});
  expect_scene_error(
      circle_scene + std::string("[transfer]\nframe = \"RTN\"\ncount = 1\n[assignment]\n"
                                 "[[assignment.slot]]\nposition_m = [0, 0, 0]\n"),
      {"assignment.deputy: missing"});
}

}  // namespace
}  // namespace hamjet::io
