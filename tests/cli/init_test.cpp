#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "command_test.hpp"

// A scene to start from: it stands in a file of data/templates, runs as it is, and nothing is
// replaced.

namespace hamjet::test {
namespace {

namespace fs = std::filesystem;

/// The state that the messages below give, whose distance from the centre is 7000 km.
constexpr const char* start_state = R"(X = 2000 [km]
Y = 3000 [km]
Z = 6000 [km]
X_DOT = -7.2 [km/s]
Y_DOT = 1.0 [km/s]
Z_DOT = 2.0 [km/s]
)";

std::string parameter_message(const std::string& centre) {
  return "CCSDS_OPM_VERS = 2.0\nCREATION_DATE = 2026-01-01T00:00:00\nORIGINATOR = TEST\n"
         "OBJECT_NAME = ONE \"1\"\nOBJECT_ID = 2026-001A\nCENTER_NAME = " +
         centre + "\nREF_FRAME = EME2000\nTIME_SYSTEM = UTC\nEPOCH = 2026-01-01T00:00:00\n" +
         start_state;
}

std::string ephemeris_block(const std::string& name, const std::string& id, const std::string& y) {
  return "META_START\nOBJECT_NAME = " + name + "\nOBJECT_ID = " + id +
         "\nCENTER_NAME = EARTH\nREF_FRAME = EME2000\nTIME_SYSTEM = UTC\n"
         "START_TIME = 2026-01-01T00:00:00\nSTOP_TIME = 2026-01-01T00:00:00\nMETA_STOP\n"
         "2026-01-01T00:00:00 2000 " +
         y + " 6000 -7.2 1.0 2.0\n";
}

class Init : public CommandTest {
 protected:
  /// The beginning of a line that names the program as it was called.
  const std::string called = std::string("  ") + HAMJET_COMMAND + " ";

  /// Runs the commands that the output suggests next, at least two lines of plain words.
  void run_what_is_next(const std::string& said) const {
    const std::size_t next = said.find("\nnext:\n");
    ASSERT_NE(next, std::string::npos) << said;
    std::istringstream lines(said.substr(next + 7));
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
      ASSERT_EQ(line.rfind(called, 0), 0U) << line;
      std::istringstream words(line.substr(called.size()));
      std::vector<std::string> arguments;
      for (std::string word; words >> word;) arguments.push_back(word);
      const CommandResult result = hamjet(arguments);
      EXPECT_EQ(result.exit_code, 0) << line << result.err;
    }
    EXPECT_GE(count, 2) << said;
  }

  /// The nominal's distance from the centre at the start, which is the unit of length of a run.
  double start_distance_km(const std::string& scene) const {
    const Json said = Json::parse(succeed({"run", scene, "--json"}).out);
    return said["units"]["length_km"];
  }
};

TEST_F(Init, EveryKindRunsAsItIs) {
  for (const char* kind : {"leo", "gto", "geo", "molniya", "own", "pair", "zonal"}) {
    SCOPED_TRACE(kind);
    const std::string file = kind + std::string(".toml");
    const std::string said = succeed({"init", kind}).out;
    EXPECT_EQ(said.rfind("wrote " + file + ": ", 0), 0U) << said;
    std::string text = content(fs::path(HAMJET_SOURCE_DIR) / "data/templates" / file);
    for (const auto& [mark, word] : {std::pair<std::string, std::string>{"@scene@", file},
                                     {"@results@", std::string("out/") + kind}}) {
      while (text.find(mark) != std::string::npos) text = changed(text, mark, word);
    }
    EXPECT_EQ(content(directory_ / file), text);
    // The scene contains the commands as well.
    EXPECT_NE(text.find("\n#   hamjet "), std::string::npos);
    run_what_is_next(said);
    succeed({"run", file, "-q"});
    for (const char* command : {"transfer", "validity"}) {
      if (kind == std::string("pair")) succeed({command, file, "-q"});
    }
  }
}

// A new user who has a vector field does what the scene's comment says.
TEST_F(Init, OwnTakesAVectorFieldAsItsCommentSays) {
  succeed({"init", "own"});
  std::string text = content(directory_ / "own.toml");
  const std::string comment = text.substr(text.find("# Equations that are not Hamilton's"));
  for (const char* const told :
       {"in place of\n# coordinates, momenta and hamiltonian", "parameters stay",
        "[nominal] has `states = [1.5, 0]`", "[generating_function], [periodic] and"}) {
    EXPECT_NE(comment.find(told), std::string::npos) << told;
  }
  const auto without_line = [&](const std::string& start) {
    const std::size_t from = text.find("\n" + start);
    ASSERT_NE(from, std::string::npos) << start;
    text.erase(from, text.find('\n', from + 1) - from);
  };
  without_line("coordinates = [\"theta\"]");
  without_line("momenta = [\"L\"]");
  without_line("hamiltonian =");
  text = changed(text, "# states = ", "states = ");
  text = changed(text, "# vector_field = ", "vector_field = ");
  without_line("coordinates = [1.5]");
  text = changed(text, "momenta = [0]\n", "states = [1.5, 0]\n");
  text.resize(text.find("\n[generating_function]") + 1);
  write("own.toml", text);
  const Json said = Json::parse(succeed({"run", "own.toml", "--json"}).out);
  EXPECT_EQ(said["exit_code"], 0);
  EXPECT_EQ(said["state_names"][0], "theta");
  EXPECT_EQ(said["state_names"][1], "v");
}

TEST_F(Init, NothingIsReplaced) {
  succeed({"init", "leo"});
  write("leo.toml", "mine");
  expect_error({"init", "leo"}, 5, {"leo.toml: is there already", "-o names another file"});
  EXPECT_EQ(content(directory_ / "leo.toml"), "mine");
  fs::create_symlink("nowhere", directory_ / "geo.toml");
  expect_error({"init", "geo"}, 5, {"geo.toml: is there already"});
  fs::create_directory(directory_ / "a b");
  run_what_is_next(succeed({"init", "leo", "-o", "other.toml"}).out);
  EXPECT_NE(succeed({"init", "leo", "-o", "a b/c.toml"}).out.find(called + "run 'a b/c.toml'\n"),
            std::string::npos);
}

TEST_F(Init, MistakesAreNamed) {
  expect_error({"init"}, 2,
               {"neither a kind nor --from", "geo, gto, leo, molniya, own, pair, zonal"});
  expect_error({"init", "leo", "--from", "x.opm"}, 2, {"a kind and --from"});
  expect_error({"init", "moon"}, 2, {"moon", "leo", "molniya"});
  expect_error({"init", "leo", "-o", "-"}, 2, {"--output: got -", "a scene is a file"});
  expect_error({"init", "leo", "-o", "a\nb.toml"}, 2, {"a\\x0ab.toml", "printable"});
  expect_error({"init", "--from", "x.opm"}, 5, {"x.opm", "No such file"});
  expect_error({"init", "--from", "small.toml", "-o", "new.toml"}, 5,
               {"small.toml: is no orbit message", "CCSDS_OEM_VERS or CCSDS_OPM_VERS"});
}

TEST_F(Init, StartsFromAMessage) {
  fs::create_directory(directory_ / "messages");
  fs::create_directory(directory_ / "scenes");
  write("messages/one.opm", parameter_message("EARTH"));
  const CommandResult result =
      succeed({"init", "--from", "messages/one.opm", "-o", "scenes/mine.toml"});
  EXPECT_EQ(result.out.rfind("wrote scenes/mine.toml: ONE \"1\"\n", 0), 0U) << result.out;
  const std::string text = content(directory_ / "scenes/mine.toml");
  EXPECT_NE(text.find("opm_file = \"../messages/one.opm\"\n"), std::string::npos) << text;
  EXPECT_EQ(text.find('@'), std::string::npos) << text;
  run_what_is_next(result.out);
  // 2000^2 + 3000^2 + 6000^2 = 7000^2.
  EXPECT_NEAR(start_distance_km("scenes/mine.toml"), 7000, 1e-9);
  // The default is the message's name, in the current folder.
  EXPECT_NE(succeed({"init", "--from", "messages/one.opm"}).out.find("wrote one.toml"),
            std::string::npos);
  EXPECT_NE(content(directory_ / "one.toml").find("opm_file = \"messages/one.opm\"\n"),
            std::string::npos);
}

TEST_F(Init, StartsFromAMessageInTheEarthsOwnAxes) {
  write("one.opm", changed(parameter_message("EARTH"), "EME2000", "ITRF2014"));
  run_what_is_next(succeed({"init", "--from", "one.opm"}).out);
  EXPECT_NEAR(start_distance_km("one.toml"), 7000, 1e-9);
}

TEST_F(Init, AMarkInANameIsLeftAsItIs) {
  fs::create_directory(directory_ / "odd@scene@");
  write("odd@scene@/a@results@.opm", parameter_message("EARTH"));
  run_what_is_next(succeed({"init", "--from", "odd@scene@/a@results@.opm", "-o", "odd.toml"}).out);
  EXPECT_NE(content(directory_ / "odd.toml").find("opm_file = \"odd@scene@/a@results@.opm\"\n"),
            std::string::npos);
}

TEST_F(Init, TakesTheFirstOfSeveralObjects) {
  const std::string head =
      "CCSDS_OEM_VERS = 2.0\nCREATION_DATE = 2026-01-01T00:00:00\nORIGINATOR = TEST\n";
  write("both.oem", head + ephemeris_block("ONE", "2026-001A", "3000") +
                        ephemeris_block("TWO", "2026-001B", "4000"));
  succeed({"init", "--from", "both.oem"});
  const std::string text = content(directory_ / "both.toml");
  EXPECT_NE(text.find("object = \"2026-001A\""), std::string::npos) << text;
  EXPECT_NEAR(start_distance_km("both.toml"), 7000, 1e-9);
  write("one.oem", head + ephemeris_block("ONE", "2026-001A", "3000"));
  succeed({"init", "--from", "one.oem"});
  EXPECT_EQ(content(directory_ / "one.toml").find("object ="), std::string::npos);
}

// About another body the centre alone attracts, with the mu of that body (Mars: 42828.375816 in
// JPL's DE440), or of the message.
TEST_F(Init, TakesTheCentreOfTheMessage) {
  const std::string slow = changed(parameter_message("MARS"), "X_DOT = -7.2", "X_DOT = -2.0");
  write("mars.opm", slow);
  run_what_is_next(succeed({"init", "--from", "mars.opm"}).out);
  const std::string text = content(directory_ / "mars.toml");
  EXPECT_NE(text.find("model = \"kepler\"\nmu_km3_s2 = 42828.375816\n"), std::string::npos) << text;
  write("vesta.opm", changed(slow, "CENTER_NAME = MARS", "CENTER_NAME = VESTA"));
  // An orbit faster than the escape from Mars has no period.
  write("fast.opm", parameter_message("MARS"));
  run_what_is_next(succeed({"init", "--from", "fast.opm"}).out);
  const std::string fast = content(directory_ / "fast.toml");
  EXPECT_NE(fast.find("\nduration_s = 3600 "), std::string::npos) << fast;
  EXPECT_EQ(fast.find("duration_orbits"), std::string::npos) << fast;
  expect_error({"init", "--from", "vesta.opm"}, 5, {"vesta.opm:6: CENTER_NAME: VESTA has no mu"});
}

}  // namespace
}  // namespace hamjet::test
