#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scene_samples.hpp"
#include "support/temporary_directory.hpp"

// Bad input that is found before the schema is checked: files, bytes, TOML syntax, overrides.
// Expected: the documentation of read_scene, with offsets, lines and columns counted by hand.

namespace hamjet::io {
namespace {

TEST(SceneInputErrors, Syntax) {
  expect_scene_error("title = \"abc\n", {"file.toml:1:", "not valid TOML"});
  expect_scene_error("a = [1,\n2", {"file.toml:2:", "not valid TOML"});
  expect_scene_error("schema = \n", {"file.toml:1:", "not valid TOML"});
  expect_scene_error("\"a\x1b\" = 1\n", {"file.toml:1:", "not valid TOML"});
}

TEST(SceneInputErrors, DuplicateKeysAreNamedWithTheirFirstPlace) {
  expect_scene_error("schema = 1\n\nschema = 1\n",
                     {"file.toml:3:", "redefine", "'schema'", "already at file.toml:1:10"});
  expect_scene_error("[jet]\norder = 1\n[jet]\n",
                     {"file.toml:3:1", "redefine", "'jet'", "already at file.toml:1:1"});
  expect_scene_error("[[i]]\na = 1\n[[i]]\na = 2\na = 3\n", {":5:", "already at file.toml:4:5"});
  expect_scene_error("[t]\nb.c = 3\n\"\u00e9\" . d = 4\n\"\u00e9\".d = 5\n",
                     {":4:", "already at file.toml:3:11"});
  expect_scene_error("jet = 3\n[jet] # again\n", {":2:1", "already at file.toml:1:7"});
  expect_scene_error("b = [\n1]\nb = [\n2]\n", {":3:", "already at file.toml:1:5"});
  // Within an inline table the first place is on the same line.
  expect_scene_error("y = 1\na = {y = 2, y = 3}\n", {"file.toml:2:", "redefine", "'y'"});
}

TEST(SceneInputErrors, Text) {
  expect_scene_error(std::string("schema = 1\n# ") + std::string(1, '\0'),
                     {"file.toml: ", "NUL", "offset 13"});
  expect_scene_error("# caf\xe9\n", {"not UTF-8", "0xe9", "offset 5"});
  expect_scene_error("# \xc0\xaf\n", {"not UTF-8", "offset 2"});
  expect_scene_error("# \xed\xa0\x80\n", {"not UTF-8", "offset 2"});
  expect_scene_error("# \xf4\x90\x80\x80\n", {"not UTF-8", "offset 2"});
  expect_scene_error("# \xe2\x82", {"not UTF-8", "offset 2"});
  expect_scene_error("\xff\xfes\0", {"UTF-16", "offset 0"});
  expect_scene_error("\xfe\xff", {"UTF-16", "offset 0"});
  expect_scene_error(std::string((1U << 20) + 1, '#'), {"too large, got 1048577", "1048576"});
  // No UTF-8 character, nor the column, is split by what comes after it on the line.
  expect_scene_error("\"\xc3\xa9\" = 1e999\n", {"file.toml:1:7: \xc3\xa9: number out of range"});
}

// TOML 1.0 knows ASCII alone there; found by fuzzing: toml++ 3.3 runs into undefined behaviour at
// U+0498.
TEST(SceneInputErrors, NotAsciiOutsideQuotes) {
  const auto refused = [](const std::string& place, const std::string& character) {
    return std::vector<std::string>{"file.toml:" + place + ": not valid TOML",
                                    "character \"" + character + "\" outside quotes"};
  };
  expect_scene_error("schema = 1\n \u0498 = 1\n", refused("2:2", "\u0498"));
  expect_scene_error("schema = 1\na\u0498= 1\n", refused("2:2", "\u0498"));
  expect_scene_error("gr\u00f6\u00dfe = 1\n", refused("1:3", "\u00f6"));
  expect_scene_error("schema\u00a0= 1\n", refused("1:7", "\u00a0"));
  expect_scene_error("[\U0001F6F0]\n", refused("1:2", "\U0001F6F0"));
  expect_scene_error("title = \u201cx\u201d\n", refused("1:9", "\u201c"));
  // Line ends that could break a terminal's line are escaped.
  expect_scene_error("\u2028schema = 1\n", refused("1:1", "\\xe2\\x80\\xa8"));
  // Text that the parser does not take for a string is not a string.
  for (const std::string text :
       {"a = 5\"\u0498.\"", "a = (\"\u0498\"", "a\"\u0498\" = 1", "a = \"\"'\u0498'",
        "a = 'x''\u0498'", "a = 2=\"\u0498", "a = 2[\"\u0498", "a = 2{'\u0498", "a = 2.\"\u0498",
        "a = 2025-01-01T=\"\u0498", "a = {b=2=\"\u0498\"}"}) {
    expect_scene_error(text + "\n", {"file.toml:1:", "not valid TOML: got a quotation mark"});
  }
  // Behind a backslash at the end of a line the parser looks for blanks in the string itself.
  for (const std::string text : {"a = \"\"\"x \\\n  \u00e9\"\"\"", "a = \"\"\"\\\n\u0498\"\"\"",
                                 "a = \"\"\"x \\ \u0498\"\"\""}) {
    expect_scene_error(text + "\n",
                       {"file.toml:", "cannot be read: got the character", "backslash"});
  }
  expect_scene_error("a = \"\"\"x \\\u00e9\"\"\"\n",
                     {"file.toml:1:11:", "got the character \"\u00e9\" behind a backslash"});
  const std::string joined =
      changed(oscillator, "\"oscillator\"", "\"\"\"a \u00e9 \\\n  b \u0498\"\"\"");
  EXPECT_EQ(parse_scene(joined, "file.toml").title, "a \u00e9 b \u0498");
  const std::string inside = changed(oscillator, "\"oscillator\"", "\"\u0498 \u00a0\" # \u0498");
  EXPECT_EQ(parse_scene(inside, "file.toml").title, "\u0498 \u00a0");
}

TEST(SceneInputErrors, DeepNesting) {
  std::string dots = "a";
  for (int i = 0; i < 100000; ++i) dots += ".a";
  expect_scene_error(dots + " = 1\n", {"file.toml:1:", "nested too deeply", "32"});
  expect_scene_error("[" + dots + "]\n", {"nested too deeply"});
  expect_scene_error("a = " + std::string(100000, '['), {"file.toml:1:", "nested too deeply"});
  expect_scene_error("a = {" + dots + " = 1}\n", {"nested too deeply"});
  expect_scene_error("a = [\"\"\"x\"\"\"\", " + std::string(100000, '['), {"nested too deeply"});
  std::string braces = "a = ";
  for (int i = 0; i < 1000; ++i) braces += "{a = ";
  expect_scene_error(braces, {"nested too deeply"});
}

TEST(SceneInputErrors, QuotesStayShort) {
  expect_scene_error(std::string(5000, 'k') + " = 1\n" + orbit, {std::string(80, 'k') + "..."});
  // An escape is as long as it is printed; found by fuzzing.
  expect_scene_error("\"" + std::string(5000, '\t') + "\" = 1\n" + orbit,
                     {"got \\x09", "\\x09..., must be"});
  expect_error(
      [] {
        parse_scene(orbit, "file.toml", {{std::string(200, '\t') + ".x", "1"}});
      },
      ErrorKind::scene, {"--set \\x09"}, "override");
  expect_scene_error(changed(orbit, "gauss8", std::string(5000, '?')),
                     {std::string(80, '?') + "..."});
  expect_scene_error(changed(orbit, "\"gauss8\"", "\"\\u0085\\u2028\""),
                     {"\"\\xc2\\x85\\xe2\\x80\\xa8\""});
  expect_error([] { parse_scene("schema = 2", "a\nb"); }, ErrorKind::scene,
               {"a\\x0ab:1:10: schema"}, "name");
}

void expect_override_error(const Override& change, ErrorKind kind,
                           const std::vector<std::string>& words) {
  expect_error([&] { parse_scene(orbit, "file.toml", {change}); }, kind, words,
               change.key + "=" + change.value);
}

TEST(SceneInputErrors, Overrides) {
  const auto scene = ErrorKind::scene;
  const auto usage = ErrorKind::usage;
  expect_override_error({"jet.order", "0"}, scene, {"--set jet.order: out of range"});
  expect_override_error({"jet.order", "99"}, ErrorKind::too_large,
                        {"--set jet.order", "1609344100"});
  // A number that does not fit is not read as a text.
  expect_override_error({"jet.order", "1e400"}, scene,
                        {"--set jet.order: out of range, got 1e400, must be a number"});
  expect_override_error({"jet.order", "12345678901234567890"}, scene,
                        {"out of range, got 12345678901234567890", "or an exponent"});
  expect_override_error({"jet.order", "3\nvariables=[]"}, scene, {"the string \"3\\x0avariables"});
  expect_override_error({"system.J2", "1e-400"}, scene,
                        {"--set system.J2: out of range, got 1e-400"});
  expect_override_error({"jet.ordre", "3"}, scene, {"--set jet.ordre: ", "did you mean order?"});
  // An option that stands for a key is named itself, and what it removes need not be there.
  expect_override_error({"jet.order", "0", "--order"}, scene, {"--order: out of range"});
  expect_override_error({"jet.order", "1e400", "--order"}, scene, {"--order: out of range, got"});
  EXPECT_EQ(
      parse_scene(orbit, "file.toml", {{"jet.end_coordinates", "null", "--coordinates"}}).order,
      parse_scene(orbit, "file.toml").order);
  expect_error(
      [] {
        parse_scene(orbit, "file.toml", {{"jet.order", "2"}, {"jet.order", "3", "--order"}});
      },
      usage, {"--order: the same key as --set jet.order; must be given once"}, "both");
  expect_override_error({"a.b", "3"}, scene, {"--set a.b: unknown key, got a,"});
  expect_override_error({"reference", "{tol = 1}"}, scene, {"--set reference.tol: unknown key"});
  expect_override_error({"integrator.gauss8.stages", "13"}, scene,
                        {"--set integrator.gauss8.stages: out of range"});
  expect_override_error({"integrator.1.label", "gauss8"}, scene, {"duplicate", "file.toml:15:9"});
  expect_override_error({"", "3"}, usage, {"--set", "empty name"});
  expect_override_error({"jet..order", "3"}, usage, {"--set jet..order: empty name"});
  expect_override_error({"jet.", "3"}, usage, {"empty name"});
  expect_override_error({"title.x", "3"}, usage, {"no such key", "below a value"});
  expect_override_error({"integrator.2.stages", "3"}, usage, {"no such element", "below 2"});
  expect_override_error({"integrator.-1.stages", "3"}, usage, {"no such element"});
  expect_override_error({"integrator.guass8.stages", "3"}, usage,
                        {"no such element", "guass8", "must be gauss8, other or an index below 2"});
  expect_override_error({"title", "\xff"}, usage, {"not UTF-8"});
  std::string dots = "a";
  for (int i = 0; i < 100000; ++i) dots += ".a";
  expect_override_error({dots, "3"}, usage, {"too long"});
  const std::string brackets(100000, '[');  // not nested TOML, but a string
  EXPECT_EQ(parse_scene(orbit, "x", {{"title", brackets}}).title, brackets);
}

TEST(SceneInputErrors, OverridesAreNamedOnceAsWritten) {
  const auto message_of = [](const std::string& key, const std::string& value) -> std::string {
    try {
      parse_scene(orbit, "file.toml", {{key, value}});
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  const auto starts = [&](const std::string& key, const std::string& value,
                          const std::string& start) {
    const std::string message = message_of(key, value);
    EXPECT_EQ(message.substr(0, start.size()), start);
    // The message names neither the option nor the table again.
    EXPECT_EQ(message.find("integrator.", start.size()), std::string::npos) << message;
    EXPECT_EQ(message.find("--set", start.size()), std::string::npos) << message;
  };
  const std::string label = "--set integrator.gauss8";
  starts("integrator.gauss8.tolerance", "0", label + ".tolerance: out of range, got 0");
  starts("integrator.0.tolerance", "0", "--set integrator.0.tolerance: out of range, got 0");
  starts("integrator.gauss8.tol", "0", label + ".tol: unknown key, must be");
  starts("integrator.gauss8", "{label=\"a\", method=\"gauss\"}", label + ": missing, got none");
  starts("integrator.gauss8", "{label=\"a\", method=\"x\"}", label + ".method: unknown value");
  starts("integrator.other.step_canonical", "1e-10",
         "--set integrator.other.step_canonical: too many steps");
  starts("integrator", "[{label=\"a\", method=\"x\"}]", "--set integrator.0.method: unknown");
  starts("integrator.gauss8.x.y", "1", label + ".x.y: unknown key, got x");
  starts("jet.variables", "[\"x\", \"w\"]", "--set jet.variables.1: unknown variable");
  starts("nominal", "{}", "--set nominal: no orbit");
  starts("nominal.position_km", "[1e300, 0, 0]", "file.toml:8:1: nominal: out of range");
  // The label is printed whole, however long it is.
  const std::string longest = "integrator." + std::string(100, 'l') + ".require_relative_error";
  starts(longest, "0", "--set " + longest + ": no such element");
}

TEST(SceneInputErrors, OverrideOfAChoiceSaysHowToRemoveTheOther) {
  expect_override_error({"jet.duration_orbits", "1"}, ErrorKind::scene,
                        {"--set jet.duration_orbits: more than one key of a choice",
                         "removed by --set jet.duration_canonical=null"});
  expect_override_error({"integrator.gauss8.step_s", "1"}, ErrorKind::scene,
                        {"--set integrator.gauss8.step_s: more than one",
                         "removed by --set integrator.gauss8.tolerance=null"});
  // The hint works.
  const Scene scene =
      parse_scene(orbit, "x", {{"jet.duration_orbits", "1"}, {"jet.duration_canonical", "null"}});
  EXPECT_NE(scene.duration, 31.4);
}

TEST(SceneInputErrors, NullRemovesAKeyOrAnElement) {
  const Scene scene = parse_scene(orbit, "x",
                                  {{"integrator.gauss8", "null"},
                                   {"reference", "null"},
                                   {"generating_function", "null"},
                                   {"system.J2", "null"},
                                   {"system.radius_km", "null"}});
  ASSERT_EQ(scene.integrators.size(), 1U);
  EXPECT_EQ(scene.integrators[0].label, "other");
  EXPECT_FALSE(scene.reference.has_value());
  EXPECT_FALSE(scene.kinds.has_value());
  EXPECT_EQ(scene.system.J[2], 0);
  EXPECT_EQ(parse_scene(orbit, "x", {{"title", "\"null\""}}).title, "null");
  EXPECT_EQ(parse_scene(orbit, "x", {{"title", "\"\""}}).title, "");
  const auto usage = ErrorKind::usage;
  expect_override_error({"jet.duration_canonical", "null"}, ErrorKind::scene,
                        {"file.toml:11:1: jet: missing, got none of a choice"});
  expect_override_error({"jet.duraton_s", "null"}, usage,
                        {"nothing to remove, got no key \"duraton_s\"", "duration_s?"});
  // Keys that the table may have but does not have count as removed.
  const Scene same = parse_scene(orbit, "x",
                                 {{"jet.duration_s", "null"},
                                  {"figure", "null"},
                                  {"validity.count", "null"},
                                  {"integrator.gauss8.beta", "null"}});
  EXPECT_EQ(same.duration, parse_scene(orbit, "x", {}).duration);
  expect_override_error({"integrator.gauss8.bta", "null"}, usage, {"nothing to remove", "\"bta\""});
  expect_override_error({"a.b", "null"}, usage, {"--set a.b: nothing to remove, got no key \"a\""});
  expect_override_error({"integrator.2", "null"}, usage, {"no such element"});
  expect_override_error({"title", ""}, usage, {"--set title: empty", "null removes"});
}

class SceneFileErrors : public ::testing::Test {
 protected:
  static void expect_unreadable(const std::filesystem::path& file, const std::string& reason) {
    expect_error([&] { read_scene(file); }, ErrorKind::input_output, {file.string(), reason},
                 file.string());
  }

  const test::TemporaryDirectory temporary_directory_;
  const std::filesystem::path directory_ = temporary_directory_.path();
};

TEST_F(SceneFileErrors, NamesPathAndReason) {
  expect_unreadable(directory_ / "missing.toml", "No such file");
  expect_unreadable(directory_, "directory");
  expect_unreadable("/dev/zero", "device");
  const auto pipe = directory_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expect_unreadable(pipe, "pipe");
  const auto loop = directory_ / "loop";
  std::filesystem::create_symlink(loop, loop);
  expect_unreadable(loop, "symbolic links");
}

TEST_F(SceneFileErrors, NamesMissingPermission) {
  const auto file = directory_ / "secret.toml";
  std::ofstream(file) << orbit;
  std::filesystem::permissions(file, std::filesystem::perms::none);
  // The superuser may read everything, so that the test becomes another user for a moment.
  const uid_t user = ::geteuid();
  constexpr uid_t nobody = 65534;
  if (user == 0) {
    ASSERT_EQ(::seteuid(nobody), 0);
  }
  expect_unreadable(file, "Permission denied");
  if (user == 0) {
    ASSERT_EQ(::seteuid(user), 0);
  }
}

TEST_F(SceneFileErrors, RefusesLargeFilesUnread) {
  const auto file = directory_ / "large.toml";
  std::ofstream(file) << orbit;
  std::filesystem::resize_file(file, std::uintmax_t{1} << 30);
  expect_error([&] { read_scene(file); }, ErrorKind::scene,
               {file.string(), "too large, got 1073741824"}, "large");
}

TEST_F(SceneFileErrors, NamesFileAndLineOfAnError) {
  const auto file = directory_ / "scene.toml";
  std::ofstream(file) << changed(orbit, "order = 4", "order = 0");
  expect_error([&] { read_scene(file); }, ErrorKind::scene, {file.string() + ":12:9: jet.order: "},
               "location");
  std::ofstream(file) << orbit;
  EXPECT_EQ(read_scene(file).name, "scene");
}

}  // namespace
}  // namespace hamjet::io
