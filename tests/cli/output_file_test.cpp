#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <thread>

#include "command_test.hpp"

// The one file that eval, convert and init write: what is planted in its folder, what is there
// already, and what an end at any moment leaves.

namespace hamjet::test {
namespace {

namespace fs = std::filesystem;

class OutputFiles : public CommandTest {
 protected:
  OutputFiles() {
    succeed({"run", "quick.toml", "-q", "-o", "results"});
    fs::create_directory(directory_ / "shared");
  }

  /// Runs each command that writes one file, into the folder `shared`.
  static std::vector<std::vector<std::string>> commands() {
    return {{"eval", "results", "--deviation", "1,2,3,0,0,0", "-q", "-o", "shared/x.csv"},
            {"convert", "results", "shared/x.csv"},
            {"init", "leo", "-o", "shared/x.csv"}};
  }

  /// Enough deviations for a second of work.
  void write_deviations() const {
    std::string text = "R_m,T_m,N_m,vR_m_s,vT_m_s,vN_m_s\n";
    for (int i = 0; i < 300'000; ++i) text += "1.5,2.5,3.5,0.01,0.02,0.03\n";
    write("start.csv", text);
  }

  std::size_t files_in_shared() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(directory_ / "shared"), fs::directory_iterator()));
  }
};

// The names of temporary files used to consist of machine and process, which anybody can guess.
TEST_F(OutputFiles, LinksThatArePlantedForThemAreNotFollowed) {
  write("victim", "precious");
  std::array<char, 64> host{};
  ::gethostname(host.data(), host.size() - 1);
  constexpr int processes = 300;
  for (const auto& command : commands()) {
    SCOPED_TRACE(command[0]);
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    ::waitpid(child, nullptr, 0);
    for (int i = 1; i <= processes; ++i) {
      const std::string process = std::to_string(child + i);
      for (const std::string& name : {"x.csv." + std::string(host.data()) + "-" + process + ".tmp",
                                      ".hamjet-" + process + ".tmp"}) {
        fs::create_symlink("../victim", directory_ / "shared" / name);
      }
    }
    EXPECT_EQ(hamjet(command).exit_code, 0);
    EXPECT_EQ(content(directory_ / "victim"), "precious");
    EXPECT_FALSE(fs::is_symlink(directory_ / "shared/x.csv"));
    EXPECT_EQ(files_in_shared(), 2U * processes + 1);
    fs::remove_all(directory_ / "shared");
    fs::create_directory(directory_ / "shared");
  }
}

TEST_F(OutputFiles, ALinkInTheirPlaceIsRefused) {
  write("victim", "precious");
  fs::create_symlink("../victim", directory_ / "shared/x.csv");
  for (const auto& command : commands()) {
    const char* why =
        command[0] == "init" ? "is there already" : "it is a symbolic link to ../victim";
    expect_error(command, 5, {"shared/x.csv: ", why});
    EXPECT_TRUE(fs::is_symlink(directory_ / "shared/x.csv"));
    EXPECT_EQ(content(directory_ / "victim"), "precious");
  }
}

TEST_F(OutputFiles, OneOfEightInitsAtOnceWrites) {
  // The cases of a file system that can rename without replacing, and of one that cannot.
  for (const char* preload : {"", HAMJET_FAILING_CALLS}) {
#if defined(__SANITIZE_ADDRESS__)
    if (*preload != '\0') continue;  // the address sanitizer has to be loaded first
#endif
    for (int round = 0; round < 3; ++round) {
      CommandOptions options = options_;
      options.environment = {{"LD_PRELOAD", preload},
                             {"HAMJET_NO_EXCLUSIVE_RENAME", "1"},
                             {"HAMJET_NO_UNNAMED_FILES", "1"}};
      std::array<CommandResult, 8> results;
      std::vector<std::thread> threads;
      for (CommandResult& result : results) {
        threads.emplace_back([&] {
          result = run_command({"init", "leo", "-o", "shared/x.toml"}, options);
        });
      }
      for (std::thread& thread : threads) thread.join();
      int written = 0;
      for (const CommandResult& result : results) {
        if (result.exit_code == 0) {
          ++written;
        } else {
          EXPECT_EQ(result.exit_code, 5);
          EXPECT_NE(result.err.find("shared/x.toml: is there already"), std::string::npos)
              << result.err;
        }
      }
      EXPECT_EQ(written, 1);
      EXPECT_EQ(files_in_shared(), 1U);
      fs::remove(directory_ / "shared/x.toml");
    }
  }
}

TEST_F(OutputFiles, AKillLeavesNothingOfThem) {
  write_deviations();
  for (const int milliseconds : {20, 60, 120, 200}) {
    options_.kill = Kill{std::chrono::milliseconds(milliseconds)};
    const CommandResult result =
        hamjet({"eval", "results", "--deviations", "start.csv", "-q", "-o", "shared/x.csv"});
    // Either nothing is there, or everything if the signal came too late.
    if (result.signal == SIGKILL && !fs::exists(directory_ / "shared/x.csv")) {
      EXPECT_EQ(files_in_shared(), 0U) << milliseconds;
    }
  }
}

// The files then have a hidden name while they are written.
TEST_F(OutputFiles, ASignalLeavesNothingOfThemWhereFilesMustHaveNames) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer has to be loaded first";
#else
  write_deviations();
  const std::vector<std::string> command = {"eval", "results", "--deviations", "start.csv",
                                            "-q",   "-o",      "new/x.csv"};
  options_.environment = {{"LD_PRELOAD", HAMJET_FAILING_CALLS}, {"HAMJET_NO_UNNAMED_FILES", "1"}};
  const auto before = files();
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM}) {
    options_.signal = Signal{signal, 2, std::chrono::milliseconds(0), directory_ / "new"};
    const CommandResult result = hamjet(command);
    if (result.exit_code == 0) continue;  // the whole work took no longer than the signal
    EXPECT_EQ(result.exit_code, 128 + signal);
    EXPECT_EQ(files(), before);
  }
  options_.signal.reset();
  succeed(command);
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_ / "new"), fs::directory_iterator()), 1);
#endif
}

// Nobody but the owner could read it if the mode were that of files for temporary use.
TEST_F(OutputFiles, CanBeReadByAllWhomTheUmaskAllows) {
  const mode_t before = ::umask(022);
  for (const auto& command : commands()) {
    EXPECT_EQ(hamjet(command).exit_code, 0);
    EXPECT_EQ(fs::status(directory_ / "shared/x.csv").permissions(), fs::perms(0644)) << command[0];
    fs::remove(directory_ / "shared/x.csv");
  }
  ::umask(before);
}

}  // namespace
}  // namespace hamjet::test
