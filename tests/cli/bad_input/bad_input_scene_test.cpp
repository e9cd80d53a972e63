#include <fmt/format.h>

#include "refused_scene.hpp"

// Scenes with one mistake each, for the rows of the table at the head of bad_input_test.cpp that
// the tests there leave open. Lines are those of small_scene, counted by hand.

namespace hamjet::test {
namespace {

using std::string;

struct SceneMistake {
  int row;  ///< row of the table
  string from;
  string to;
  std::vector<string> words;
  int exit_code = 3;
};

class BadScene : public RefusedScene {
 protected:
  void expect_each_refused(const std::vector<SceneMistake>& mistakes, const string& scene) const {
    for (const SceneMistake& mistake : mistakes) {
      SCOPED_TRACE(mistake.row);
      expect_refused(scene, mistake.from, mistake.to, mistake.words, mistake.exit_code);
    }
  }
};

TEST_F(BadScene, Text) {
  const string nul = changed(small_scene, "title = \"small\"", string("title = \"sm\0all\"", 16));
  const string utf16 = string("\xff\xfe") + "s\0c\0h\0";
  for (const auto& [text, words] : std::vector<std::pair<string, std::vector<string>>>{
           {nul, {"bad.toml: ", "a NUL byte at byte offset 22"}},
           {utf16, {"bad.toml: ", "a UTF-16 byte order mark at byte offset 0"}},
           {"\xfe\xff", {"bad.toml: ", "a UTF-16 byte order mark at byte offset 0"}},
           {"title = \"\xc0\xaf\"", {"bad.toml: not UTF-8, got the byte 0xc0 at byte offset 9"}}}) {
    write("bad.toml", text);
    expect_error({"run", "bad.toml"}, 3, words);
  }
}

TEST_F(BadScene, Toml) {
  const string end = "[reference]\n";
  expect_each_refused(
      {{12, "\"F2\"]", "\"F2\"", {":30:", "not valid TOML"}},
       {12, "\"small\"", "\"small", {":2:", "not valid TOML"}},
       {13, "order = 2", "order = 2\norder = 3", {":15:9: ", "already at bad.toml:14:9"}},
       {14, end, "[jet]\norder = 2\n", {":30:1: ", "already at bad.toml:13:1"}},
       {16, end, "[methd]\n", {":30:2: methd: unknown key", "must be one of: schema"}},
       {16, end, "[[integratr]]\n", {"integratr: unknown key", "did you mean integrator?"}}},
      small_scene);
}

TEST_F(BadScene, DeepNesting) {
  const string scene = small_scene;
  for (const string& text : {scene + "x = " + string(100'000, '['), string(100'000, '['),
                             scene + "x = " +
                                 [] {
                                   string tables;
                                   for (int i = 0; i < 100'000; ++i) tables += "{a=";
                                   return tables;
                                 }(),
                             [] {
                               string key = "a";
                               for (int i = 0; i < 100'000; ++i) key += ".a";
                               return key + " = 1";
                             }()}) {
    write("bad.toml", text);
    expect_error({"run", "bad.toml"}, 3, {"bad.toml:", "nested too deeply", "at most 32"});
  }
}

TEST_F(BadScene, Numbers) {
  const string elements =
      "a_km = 10000\ne = 0.1\ni_deg = 30\nraan_deg = 10\nargp_deg = 20\nta_deg = 30\n";
  const string velocity = "velocity_km_s = [0, 1, 0]\n";
  expect_each_refused(
      {{18, "order = 2", "order = 4.5", {":14:9: jet.order: wrong type, got 4.5", "an integer"}},
       {18, "order = 2", "order = 4.0", {":14:9: jet.order: wrong type, got 4.0", "an integer"}},
       {22, "order = 2", "order = 9223372036854775808", {":14:9: order: integer out of range"}},
       {24,
        elements,
        "position_km = [1, 0, 0, 0]\n" + velocity,
        {":7:15: nominal.position_km: wrong length, got 4 elements, must be an array of 3"}},
       {25,
        elements,
        "position_km = [1, \"0\", 0]\n" + velocity,
        {":7:19: nominal.position_km.1: wrong type, got the string \"0\""}},
       {26,
        elements,
        "position_km = [0, -0.0, 0]\n" + velocity,
        {":7:15: nominal.position_km: at the centre"}},
       {27, "398600.4415", "-1", {":5:13: system.mu_km3_s2: not positive, got -1"}},
       {33, "stages = 8", "stages = 0", {":19:10: integrator.0.stages: out of range", "1 to 12"}},
       {33, "stages = 8", "stages = 1000", {":19:10: integrator.0.stages: out of range, got 1000"}},
       {34, "= 0.01", "= nan", {":25:18: integrator.1.step_canonical: not finite, got nan"}},
       {36, "= 0.01", "= 1e-17", {":25:18", "too small to advance the time", "2.22e-16"}},
       {37, "= 0.01", "= 1e-15", {":25:18", "too many steps, got 1e-15, which takes 1e+15"}, 6},
       {38, "1e-13", "nan", {":20:13: integrator.0.tolerance: not finite"}}},
      small_scene);
}

TEST_F(BadScene, ZonalHarmonics) {
  const string scene = changed(small_scene, "model = \"kepler\"",
                               "model = \"zonal-gravity\"\nradius_km = 6378\nJ2 = 1e-3");
  expect_each_refused(
      {{28, "6378", "-6378", {":5:13: system.radius_km: not positive, got -6378"}},
       {29, "1e-3\n", "1e400\n", {":6:6: J2: number out of range, got 1e400", "1.8e+308"}},
       {30, "1e-3\n", "1e-400\n", {":6:6: J2: number out of range, got 1e-400", "must be 0 or"}},
       {31, "1e-3\n", "10\n", {":6:6: system.J2: out of range, got 10", "from -1 to 1"}},
       {23, "1e-3\n", "-inf\n", {":6:6: system.J2: not finite, got -inf"}}},
      scene);
}

// A scene that is possible but hardly intended: each command warns, and the results keep the
// warning.
TEST_F(BadScene, ALikelySlipIsSaidAndKept) {
  write("slip.toml", changed(quick_scene(), "model = \"kepler\"",
                             "model = \"zonal-gravity\"\nradius_km = 6378\nJ2 = -1.08e-3"));
  const CommandResult run = hamjet({"run", "slip.toml", "-o", "slip", "-q"});
  EXPECT_EQ(run.exit_code, 0);
  const Json warnings = read_json(directory_ / "slip/summary.json")["warnings"];
  ASSERT_EQ(warnings.size(), 1U);
  const string warning = warnings[0];
  EXPECT_EQ(warning.find("warning: slip.toml:6:6: system.J2: -0.00108 is that of"), 0U) << warning;
  // The text is wrapped on the terminal.
  const string line = "hamjet: " + warning;
  EXPECT_EQ(unwrapped(run.err), line);
  const CommandResult check = hamjet({"check", "slip.toml"});
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_EQ(unwrapped(check.err), line);
  // The warning comes before the reason why there is no transfer.
  const CommandResult transfer = hamjet({"transfer", "slip.toml"});
  EXPECT_EQ(transfer.exit_code, 3);
  EXPECT_EQ(unwrapped(transfer.err).find(line), 0U) << transfer.err;
  // A scene without a mistake has no warning.
  succeed({"run", "quick.toml", "-o", "quick", "-q"});
  EXPECT_EQ(read_json(directory_ / "quick/summary.json")["warnings"], Json::array());
}

TEST_F(BadScene, MoreIntegratorsThanCanBeHeld) {
  std::string scene = quick_scene();
  for (int i = 0; i < 1000; ++i) {
    scene +=
        fmt::format("[[integrator]]\nlabel = \"{}\"\nmethod = \"gauss\"\ntolerance = 1e-9\n", i);
  }
  write("bad.toml", scene);
  expect_error({"check", "bad.toml"}, 6,
               {"integrator.1000: too many, got 1002 integrators, must be at most 1000"});
}

TEST_F(BadScene, KeysOfAnotherMethod) {
  const string method = "method = \"gauss\"\nstages = 1\nstep_canonical = 0.01";
  const string verlet = "method = \"velocity-verlet\"\norder = 2\n";
  expect_each_refused(
      {{39, method, verlet + "tolerance = 1e-9", {":25:1: ", "tolerance: the method velocity-"}},
       {39,
        method,
        verlet + "stages = 2\nstep_canonical = 0.1",
        {":25:1: ", "stages: the method velocity-verlet has no key stages"}},
       {39,
        method,
        "method = \"fehlberg78\"\norder = 2\ntolerance = 1e-9",
        {":24:1: ", "order: the method fehlberg78 has no key order"}}},
      small_scene);
}

TEST_F(BadScene, Times) {
  std::vector<SceneMistake> mistakes;
  for (const char* times : {"[0.5, 0.2]", "[0.5, 0.5]", "[2.0]", "[-1.0]"}) {
    mistakes.push_back({41,
                        "[reference]\n",
                        string("[relative_hamiltonian]\ntimes_canonical = ") + times,
                        {":31:", "times_canonical.", "outside the span or out of order"}});
  }
  mistakes.push_back({41,
                      "[reference]\n",
                      "[relative_hamiltonian]\ntimes_canonical = [nan]",
                      {":31:20: relative_hamiltonian.times_canonical.0: not finite"}});
  for (const char* times : {"[800, 700]", "[700, 700]"}) {
    mistakes.push_back({41,
                        "[reference]\n",
                        string("[transfer]\nframe = \"RTN\"\ntimes_s = ") + times +
                            "\nstart = {position_m = [0, -1000, 0]}\n"
                            "end = {position_m = [0, -100, 0]}\n",
                        {":32:", "transfer.times_s.1: out of order"}});
  }
  expect_each_refused(mistakes, small_scene);
}

// A step longer than the duration is one step of the length of the duration: no error of the
// scene. A row of the table has the choice; this program says what it took.
TEST_F(BadScene, StepLongerThanTheDuration) {
  write("long.toml", changed(quick_scene(), "duration_canonical = 1", "duration_canonical = 0.1"));
  succeed({"run", "long.toml", "-q", "--set", "integrator.midpoint.step_canonical=5"});
  EXPECT_EQ(read_json(directory_ / "out/long/summary.json")["runs"][1]["steps"], 1);
  EXPECT_EQ(read_json(directory_ / "out/long/summary.json")["duration_canonical"], 0.1);
}

// After a whole period of Kepler's problem dq/dp0 has rank 1: F1 does not exist.
TEST_F(BadScene, SingularKindIsNamedWithItsCondition) {
  write("period.toml", changed(quick_scene(), "duration_canonical = 1", "duration_orbits = 1"));
  const CommandResult result = hamjet({"run", "period.toml", "--json"});
  EXPECT_EQ(result.exit_code, 4);
  const string error = Json::parse(result.out)["runs"][0]["exactness"][0]["error"];
  for (const char* word :
       {"qqq-qqq", "does not exist at this time", "singular values", "condition"}) {
    EXPECT_NE(error.find(word), string::npos) << error << "\nlacks " << word;
  }
}

}  // namespace
}  // namespace hamjet::test
