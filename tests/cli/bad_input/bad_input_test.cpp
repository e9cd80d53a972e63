#include <sys/stat.h>

#include "../command_test.hpp"

// Bad input and bad surroundings, each tried on the built command: exit code, what the message must
// hold, nothing on standard output, no file left. This is the table of the 72 kinds that the tests
// go by; a name without a class is of the file bad_input_scene_test.cpp (class BadScene), S. is
// bad_input_surroundings_test.cpp.
//
//  1 no arguments; --help          Usage.NoArgumentsPrintTheUsage, HelpBeginsWithExamples
//  2 unknown option                Usage.MistakesOnTheCommandLine
//  3 option without a value        Usage.MistakesOnTheCommandLine
//  4 option repeated               Usage.MistakesOnTheCommandLine
//  5 scene missing                 BadInput.ScenesThatCannotBeRead
//  6 directory, pipe, /dev/zero    BadInput.ScenesThatCannotBeRead
//  7 scene not readable            Permissions.SceneMayNotBeRead
//  8 empty scene                   BadInput.ScenesThatBreakARule
//  9 scene of 1 GB                 BadInput.ScenesThatCannotBeRead
// 10 not UTF-8, UTF-16, NUL        BadInput.ScenesThatBreakARule, Text
// 11 CR LF, byte order mark        RunOptions.ByteOrderMarkAndCarriageReturnsAreAccepted
// 12 unclosed string or array      Toml
// 13, 14 duplicate key, table      Toml
// 15, 16 unknown key, table        BadInput.ScenesThatBreakARule, Toml
// 17-20 order of another type, 0,  BadInput.ScenesThatBreakARule, Numbers (4.0 is refused: an order
//    negative, fractional          is an integer)
// 21 order 99                      BadInput.ScenesThatBreakARule
// 22 beyond 64 bits                Numbers
// 23 nan, inf                      BadInput.ScenesThatBreakARule, ZonalHarmonics
// 24-26 vector of another length,  BadInput.ScenesThatBreakARule, Numbers
//    another type, at the centre
// 27, 28 mu and radius             Numbers, ZonalHarmonics
// 29, 30 over- and underflow       BadInput.ScenesThatBreakARule, ZonalHarmonics
// 31 J2 = 10                       ZonalHarmonics (refused: the limit is 1)
// 32 unknown method                BadInput.ScenesThatBreakARule
// 33 stages                        BadInput.ScenesThatBreakARule, Numbers
// 34 step 0, negative, nan         BadInput.ScenesThatBreakARule, Numbers
// 35 step above the duration       StepLongerThanTheDuration (one step, and the summary says so)
// 36, 37 step too small            BadInput.ScenesThatBreakARule, Numbers
// 38 tolerance                     BadInput.ScenesThatBreakARule, Numbers
// 39 key of another method         KeysOfAnotherMethod, BadInput.ScenesThatBreakARule
// 40 unknown kind; singular kind   BadInput.ScenesThatBreakARule; Outcomes.KindThatDoesNotExist...,
//                                  SingularKindIsNamedWithItsCondition
// 41 times out of order            Times
// 42 deviations missing, NaN, ...  EvalErrors.BadTables, PlacesThatCannotBeReadOrWritten
// 43 deviations outside the radius Eval.MarksWhatTheSeriesDoesNotSupport;
//                                  TransferCommand.BeyondValidityIsMarkedAndFailsOnlyAStrictScene
// 44 output directory missing      S.OutputInPlaceOfTheScene (it is created)
// 45 not writable                  Permissions.OutputMayNotBeWritten
// 46 output exists                 Repetition.* (results are replaced whole, other files stay)
// 47 output is the scene           S.OutputInPlaceOfTheScene (5, as for any file)
// 48 disk full                     SmallDisk.*, FailingCalls.*, BadOutput.StandardOutputIsFull
// 49 full at close or flush        FailingCalls.Flush, Close
// 50 standard output closed        BadOutput.StandardOutputHasNoReader, WithBothStreamsClosed...
// 51 file-size limit               BadOutput.TakesNoMoreBytes
// 52 memory limit                  S.MemoryRunsOutAnywhere, LessMemoryThanTheSceneTakes
// 53, 54 signals                   Interruption.*
// 55 kill -9                       KillRun.*, KillComparison.*
// 56, 57 stored results cut or a   ChangedResults.* (ResultSets.* of the io tests: every byte and
//    bit flipped                   bit)
// 58 of another scene, version     Compare.InterruptedAndResumed..., StoredJetTest.DamagedSummary
// 60 JSON with NaN                 S.FailedRunsLeaveValidJson
// 61 two runs in one directory     Faults.ASecondRunInTheSameDirectoryIsRefusedAtOnce
// 63 hostile names                 S.NamesThatLeadElsewhereOrHoldMarkup, TitlesAreText...
// 64 CSV field with =              S.LabelsAreNoFormulas
// 65, 66 locale, TZ, HOME, ...     RunOptions.EnvironmentDoesNotMatter, S.WorkingDirectory...
// 68 arithmetic of the host        S.ArithmeticOfTheHostIsReset
// 69 deep nesting                  DeepNesting
// 70-72 library                    tests of the layers: SeriesOfTwoSpaces.*, MakeSystem.*, ...
//
// Left out: 59 and 62 (no file is HDF5), 67 (there is no option for threads); 70 to 72 on the
// command, which takes no code of the user's.
//
// Lines in the messages are those of small_scene, counted by hand.

namespace hamjet::test {
namespace {

using BadInput = CommandTest;

struct Mistake {
  const char* from;
  const char* to;
  std::vector<std::string> words;
  int exit_code = 3;
};

TEST_F(BadInput, ScenesThatBreakARule) {
  const char* elements =
      "a_km = 10000\ne = 0.1\ni_deg = 30\nraan_deg = 10\nargp_deg = 20\nta_deg = 30\n";
  const Mistake mistakes[] = {
      {"order = 2", "ordre = 2", {":14:1: jet.ordre: unknown key", "did you mean order?"}},
      {"[formation]", "[formaton]", {":26:2: formaton: unknown key", "did you mean formation?"}},
      {"order = 2", "order = \"2\"", {":14:9: jet.order: wrong type, got the string \"2\""}},
      {"order = 2", "order = 2.0", {":14:9: jet.order: wrong type", "integer"}},
      {"order = 2", "order = 0", {":14:9: jet.order: out of range, got 0"}},
      {"order = 2", "order = -1", {":14:9: jet.order: out of range, got -1"}},
      // C(6 + 99, 99) coefficients, by hand 1 609 344 100; 8 bytes each.
      {"order = 2", "order = 99", {":14:9: jet.order", "1609344100", "12.9 GB"}, 6},
      {"canonical = 1", "canonical = nan", {":15:22: jet.duration_canonical: not finite"}},
      {"canonical = 1", "canonical = inf", {":15:22: jet.duration_canonical: not finite"}},
      {"canonical = 1", "canonical = 1e400", {":15:22", "duration_canonical: number out of range"}},
      {"a_km = 10000", "a_km = nan", {":7:8: nominal.a_km: not finite"}},
      {"i_deg = 30", "i_deg = inf", {":9:9: nominal.i_deg: not finite"}},
      {"e = 0.1", "e = 1", {":8:5: nominal.e: out of range, got 1"}},
      {"e = 0.1", "e = 1.5", {":8:5: nominal.e: out of range", "position_km"}},
      {"a_km = 10000",
       "a_km = 10000\nposition_km = [1, 2, 3]\nvelocity_km_s = [1, 2, 3]",
       {":7:8: nominal.a_km: both forms"}},
      {elements, "", {":6:1: nominal: no orbit, got neither"}},
      {elements,
       "position_km = [0, 0, 0]\nvelocity_km_s = [0, 1, 0]\n",
       {":7:15: nominal.position_km: at the centre"}},
      {elements, "position_km = [1, 0]\nvelocity_km_s = [0, 1, 0]\n", {":7:", "position_km", "3"}},
      {"step_canonical = 0.01",
       "step_canonical = -0.01",
       {":25:18", "step_canonical: not positive"}},
      {"step_canonical = 0.01", "step_canonical = 0", {":25:18", "step_canonical: not positive"}},
      {"step_canonical = 0.01", "step_canonical = 1e-17", {":25:18", "too small"}},
      {"step_canonical = 0.01", "step_canonical = 1e-10", {":25:18", "too many steps"}, 6},
      {"step_canonical = 0.01",
       "step_s = 1\ntolerance = 1e-9",
       {":26:13: integrator.1.tolerance", "exactly one of"}},
      {"tolerance = 1e-13", "tolerance = 0", {":20:13: integrator.0.tolerance: out of range"}},
      {"tolerance = 1e-13", "tolerance = -1", {":20:13: integrator.0.tolerance: out of range"}},
      {"tolerance = 1e-13", "tolerance = 1e-20", {":20:13: integrator.0.tolerance: out of range"}},
      {"\"midpoint\"", "\"gauss8\"", {":22:9: integrator.1.label: duplicate label", ":17:9"}},
      {"\"midpoint\"", "\"../up\"", {":22:9: integrator.1.label: not usable"}},
      {"method = \"gauss\"", "method = \"guass\"", {":18:10", "did you mean gauss?"}},
      {"stages = 8", "stages = 13", {":19:10: integrator.0.stages: out of range"}},
      {"\"F2\"", "\"F5\"", {":29:16", "unknown kind, got \"F5\""}},
      {"separation_km = 1", "separation_km = 0", {":27:17: formation.separation_km"}},
      {"mu_km3_s2 = 398600.4415", "mu_km3_s2 = 0", {":5:13: system.mu_km3_s2: not positive"}},
      {"title = \"small\"", "title = \"small", {":2:", "not valid TOML"}},
      {"title = \"small\"", "schema = 1", {":2:", "not valid TOML"}},
      {"title = \"small\"", "title = \"\xff\"", {"not UTF-8", "offset 20"}},
      {"schema = 1", "schema = 2", {":1:10: schema"}},
  };
  for (const Mistake& mistake : mistakes) {
    SCOPED_TRACE(mistake.to);
    write("bad.toml", changed(small_scene, mistake.from, mistake.to));
    std::vector<std::string> words = mistake.words;
    words.emplace_back("bad.toml:");
    expect_error({"run", "bad.toml"}, mistake.exit_code, words);
  }
  write("bad.toml", "schema = 0");
  expect_error({"run", "bad.toml"}, 3, {"bad.toml:1:10: schema: out of range"});
}

// Newmark's beta is from 0 to 1/2, ends included (Newmark 1959): the ends pass the check.
TEST_F(BadInput, NewmarkBetaOutsideItsRange) {
  const auto scene_with = [](const std::string& beta) {
    return changed(small_scene, "method = \"gauss\"\nstages = 1",
                   "method = \"newmark\"\nbeta = " + beta);
  };
  const Mistake mistakes[] = {
      {"beta", "-0.01", {": out of range, got -0.01, must be a number from 0 to 0.5"}},
      {"beta", "-5e-324", {": out of range, got -5e-324, must be"}},
      {"beta", "0.51", {": out of range, got 0.51, must be a number from 0 to 0.5"}},
      {"beta", "0.5000000000000001", {": out of range, got 0.5000000000000001, must be"}},
      {"beta", "nan", {": not finite, got nan, must be a number from 0 to 0.5"}},
      {"beta", "-inf", {": not finite, got -inf, must be"}},
      {"beta", "\"0.25\"", {": wrong type, got the string \"0.25\", must be"}},
  };
  for (const Mistake& mistake : mistakes) {
    write("bad.toml", scene_with(mistake.to));
    for (const char* command : {"run", "check"}) {
      expect_error({command, "bad.toml"}, 3,
                   {"bad.toml:24:8: integrator.1.beta" + mistake.words[0]});
    }
  }
  for (const char* beta : {"0", "0.5"}) {
    write("good.toml", scene_with(beta));
    succeed({"check", "good.toml"});
  }
  expect_error(
      {"run", "good.toml", "--set", "integrator.midpoint.beta=0.6"}, 3,
      {"--set integrator.midpoint.beta: out of range, got 0.6, must be a number from 0 to"});
}

// The mass matrix of a scene is the oscillator's mass: 0 makes it singular.
TEST_F(BadInput, MassThatIsNotPositive) {
  const std::string scene = R"(schema = 1
title = "mass"
)" + changed(oscillator_tables, "[nominal]", "mass_kg = 1\n[nominal]") +
                            R"([jet]
order = 1
duration_canonical = 1
[[integrator]]
label = "newmark"
method = "newmark"
beta = 0.25
step_canonical = 0.1
)";
  const Mistake mistakes[] = {
      {"1", "0", {": not positive, got 0, must be a number above 0"}},
      {"1", "-0.0", {": not positive, got -0", "must be a number above 0"}},
      {"1", "-2", {": not positive, got -2, must be a number above 0"}},
      {"1", "nan", {": not finite, got nan, must be a number above 0"}},
      {"1", "inf", {": not finite, got inf, must be a number above 0"}},
  };
  for (const Mistake& mistake : mistakes) {
    write("bad.toml", changed(scene, "mass_kg = 1", std::string("mass_kg = ") + mistake.to));
    std::vector<std::string> words = mistake.words;
    words[0] = "bad.toml:5:11: system.mass_kg" + words[0];
    for (const char* command : {"run", "check"}) expect_error({command, "bad.toml"}, 3, words);
  }
  write("good.toml", scene);
  succeed({"check", "good.toml"});
  expect_error({"run", "good.toml", "--set", "system.mass_kg=0"}, 3,
               {"--set system.mass_kg: not positive, got 0, must be a number above 0"});
}

TEST_F(BadInput, OverridesAreNamedInstead) {
  expect_error({"run", "small.toml", "--set", "jet.order=0"}, 3, {"--set jet.order: out of range"});
  expect_error({"run", "small.toml", "--set", "jet.order=x"}, 3, {"the string \"x\""});
  expect_error({"demo", "--set", "nominal.e=1.5"}, 3, {"--set nominal.e: out of range"});
  expect_error({"run", "small.toml", "--set", "jet.order=99"}, 6,
               {"--set jet.order", "1609344100"});
  expect_error({"run", "small.toml", "--set", "integrator.gauss8.tolerance=0"}, 3,
               {"hamjet: --set integrator.gauss8.tolerance: out of range, got 0"});
  expect_error({"run", "small.toml", "--set", "jet.duration_orbits=1"}, 3,
               {"hamjet: --set jet.duration_orbits: more than one key",
                "--set jet.duration_canonical=null"});
}

TEST_F(BadInput, AnOverrideHasOneValue) {
  expect_error(
      {"check", "small.toml", "--set", "jet.order=1", "--set", "title=a", "--set", "jet.order=3"},
      2, {"hamjet: --set jet.order: given twice, as 1 and as 3; must be given once\n"});
  expect_error(
      {"check", "small.toml", "--set", "jet.order=1", "--set", "jet={order=2}"}, 2,
      {"hamjet: --set jet: replaces what --set jet.order has given; must stand before it\n"});
  // An integrator may be named by its label or by its index.
  expect_error({"check", "small.toml", "--set", "integrator.gauss8.tolerance=1e-9", "--set",
                "integrator.0.tolerance=1e-10"},
               2,
               {"hamjet: --set integrator.0.tolerance: the same key as --set "
                "integrator.gauss8.tolerance; must be given once\n"});
  expect_error(
      {"check", "small.toml", "--set", "integrator.0.tolerance=1e-9", "--set", "integrator=[]"}, 2,
      {"--set integrator: replaces what --set integrator.0.tolerance has given"});
  // What is removed beside a key changes nothing for it; elements behind a removed one move up.
  expect_error({"check", "small.toml", "--set", "jet.order=1", "--set", "jet.arcs=null", "--set",
                "jet.order=2"},
               2, {"hamjet: --set jet.order: given twice, as 1 and as 2"});
  const std::string two = R"(integrator=[{label="a", method="gauss", tolerance=1e-9}, )"
                          R"({label="b", method="gauss", tolerance=1e-9}])";
  expect_error({"check", "small.toml", "--set", two, "--set", "integrator.b.tolerance=1e-8",
                "--set", "integrator.0=null", "--set", "integrator.0.tolerance=1e-7"},
               2,
               {"hamjet: --set integrator.0.tolerance: the same key as --set "
                "integrator.b.tolerance; must be given once\n"});
  succeed({"check", "small.toml", "--set", two, "--set", "integrator.a.tolerance=1e-8", "--set",
           "integrator.0=null", "--set", "integrator.0.tolerance=1e-7"});
  // Other keys, and one that is removed first, keep their order.
  succeed({"check", "small.toml", "--set", "jet.order=1", "--set", "title=b"});
  succeed({"check", "small.toml", "--set", "nominal=null", "--set", "nominal={}", "--set",
           "nominal.position_km=[7000, 0, 0]", "--set", "nominal.velocity_km_s=[0, 7, 0]"});
}

TEST_F(BadInput, ScenesThatCannotBeRead) {
  expect_error({"run", "missing.toml"}, 5, {"missing.toml: ", "No such file"});
  std::filesystem::create_directory(directory_ / "folder.toml");
  expect_error({"run", "folder.toml"}, 5, {"folder.toml: ", "a directory"});
  expect_error({"run", "small.toml/x"}, 5, {"small.toml/x: ", "Not a directory"});
  expect_error({"run", "/dev/zero"}, 5, {"/dev/zero: ", "a device"});
  ASSERT_EQ(::mkfifo((directory_ / "pipe").c_str(), 0600), 0);
  expect_error({"run", "pipe"}, 5, {"pipe: ", "a pipe"});
  std::filesystem::resize_file(write("large.toml", ""), std::uintmax_t{1} << 30);
  expect_error({"run", "large.toml"}, 3, {"large.toml: ", "too large, got 1073741824"});
}

TEST_F(BadInput, TheMemoryThatASceneWouldTakeIsNamed) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer reserves more than any limit";
#else
  // Order 12 in 6 variables has C(18, 6) = 18564 coefficients; with both integrators, inversions
  // and reference that takes far more than 200 MB.
  options_.address_space = 200'000'000;
  expect_error({"run", "small.toml", "--set", "jet.order=12"}, 6,
               {"order 12 in 6 variables", "18564", "MB in all", "200 MB are free"});
  expect_error({"check", "small.toml", "--set", "jet.order=12"}, 6, {"MB in all"});
#endif
}

}  // namespace
}  // namespace hamjet::test
