#include <sys/stat.h>

#include <csignal>

#include "../command_test.hpp"

// Bad surroundings: memory, arithmetic, hostile names, a directory that nothing can be written to.
// Rows of the table at the head of bad_input_test.cpp.

namespace hamjet::test {
namespace {

using std::string;
using Surroundings = CommandTest;

// Row 44: the directory of the results is created, with those above it. Row 46: results that are
// there are replaced whole; files of the user's own stay (RunFiles, Repetition). Row 47:
TEST_F(Surroundings, OutputInPlaceOfTheScene) {
  succeed({"run", "quick.toml", "-q", "-o", "a/b/c"});
  expect_error({"run", "quick.toml", "-o", "quick.toml"}, 5, {"quick.toml: the output directory"});
  EXPECT_EQ(content(directory_ / "quick.toml"), quick_scene());
  succeed({"run", "quick.toml", "-q", "-o", "."});
  EXPECT_EQ(content(directory_ / "quick.toml"), quick_scene());
  expect_error({"eval", ".", "--deviation", "1,2,3,0,0,0", "-o", "summary.json"}, 2,
               {"summary.json: is a file of results"});
}

#if !defined(__SANITIZE_ADDRESS__)
// Row 52. One allocation after another fails, once the libraries have started.
TEST_F(Surroundings, MemoryRunsOutAnywhere) {
  succeed({"run", "quick.toml", "-q", "-o", "right"});
  int refused = 0;
  int number = 1000;
  for (int passed = 0; passed < 3; number += 1 + number / 10) {
    options_.environment = {{"LD_PRELOAD", HAMJET_FAILING_CALLS},
                            {"HAMJET_FAILING_CALL", "malloc:" + std::to_string(number)}};
    const CommandResult result = hamjet({"run", "quick.toml", "-q"});
    options_.environment.clear();
    SCOPED_TRACE(number);
    ASSERT_EQ(result.signal, 0) << result.err;
    EXPECT_EQ(result.out, "");
    if (result.exit_code == 0) {
      // The last allocation has passed, or the allocation was optional, as are some of the
      // libraries' own at their start.
      if (refused > 0) ++passed;
      ASSERT_LT(number, 1'000'000) << "none was refused";
      EXPECT_EQ(content(directory_ / "out/quick/midpoint/jet.csv"),
                content(directory_ / "right/midpoint/jet.csv"));
      continue;
    }
    ++refused;
    EXPECT_EQ(result.exit_code, 6) << result.err;
    EXPECT_EQ(result.err, "hamjet: out of memory; a lower order or fewer variables would fit\n");
  }
  EXPECT_GE(refused, 10);
}

// Row 52. The memory that a scene needs is known before it is computed: with less memory it is
// refused with both numbers.
TEST_F(Surroundings, LessMemoryThanTheSceneTakes) {
  for (const rlim_t megabytes : {rlim_t{75}, rlim_t{100}, rlim_t{150}}) {
    options_.address_space = megabytes * 1'000'000;
    expect_error({"run", "small.toml", "--set", "jet.order=12"}, 6,
                 {"order 12 in 6 variables: 18564 coefficients a component", "MB in all",
                  std::to_string(megabytes) + " MB are free"});
  }
}

// Row 68. Rounding upwards, and denormal numbers taken for zero, change the digits of every result.
TEST_F(Surroundings, ArithmeticOfTheHostIsReset) {
  succeed({"run", "quick.toml", "-q", "-o", "right"});
  options_.environment = {{"LD_PRELOAD", HAMJET_OTHER_ARITHMETIC}};
  succeed({"run", "quick.toml", "-q", "-o", "other"});
  for (const char* file : {"gauss8/jet.csv", "midpoint/jet.csv", "midpoint/nominal.csv",
                           "gauss8/generating_function_F1.csv"}) {
    EXPECT_EQ(content(directory_ / "other" / file), content(directory_ / "right" / file)) << file;
  }
}

// Without enough stack a program ends in the midst of its work without a word.
TEST_F(Surroundings, LessStackThanTheProgramTakes) {
  options_.stack = 64 * 1024;
  expect_error({"run", "small.toml"}, 6, {"the stack is limited to 64 kB, must be at least 1024"});
  options_.stack = 1024 * 1024;
  succeed({"run", "small.toml", "-q"});
}

// A limit of memory or of processes keeps threads from starting.
TEST_F(Surroundings, ThreadsThatCannotBeStarted) {
  succeed({"run", "small.toml", "-q", "-o", "right"});
  const auto let_fail = [&](const char* which) {
    options_.environment = {{"LD_PRELOAD", HAMJET_FAILING_CALLS}, {"HAMJET_FAILING_CALL", which}};
  };
  // The reference's two runs then come one after the other.
  let_fail("pthread_create:1");
  succeed({"run", "small.toml", "-q", "-o", "alone"});
  EXPECT_EQ(read_json(directory_ / "alone/summary.json")["reference"]["uncertainty_by_degree"],
            read_json(directory_ / "right/summary.json")["reference"]["uncertainty_by_degree"]);
  write("sweep.toml", R"(schema = 1
title = "two"
[sweep]
scene = "quick.toml"
command = "run"
[[axis]]
key = "nominal.e"
values = [0.1, 0.2, 0.3]
[[column]]
name = "energy"
value = "/runs/gauss8/energy_error"
)");
  const CommandResult none = hamjet({"sweep", "sweep.toml", "-q", "--threads", "3"});
  EXPECT_EQ(none.exit_code, 6) << none.err;
  EXPECT_EQ(none.err, "hamjet: out of memory; a lower order or fewer variables would fit\n");
  let_fail("pthread_create:3");
  succeed({"sweep", "sweep.toml", "-q", "--threads", "3"});
}
#endif

// Row 60. What was not computed is null, and infinite numbers do not get into a file.
TEST_F(Surroundings, FailedRunsLeaveValidJson) {
  const string fall =
      changed(quick_scene(),
              "a_km = 10000\ne = 0.1\ni_deg = 30\nraan_deg = 10\nargp_deg = 20\nta_deg = 30\n",
              "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 0, 0]\n");
  write("fall.toml", changed(fall, "duration_canonical = 1", "duration_canonical = 3"));
  EXPECT_EQ(hamjet({"run", "fall.toml", "-q"}).exit_code, 4);
  const string text = content(directory_ / "out/fall/summary.json");
  const Json summary = Json::parse(text);  // which takes no NaN and no Infinity
  EXPECT_TRUE(summary["runs"][0]["nominal_final"].is_null());
  EXPECT_TRUE(summary["runs"][0]["error"].is_string());
}

// Row 63. The name of a scene is that of a directory, its title stands in pages.
TEST_F(Surroundings, NamesThatLeadElsewhereOrHoldMarkup) {
  const struct {
    string file;
    string directory;
  } names[] = {{"...toml", "scene"},
               {"..toml", "scene"},
               {"a\nb.toml", "a_b"},
               {"<b>x.toml", "_b_x"},
               {"=x.toml", "_x"},
               {"\xff.toml", "_"},
               {string("../") + directory_.filename().string() + "/quick.toml", "quick"}};
  for (const auto& name : names) {
    SCOPED_TRACE(name.file);
    write(name.file, quick_scene());
    std::filesystem::remove_all(directory_ / "out");
    succeed({"run", "./" + name.file, "-q"});
    std::vector<string> found;
    for (const auto& entry : std::filesystem::directory_iterator(directory_ / "out")) {
      found.push_back(entry.path().filename().string());
    }
    EXPECT_EQ(found, std::vector<string>{name.directory});
  }
  expect_error({"run", "a\nb<>.toml"}, 5, {"a\\x0ab<>.toml: the scene cannot be read"});
}

TEST_F(Surroundings, TitlesAreTextInPagesAndTables) {
  options_.environment = {{"XDG_CACHE_HOME", (directory_ / "cache").string()},
                          {"PATH", "/nowhere"}};
  const string title = "</title><script>alert(1)</script>&amp;\\u2028=1+1,\\\"x\\\"";
  write("hostile.toml", changed(quick_scene(), "title = \"small\"", "title = \"" + title + "\""));
  const CommandResult result =
      hamjet({"compare", "hostile.toml", "-q", "--set",
              "compare={methods=[\"gauss\"], stages=[4], steps_canonical=[0.4], "
              "tolerances=[1e-5], orders=[1], repeats=1, time_budget_s=10}"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const string page = content(directory_ / "out/hostile/report.html");
  EXPECT_EQ(page.find("<script"), string::npos);
  EXPECT_NE(page.find("&lt;script&gt;alert(1)&lt;/script&gt;&amp;amp;"), string::npos);
  const Json json = read_json(directory_ / "out/hostile/compare.json");
  EXPECT_EQ(json["scene"]["title"],
            "</title><script>alert(1)</script>&amp;\\xe2\\x80\\xa8=1+1,\"x\"");
}

// Row 64. A label is the user's name of a run in tables. It cannot begin with a character that
// starts a formula in spreadsheets, nor contain a comma.
TEST_F(Surroundings, LabelsAreNoFormulas) {
  for (const char* label : {"=1+1", "+1", "@x", "a,b", "a\\\"b", "../x", "", ".", "summary.json"}) {
    write("bad.toml", changed(quick_scene(), "\"midpoint\"", string("\"") + label + "\""));
    expect_error({"run", "bad.toml"}, 3, {"bad.toml:22:9: integrator.1.label"});
  }
}

// Row 66. The working directory may be one that nothing can be written to.
TEST_F(Surroundings, WorkingDirectoryThatCannotBeWrittenTo) {
  const TemporaryDirectory elsewhere;
  options_.as_nobody = ::geteuid() == 0;
  std::filesystem::permissions(directory_, std::filesystem::perms(0555));
  std::filesystem::permissions(elsewhere.path(), std::filesystem::perms(0777));
  options_.environment = {{"HOME", std::nullopt}, {"TZ", std::nullopt}, {"XDG_CACHE_HOME", ""}};
  if (hamjet({"--version"}).exit_code == cannot_start) {
    GTEST_SKIP() << "the command cannot be run by another user here";
  }
  succeed({"run", "quick.toml", "-q", "-o", (elsewhere.path() / "results").string()});
  succeed({"run", "small.toml", "-q", "-o", (elsewhere.path() / "small").string()});
  std::filesystem::permissions(directory_, std::filesystem::perms(0755));
}

}  // namespace
}  // namespace hamjet::test
