#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/statvfs.h>

#include <atomic>
#include <map>
#include <random>
#include <thread>

#include "command_test.hpp"

// What happens around the command while it works: another run in the same directory, a directory
// that vanishes, a disk that fills, a scene that changes while it is read, results that are changed
// afterwards.

namespace hamjet::test {
namespace {

namespace fs = std::filesystem;

class Faults : public CommandTest {
 protected:
  /// Runs a command beside the test until it ends, or until finish() stops it because it would take
  /// too long.
  void start(const std::vector<std::string>& arguments) {
    CommandOptions options = options_;
    options.kill = Kill{std::chrono::microseconds(0), directory_ / "stop"};
    beside_ = std::thread([=, this] { result_ = run_command(arguments, options); });
  }

  CommandResult finish() {
    beside_.join();
    return result_;
  }

  CommandResult kill_and_finish() {
    write("stop", "");
    beside_.join();
    fs::remove(directory_ / "stop");
    return result_;
  }

  /// The process that has locked the directory, once there is one.
  static std::string holder(const fs::path& directory) {
    const fs::path file = directory / ".hamjet-lock";
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < deadline) {
      if (fs::exists(file)) {
        const std::string text = content(file);
        if (text.ends_with('\n')) return text.substr(0, text.size() - 1);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ADD_FAILURE() << "nobody has locked " << directory;
    return "";
  }

  std::map<std::string, std::string> contents(const fs::path& directory) const {
    std::map<std::string, std::string> result;
    for (const auto& entry : fs::recursive_directory_iterator(directory)) {
      const std::string name = entry.path().lexically_relative(directory).string();
      result[name] = entry.is_directory() ? "" : content(entry.path());
    }
    return result;
  }

 private:
  std::thread beside_;
  CommandResult result_;
};

// 100 million steps.
const std::vector<std::string> endless = {"run", "quick.toml", "--set",
                                          "integrator.midpoint.step_canonical=1e-8"};

/// The run takes a second or so.
const std::vector<std::string> second_or_so = {"run", "quick.toml", "--set",
                                               "integrator.midpoint.step_canonical=1e-5"};

TEST_F(Faults, ASecondRunInTheSameDirectoryIsRefusedAtOnce) {
  start(endless);
  const std::string process = holder(directory_ / "out/quick");
  const std::vector<std::string> words = {"out/quick: the output directory is in use",
                                          "process " + process + ";"};
  expect_error({"run", "quick.toml"}, 5, words);
  expect_error({"run", "quick.toml", "-o", "./out/../out/quick/"}, 5, {"process " + process});
  expect_error({"compare", "quick.toml"}, 5, words);
  expect_error({"compare", "quick.toml", "--resume"}, 5, words);
  expect_error({"run", std::string(HAMJET_SOURCE_DIR) + "/data/scenes/paper/double-well.toml", "-o",
                "out/quick"},
               5, words);
  succeed({"run", "quick.toml", "-o", "elsewhere", "-q"});
  EXPECT_EQ(kill_and_finish().signal, 9);
  // The lock of a process that was killed is free, although its file still exists.
  EXPECT_TRUE(fs::exists(directory_ / "out/quick/.hamjet-lock"));
  succeed({"run", "quick.toml", "-q"});
  EXPECT_FALSE(fs::exists(directory_ / "out/quick/.hamjet-lock"));
}

TEST_F(Faults, OneOfManyRunsAtTheSameMomentWins) {
  std::vector<std::thread> runs;
  std::vector<CommandResult> results(6);
  for (CommandResult& result : results) {
    runs.emplace_back([&] { result = run_command({"run", "quick.toml", "-q"}, options_); });
  }
  for (std::thread& run : runs) run.join();
  std::size_t good = 0;
  for (const CommandResult& result : results) {
    good += result.exit_code == 0 ? 1 : 0;
    if (result.exit_code == 0) continue;
    EXPECT_EQ(result.exit_code, 5);
    EXPECT_NE(result.err.find("is in use"), std::string::npos) << result.err;
  }
  EXPECT_GE(good, 1U);
  EXPECT_FALSE(fs::exists(directory_ / "out/quick/.hamjet-lock"));
  succeed({"run", "quick.toml", "-q", "-o", "alone"});
  EXPECT_EQ(content(directory_ / "out/quick/midpoint/jet.csv"),
            content(directory_ / "alone/midpoint/jet.csv"));
}

TEST_F(Faults, ADirectoryThatVanishesDuringTheRunIsMadeAnew) {
  start(second_or_so);
  holder(directory_ / "out/quick");
  fs::remove_all(directory_ / "out");
  EXPECT_EQ(finish().exit_code, 0);
  EXPECT_EQ(hamjet({"eval", "out/quick", "--deviation", "1,2,3,0,0,0"}).exit_code, 0);
}

TEST_F(Faults, ADirectoryThatBecomesAFileDuringTheRun) {
  start(second_or_so);
  holder(directory_ / "out/quick");
  fs::remove_all(directory_ / "out/quick");
  write("out/quick", "mine");
  const CommandResult result = finish();
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_NE(result.err.find("out/quick: the output directory cannot be created"), std::string::npos)
      << result.err;
  EXPECT_EQ(content(directory_ / "out/quick"), "mine");
}

/// A disk of its own for the results, whose size can be changed.
class SmallDisk : public Faults {
 protected:
  void SetUp() override {
    fs::create_directory(disk_);
    const bool is_there =
        ::geteuid() == 0 && ::unshare(CLONE_NEWNS) == 0 &&
        ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
        ::mount("none", disk_.c_str(), "tmpfs", 0, "size=64m,nr_inodes=10000") == 0;
    if (!is_there) GTEST_SKIP() << "no disk can be mounted here";
    is_mounted_ = true;
  }

  void TearDown() override {
    if (is_mounted_) ::umount(disk_.c_str());
  }

  struct statvfs status() const {
    struct statvfs result {};
    EXPECT_EQ(::statvfs(disk_.c_str(), &result), 0);
    return result;
  }

  void resize(const std::string& option) const {
    ASSERT_EQ(::mount("none", disk_.c_str(), "tmpfs", MS_REMOUNT, option.c_str()), 0) << option;
  }

  /// With too little space nothing changes; returns whether the space was enough.
  bool run_with_little_space() const {
    const auto before = contents(disk_);
    const CommandResult result =
        hamjet({"run", "quick.toml", "-q", "-o", "disk/results", "--set", "jet.order=3"});
    if (result.exit_code == 0) return true;
    EXPECT_EQ(result.exit_code, 5);
    EXPECT_NE(result.err.find("disk/results"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("No space left on device"), std::string::npos) << result.err;
    EXPECT_EQ(contents(disk_), before);
    return false;
  }

  const fs::path disk_ = directory_ / "disk";
  bool is_mounted_ = false;
};

TEST_F(SmallDisk, FullAtAnyBlock) {
  succeed({"run", "quick.toml", "-q", "-o", "disk/results"});
  const auto used = status().f_blocks - status().f_bfree;
  std::size_t blocks = 0;
  for (bool is_enough = false; !is_enough; ++blocks) {
    resize("size=" + std::to_string((used + blocks) * status().f_frsize));
    is_enough = run_with_little_space();
  }
  // Two jets of some 15 000 bytes each are among what was written.
  EXPECT_GT(blocks, 8U);
  EXPECT_EQ(hamjet({"eval", "disk/results", "--deviation", "1,2,3,0,0,0"}).exit_code, 0);
}

TEST_F(SmallDisk, FullAtAnyFile) {
  succeed({"run", "quick.toml", "-q", "-o", "disk/results"});
  const auto used = status().f_files - status().f_ffree;
  std::size_t files = 0;
  for (bool is_enough = false; !is_enough; ++files) {
    resize("nr_inodes=" + std::to_string(used + files));
    is_enough = run_with_little_space();
  }
  // There are at least nine files.
  EXPECT_GT(files, 8U);
}

TEST_F(Faults, ASceneThatGrowsWhileItIsReadIsRefused) {
  const std::string scene = quick_scene() + "#" + std::string(500'000, '-');
  const fs::path file = write("growing.toml", scene);
  const std::string right = succeed({"check", "growing.toml"}).out;
  std::atomic<bool> is_over = false;
  std::thread writer([&] {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    for (int i = 1; !is_over; ++i) {
      // The size is never above the largest size of a scene.
      if (i % 100'000 == 0) fs::resize_file(file, scene.size());
      EXPECT_EQ(::write(descriptor, "-", 1), 1);
    }
    ::close(descriptor);
  });
  int refused = 0;
  for (int i = 0; i < 30; ++i) {
    const CommandResult result = hamjet({"check", "growing.toml"});
    if (result.exit_code == 0) {
      EXPECT_EQ(result.out, right);
      continue;
    }
    ++refused;
    EXPECT_EQ(result.exit_code, 5);
    EXPECT_EQ(result.err,
              "hamjet: growing.toml: the scene cannot be read: it changed meanwhile; run again "
              "when it is saved\n");
  }
  is_over = true;
  writer.join();
  EXPECT_GE(refused, 1);
}

TEST_F(Faults, ASceneThatIsReplacedWhileItIsReadIsTheOldOrTheNewOne) {
  const std::string scenes[] = {quick_scene(), changed(quick_scene(), "order = 2", "order = 3")};
  std::vector<std::string> right;
  for (const std::string& scene : scenes) {
    write("replaced.toml", scene);
    right.push_back(succeed({"check", "replaced.toml"}).out);
  }
  ASSERT_NE(right[0], right[1]);
  std::atomic<bool> is_over = false;
  std::thread editor([&] {
    for (std::size_t i = 0; !is_over; ++i) {
      write("new.toml", scenes[i % 2]);
      fs::rename(directory_ / "new.toml", directory_ / "replaced.toml");
    }
  });
  for (int i = 0; i < 20; ++i) {
    const std::string text = succeed({"check", "replaced.toml"}).out;
    EXPECT_TRUE(text == right[0] || text == right[1]) << text;
  }
  is_over = true;
  editor.join();
}

class ChangedResults : public Faults {
 protected:
  /// The command must refuse the file after any one bit of it has been flipped, or after it was cut
  /// anywhere (at places of a fixed sequence), and accept it as it was.
  void expect_noticed(const fs::path& file, const std::vector<std::string>& arguments) {
    const std::string good = content(file);
    std::mt19937 random(1);
    for (int i = 0; i < 20; ++i) {
      const std::size_t place = random() % good.size();
      std::string bad = good;
      bad[place] = static_cast<char>(bad[place] ^ (1 << (random() % 8)));
      for (const std::string& text : {bad, good.substr(0, place)}) {
        std::ofstream(file, std::ios::binary) << text;
        SCOPED_TRACE(place);
        expect_error(arguments, 5, {file.filename().string()});
      }
    }
    std::ofstream(file, std::ios::binary) << good;
    EXPECT_EQ(hamjet(arguments).exit_code, 0);
  }
};

TEST_F(ChangedResults, OfARun) {
  succeed({"run", "quick.toml", "-q"});
  const std::vector<std::string> eval = {"eval", "out/quick", "--deviation", "1,2,3,0,0,0"};
  const std::vector<std::string> transfer = {
      "transfer",
      "quick.toml",
      "-q",
      "--jet",
      "out/quick",
      "-o",
      "transfers",
      "--set",
      "transfer={frame=\"RTN\", times_s=[1200], start={position_m=[0, -1000, 0]}, "
      "end={position_m=[0, -100, 0]}}"};
  EXPECT_EQ(hamjet(transfer).exit_code, 0);
  for (const auto& command : {eval, transfer}) {
    expect_noticed(directory_ / "out/quick/summary.json", command);
    expect_noticed(directory_ / "out/quick/gauss8/jet.csv", command);
  }
}

TEST_F(ChangedResults, OfAComparison) {
  options_.environment = {{"XDG_CACHE_HOME", (directory_ / "cache").string()},
                          {"PATH", "/nowhere"}};
  const std::vector<std::string> compare = {
      "compare", "quick.toml", "-q", "--set",
      "compare={methods=[\"gauss\"], stages=[4], steps_canonical=[0.4], tolerances=[1e-5], "
      "orders=[1], repeats=1, time_budget_s=10}"};
  ASSERT_EQ(hamjet(compare).exit_code, 0);
  std::vector<std::string> resume = compare;
  resume.emplace_back("--resume");
  expect_noticed(directory_ / "out/quick/compare.json", resume);
}

}  // namespace
}  // namespace hamjet::test
