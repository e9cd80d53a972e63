#include <csignal>

#include "eval_command_test.hpp"

// What is wrong with a call of `hamjet eval`: exit code, one line, nothing left behind.

namespace hamjet::test {
namespace {

using EvalErrors = EvalTest;

TEST_F(EvalErrors, MistakesOnTheCommandLine) {
  store("kepler", quick_scene());
  const std::string one = "1,2,3,0,0,0";
  const struct {
    std::vector<std::string> arguments;
    std::vector<std::string> words;
  } mistakes[] = {
      {{}, {"directory"}},
      {{"kepler"}, {"--deviation", "--deviations"}},
      {{"", "--deviation", one}, {"directory: empty"}},
      {{"kepler", "--deviation", one, "--deviations", "a.csv"}, {"must not be given together"}},
      {{"kepler", "--deviation", "1,2,3"}, {"must be 6 numbers", "R_m,T_m,N_m", "\"1,2,3\""}},
      {{"kepler", "--deviation", "1,2,3,4,5,x"}, {"vN_m_s must be a finite number", "\"x\""}},
      {{"kepler", "--deviation", "nan,0,0,0,0,0"}, {"R_m must be a finite number"}},
      {{"kepler", "--deviation", "1e999,0,0,0,0,0"}, {"R_m must be a finite number"}},
      {{"kepler", "--deviations", ""}, {"--deviations: empty"}},
      {{"kepler", "--deviation", one, "--run", "gaus8"}, {"gaus8", "did you mean gauss8?"}},
      {{"kepler", "--deviation", one, "--run", ""}, {"--run: empty"}},
      {{"kepler", "--deviation", one, "--frame", "LVLH"},
       {"two meanings", "radially outward", "nadir", "RTN"}},
      {{"kepler", "--deviation", one, "--frame", "RTM"}, {"RTM", "did you mean RTN?"}},
      {{"kepler", "--deviation", one, "--frame", "inertial", "--derivatives", "rotating"},
       {"--derivatives", "RTN alone"}},
      {{"kepler", "--deviation", one, "--derivatives", "fixed"}, {"rotating or inertial"}},
      {{"kepler", "--deviation", one, "--degree", "3"}, {"1 to the order of the jet, 2"}},
      {{"kepler", "--deviation", one, "--degree", "0"}, {"--degree 0"}},
      {{"kepler", "--deviation", one, "--degree", "two"}, {"two"}},
      {{"kepler", "--deviation", one, "-o", ""}, {"--output: empty"}},
      {{"kepler", "--deviation", one, "--devation", one}, {"--devation", "did you mean"}},
  };
  for (const auto& mistake : mistakes) {
    std::vector<std::string> arguments = {"eval"};
    arguments.insert(arguments.end(), mistake.arguments.begin(), mistake.arguments.end());
    expect_error(arguments, 2, mistake.words);
  }
  // A number may begin with a minus sign.
  EXPECT_EQ(eval_one("kepler", "-1,2,3,0,0,0").size(), 6U);
}

TEST_F(EvalErrors, ALineWithoutEndIsNotReadToItsEnd) {
  store("kepler", quick_scene());
  std::filesystem::resize_file(write("large.csv", rtn_header), std::uintmax_t{2} << 30);
  expect_error({"eval", "kepler", "--deviations", "large.csv"}, 6,
               {"large.csv:1: a line of more than 65536 bytes", "must be a row of 6 numbers"});
  std::filesystem::resize_file(write("long.csv", rtn_header + "\n1,2,3,4,5,6\n7"), 100'000'000);
  expect_error({"eval", "kepler", "--deviations", "long.csv", "-o", "end.csv"}, 6,
               {"long.csv:3: a line of more than 65536 bytes"});
}

TEST_F(EvalErrors, ADeviceIsNotRead) {
  store("kepler", quick_scene());
  options_.address_space = std::size_t{1} << 30;
  expect_error({"eval", "kepler", "--deviations", "/dev/zero"}, 5,
               {"/dev/zero: cannot be read: it is a device, must be a file or a pipe"});
  expect_error({"eval", "/dev/zero", "--deviation", "1,2,3,0,0,0"}, 5, {"/dev/zero"});
  options_.input = "/dev/zero";
  expect_error({"eval", "kepler", "--deviations", "-"}, 6, {"standard input:1: a line of more"});
}

TEST_F(EvalErrors, BadTables) {
  store("kepler", quick_scene());
  const struct {
    std::string text;
    std::vector<std::string> words;
  } tables[] = {
      {"", {":1: the header is missing"}},
      {"1,2,3,4,5,6\n", {":1: numbers where the header must be", "R_m, T_m"}},
      {rtn_header + "\n", {":2: the file has no rows"}},
      {rtn_header, {":2: the file has no rows"}},
      {"R_m,T_m,N_m,vR_m_s,vT_m_s\n1,2,3,4,5\n", {":1: the column vN_m_s is missing"}},
      {"R_m,T_m,N_m,vR_m_s,vT_m_s,vT_m_s\n", {":1: the column vT_m_s is there twice"}},
      {"x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n1,2,3,4,5,6\n", {":1: unknown column \"x_m\""}},
      // An entry that does not look like a column is ignored.
      {"root:x:0:0:root,secret\n", {":1: unknown column 1; the columns must be"}},
      {rtn_header + "\n1,2,3,4,5,6\n1,2,3,4,5\n", {":3: has 5 columns, must have 6"}},
      {rtn_header + "\n1,2,3,4,5,6,7\n", {":2: has 7 columns"}},
      {rtn_header + "\n1,2,3,4,5,6\n\n1,2,3,4,5,6\n", {":3: has 1 columns"}},
      {rtn_header + "\n1,2,3,4,5,6\n1,2,x3,4,5,6\n", {":3: column N_m", "\"x3\""}},
      {rtn_header + "\n1,2,3,4,,6\n", {":2: column vT_m_s", "\"\""}},
      {rtn_header + "\n1,2,3,4,5 5,6\n", {":2: column vT_m_s"}},
      {rtn_header + "\nnan,2,3,4,5,6\n", {":2: column R_m: must be a finite number"}},
      {rtn_header + "\n1,inf,3,4,5,6\n", {":2: column T_m: must be a finite number"}},
      {rtn_header + "\n1,2,3,4,5,1e999\n", {":2: column vN_m_s: must be a finite number"}},
  };
  for (const auto& table : tables) {
    SCOPED_TRACE(table.text);
    write("start.csv", table.text);
    std::vector<std::string> words = table.words;
    words.emplace_back("start.csv");
    expect_error({"eval", "kepler", "--deviations", "start.csv", "-o", "end.csv"}, 5, words);
  }
}

TEST_F(EvalErrors, PlacesThatCannotBeReadOrWritten) {
  store("kepler", quick_scene());
  const std::string one = "1,2,3,0,0,0";
  expect_error({"eval", "missing", "--deviation", one}, 5,
               {"missing/summary.json", "No such file"});
  std::filesystem::copy_file(directory_ / "small.toml", directory_ / "small.text");
  expect_error({"eval", "small.text", "--deviation", one}, 5, {"neither a results directory"});
  expect_error({"eval", "kepler", "--deviations", "missing.csv"}, 5, {"missing.csv", "No such"});
  expect_error({"eval", "kepler", "--deviations", "kepler"}, 5, {"kepler", "directory"});
  expect_error({"eval", "kepler", "--deviation", one, "-o", "kepler"}, 5, {"not a regular file"});
  expect_error({"eval", "kepler", "--deviation", one, "-o", "/dev/null"}, 5,
               {"/dev/null", "not a regular file"});
  expect_error({"eval", "kepler", "--deviation", one, "-o", "small.toml/end.csv"}, 5,
               {"small.toml"});
  write("kepler/gauss8/jet.csv", "component\n");
  expect_error({"eval", "kepler", "--deviation", one}, 5, {"kepler/gauss8/jet.csv:1: the header"});
  std::filesystem::remove(directory_ / "kepler/midpoint/jet.csv");
  expect_error({"eval", "kepler", "--deviation", one, "--run", "midpoint"}, 5,
               {"kepler/midpoint/jet.csv", "No such file"});
}

TEST_F(EvalErrors, AFullDiskAndAReaderThatIsGone) {
  store("kepler", quick_scene());
  const std::vector<std::string> arguments = {"eval", "kepler", "--deviation", "1,2,3,0,0,0", "-q"};
  options_.out = Stream::full;
  const CommandResult full = hamjet(arguments);
  EXPECT_EQ(full.exit_code, 5);
  EXPECT_NE(full.err.find("standard output cannot be written"), std::string::npos) << full.err;
  options_.out = Stream::reader_gone;
  EXPECT_EQ(hamjet(arguments).exit_code, 0);
  options_.out = Stream::captured;
  options_.largest_file = 10;
  expect_error({"eval", "kepler", "--deviation", "1,2,3,0,0,0", "-o", "end.csv"}, 5, {"end.csv"});
}

TEST_F(EvalErrors, Interrupted) {
  store("kepler", quick_scene());
  std::string text = rtn_header + "\n";
  const std::string row = "1.2345678,2.3456789,3.4567891,0.012345,0.0234567,0.0345678\n";
  for (int i = 0; i < 2'000'000; ++i) text += row;
  write("start.csv", text);
  const auto before = files();
  options_.signal = Signal{SIGINT};
  const CommandResult result =
      hamjet({"eval", "kepler", "--deviations", "start.csv", "-o", "end.csv"});
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_EQ(result.err, "hamjet: interrupted; nothing was written\n");
  EXPECT_EQ(files(), before);
}

TEST_F(EvalErrors, IndependentOfTheLocale) {
  store("kepler", quick_scene());
  const std::string plain = succeed({"eval", "kepler", "--deviation", "1.5,2,3,0,0,0", "-q"}).out;
  options_.environment = {{"LC_ALL", "de_DE.UTF-8"}};
  EXPECT_EQ(succeed({"eval", "kepler", "--deviation", "1.5,2,3,0,0,0", "-q"}).out, plain);
}

}  // namespace
}  // namespace hamjet::test
