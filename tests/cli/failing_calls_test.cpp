#include <csignal>

#include "two_results.hpp"

// Every call that writes to the disk fails once, as on a full disk: the command says so with exit
// code 5, and a later hamjet finds the old results or the new ones whole.

namespace hamjet::test {
namespace {

class FailingCalls : public TwoResults {
 protected:
  /// Lets each call of this name fail in turn until there is none left; returns how many there are.
  int fail_each(const std::string& name) {
    int present = found();
    for (int number = 1;; ++number) {
      const std::string call = fmt::format("{}:{}", name, number);
      SCOPED_TRACE(call);
      options_.environment = {{"LD_PRELOAD", HAMJET_FAILING_CALLS}, {"HAMJET_FAILING_CALL", call}};
      const CommandResult result = hamjet(command(1 - present, results));
      options_.environment.clear();
      if (result.exit_code == 0) return number - 1;
      EXPECT_EQ(result.exit_code, 5);
      EXPECT_EQ(result.out, "");
      EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
      EXPECT_NE(result.err.find("hamjet: results"), std::string::npos) << result.err;
      EXPECT_NE(result.err.find("No space left on device"), std::string::npos) << result.err;
      EXPECT_FALSE(std::filesystem::exists(directory_ / results / ".hamjet-lock"));
      EXPECT_FALSE(std::filesystem::exists(directory_ / results / ".hamjet-new"));
      present = found();
      // The renaming of one file may fail after the decision; the next command completes it.
      if (name != "rename") {
        EXPECT_EQ(present, 0);
      }
      if (HasFailure() || number == 1000) return number;
    }
  }

  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the address sanitizer has to be loaded first";
#else
    make_results();
#endif
  }
};

// The second results are the summary, jet and nominal of two runs, and one generating function of
// each: seven files, in two folders.
TEST_F(FailingCalls, Open) { EXPECT_EQ(fail_each("open"), 7); }
TEST_F(FailingCalls, Write) { EXPECT_EQ(fail_each("write"), 7); }
TEST_F(FailingCalls, Flush) { EXPECT_EQ(fail_each("fsync"), 7); }
TEST_F(FailingCalls, Close) { EXPECT_EQ(fail_each("close"), 7); }
TEST_F(FailingCalls, MakeFolder) { EXPECT_GE(fail_each("mkdir"), 5); }
TEST_F(FailingCalls, Rename) { EXPECT_GE(fail_each("rename"), 8); }

// The program ends even if a disk does not answer.
TEST_F(FailingCalls, SignalsWhileTheDiskHangs) {
  int while_writing = 0;
  for (const int times : {1, 2}) {
    options_.environment = {{"LD_PRELOAD", HAMJET_FAILING_CALLS},
                            {"HAMJET_FAILING_CALL", "stall:4"}};
    options_.signal = Signal{SIGINT, times, std::chrono::milliseconds(1500)};
    options_.limit = std::chrono::seconds(20);
    const CommandResult result = hamjet(command(1, results));
    EXPECT_EQ(result.exit_code, 130);
    EXPECT_EQ(result.err.rfind("hamjet: interrupted", 0), 0U) << result.err;
    // On a slow machine the signal may come before the writing begins.
    while_writing += result.err.find(
                         " while the results were written; they are there, whole, or what was "
                         "there before\n") != std::string::npos;
    options_.environment.clear();
    options_.signal.reset();
    EXPECT_FALSE(std::filesystem::exists(directory_ / results / ".hamjet-lock"));
    EXPECT_EQ(found(), 0);
  }
  EXPECT_GE(while_writing, 1);
}

}  // namespace
}  // namespace hamjet::test
