#include "../command_test.hpp"

// Results that have nowhere to go, and files that may not be read or written. Rows of the table at
// the head of bad_input_test.cpp.

namespace hamjet::test {
namespace {

using BadOutput = CommandTest;

TEST_F(BadOutput, IsAFileOrBelowOne) {
  expect_error({"run", "small.toml", "-o", "small.toml"}, 5, {"small.toml: the output directory"});
  expect_error({"run", "small.toml", "-o", "small.toml/x/y"}, 5, {"small.toml/x/y: the output"});
  expect_error({"run", "small.toml", "-o", "/proc/nothing/here"}, 5, {"/proc/nothing/here: "});
  EXPECT_EQ(content(directory_ / "small.toml"), small_scene);
}

TEST_F(BadOutput, HasADirectoryWhereAFileShouldGo) {
  std::filesystem::create_directories(directory_ / "results/summary.json");
  expect_error({"run", "quick.toml", "-o", "results"}, 5, {"summary.json: ", "is a directory"});
}

TEST_F(BadOutput, TakesNoMoreBytes) {
  // A limit on the size of files stands for a full disk: the write fails in the same place.
  for (const rlim_t bytes : {rlim_t{0}, rlim_t{1000}, rlim_t{9000}}) {
    options_.largest_file = bytes;
    expect_error({"run", "quick.toml", "-o", "a/b"}, 5, {"a/b/", "bytes left", "File too large"});
  }
}

TEST_F(BadOutput, StandardOutputIsFull) {
  if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "no /dev/full here";
  options_.out = Stream::full;
  const std::vector<std::string> reason = {"standard output cannot be written", "No space left"};
  for (const char* what : {"systems", "integrators", "kinds"}) {
    expect_error({"list", what}, 5, reason);
  }
  expect_error({"--help"}, 5, reason);
  expect_error({"--version"}, 5, reason);
  expect_error({"check", "small.toml"}, 5, reason);
  EXPECT_EQ(hamjet({"run", "quick.toml", "--json"}).exit_code, 5);
}

TEST_F(BadOutput, StandardOutputIsClosed) {
  options_.out = Stream::closed;
  const std::vector<std::string> reason = {"standard output cannot be written: it is closed"};
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"list", "kinds"}, {"--help"}, {"check", "small.toml"}}) {
    expect_error(arguments, 5, reason);
  }
  EXPECT_EQ(hamjet({"run", "quick.toml", "--json"}).exit_code, 5);
  EXPECT_EQ(hamjet({"run", "quick.toml"}).exit_code, 5);
  // The results themselves are there, and without anything to print all is well.
  EXPECT_EQ(hamjet({"eval", "out/quick", "--deviation", "1,2,3,0,0,0"}).exit_code, 5);
  EXPECT_EQ(hamjet({"eval", "out/quick", "--deviation", "1,2,3,0,0,0", "-o", "x.csv"}).exit_code,
            0);
}

TEST_F(BadOutput, StandardOutputHasNoReader) {
  options_.out = Stream::reader_gone;
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"list", "kinds"}, {"--help"}, {"run", "quick.toml", "--json"}}) {
    const CommandResult result = hamjet(arguments);
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(result.exit_code, 0);
  }
  EXPECT_TRUE(std::filesystem::exists(directory_ / "out/quick/summary.json"));
}

TEST_F(BadOutput, StandardErrorTakesNothing) {
  for (const Stream stream : {Stream::closed, Stream::full, Stream::reader_gone}) {
    options_.err = stream;
    // The exit code is all that is left to tell.
    EXPECT_EQ(hamjet({"run", "missing.toml"}).exit_code, 5);
    EXPECT_EQ(hamjet({"run"}).exit_code, 2);
    EXPECT_EQ(hamjet({}).exit_code, 2);
    EXPECT_EQ(hamjet({"run", "quick.toml", "-q"}).exit_code, 0);
  }
}

TEST_F(BadOutput, WithBothStreamsClosedTheFilesAreStillRight) {
  succeed({"run", "quick.toml", "-o", "open", "-q"});
  options_.out = options_.err = Stream::closed;
  // The descriptors 1 and 2 are then free for files that the command opens.
  EXPECT_EQ(hamjet({"run", "quick.toml", "-o", "closed", "-q"}).exit_code, 0);
  EXPECT_EQ(content(directory_ / "open/gauss8/jet.csv"),
            content(directory_ / "closed/gauss8/jet.csv"));
}

TEST_F(BadOutput, WithNoStreamsAtAllTheResultsAreWhole) {
  options_.has_input = false;
  options_.out = options_.err = Stream::closed;
  // Without -q: what would be printed has no place to go, and must not end in a file of the
  // results.
  EXPECT_EQ(hamjet({"run", "quick.toml", "-o", "closed"}).exit_code, 5);
  EXPECT_EQ(hamjet({"run", "missing.toml"}).exit_code, 5);
  options_ = {};
  options_.directory = directory_;
  succeed({"run", "quick.toml", "-o", "open", "-q"});
  EXPECT_EQ(content(directory_ / "open/gauss8/jet.csv"),
            content(directory_ / "closed/gauss8/jet.csv"));
  EXPECT_EQ(read_json(directory_ / "closed/summary.json")["exit_code"], 0);
}

/// Permissions keep out everybody but the superuser, who becomes somebody else for these.
class Permissions : public CommandTest {
 protected:
  void SetUp() override {
    options_.as_nobody = ::geteuid() == 0;
    std::filesystem::permissions(directory_, std::filesystem::perms(0755));
    if (hamjet({"--version"}).exit_code == cannot_start) {
      GTEST_SKIP() << "the command cannot be run by another user here";
    }
  }
};

TEST_F(Permissions, SceneMayNotBeRead) {
  std::filesystem::permissions(directory_ / "small.toml", std::filesystem::perms::none);
  expect_error({"run", "small.toml"}, 5, {"small.toml: ", "Permission denied"});
}

TEST_F(Permissions, OutputMayNotBeWritten) {
  std::filesystem::permissions(directory_, std::filesystem::perms(0555));
  expect_error({"run", "quick.toml"}, 5, {"out/quick: the output directory", "Permission denied"});
  std::filesystem::permissions(directory_, std::filesystem::perms(0755));
  std::filesystem::create_directory(directory_ / "results");
  std::filesystem::permissions(directory_ / "results", std::filesystem::perms(0555));
  expect_error({"run", "quick.toml", "-o", "results"}, 5, {"results", "Permission denied"});
  std::filesystem::permissions(directory_ / "results", std::filesystem::perms(0755));
}

}  // namespace
}  // namespace hamjet::test
