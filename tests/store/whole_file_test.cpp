#include "store/whole_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <set>
#include <thread>
#include <vector>

#include "store/spooled_text.hpp"
#include "support/errors.hpp"
#include "support/temporary_directory.hpp"

// A file exists whole or not at all, and foreign files in its place stay as they are.

namespace hamjet::io {
namespace {

namespace fs = std::filesystem;

class WholeFiles : public ::testing::Test {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      found.push_back(entry.path().filename().string());
    }
    return found;
  }

  const test::TemporaryDirectory temporary_;
  const fs::path folder_ = temporary_.path();
};

TEST_F(WholeFiles, AreSeenAtTheEndAlone) {
  test::put(folder_ / "x", "before");
  {
    WholeFile file(folder_ / "x");
    file.write("after");
    EXPECT_EQ(test::content(folder_ / "x"), "before");
  }
  EXPECT_EQ(names(), std::vector<std::string>{"x"});
  WholeFile file(folder_ / "x");
  file.write("af");
  file.write("ter");
  file.replace(Flush::yes);
  EXPECT_EQ(test::content(folder_ / "x"), "after");
  EXPECT_EQ(names(), std::vector<std::string>{"x"});
}

TEST_F(WholeFiles, LeaveNoFolderWithoutTheFile) {
  {
    WholeFile file(folder_ / "a/b/x");
    file.write("half");
  }
  EXPECT_EQ(names(), std::vector<std::string>{});
}

// The names of this machine and of this process are public.
TEST_F(WholeFiles, WriteThroughNoLinkThatWasPlantedForThem) {
  test::put(folder_ / "victim", "precious");
  std::array<char, 64> host{};
  ::gethostname(host.data(), host.size() - 1);
  const std::string process = std::to_string(::getpid());
  const std::vector<std::string> planted = {
      "x." + std::string(host.data()) + "-" + process + ".tmp", ".hamjet-" + process + ".tmp"};
  for (const std::string& name : planted) fs::create_symlink("victim", folder_ / name);
  require_writable(folder_);
  write_whole_file(folder_ / "x", "text");
  replace_sealed_file(folder_ / "x", "text");
  EXPECT_EQ(test::content(folder_ / "victim"), "precious");
  EXPECT_EQ(test::content(folder_ / "x"), "text");
  for (const std::string& name : planted) EXPECT_TRUE(fs::is_symlink(folder_ / name));
}

TEST_F(WholeFiles, HaveNamesThatNobodyForetells) {
  std::set<fs::path> names;
  for (int i = 0; i < 100; ++i) names.insert(temporary_in(folder_));
  EXPECT_EQ(names.size(), 100U);
  EXPECT_TRUE(temporary_writer(*names.begin())->is_running);
}

TEST_F(WholeFiles, DoNotTakeThePlaceOfALink) {
  test::put(folder_ / "target", "precious");
  fs::create_symlink("target", folder_ / "x");
  fs::create_symlink("nowhere", folder_ / "dangling");
  for (const char* name : {"x", "dangling"}) {
    test::expect_error([&] { write_whole_file(folder_ / name, "text"); }, ErrorKind::input_output,
                       {name, "it is a symbolic link to "}, name);
    EXPECT_TRUE(fs::is_symlink(folder_ / name));
  }
  EXPECT_EQ(test::content(folder_ / "target"), "precious");
  EXPECT_FALSE(fs::exists(folder_ / "nowhere"));
}

TEST_F(WholeFiles, OneOfManyThatAreWrittenAtOnceIsNew) {
  constexpr std::size_t count = 8;
  std::array<bool, count> is_put{};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < count; ++i) {
    threads.emplace_back([&, i] {
      WholeFile file(folder_ / "x");
      file.write(std::to_string(i));
      is_put[i] = file.put_where_nothing_is();
    });
  }
  for (std::thread& thread : threads) thread.join();
  std::vector<std::string> winners;
  for (std::size_t i = 0; i < count; ++i) {
    if (is_put[i]) winners.push_back(std::to_string(i));
  }
  EXPECT_EQ(winners, std::vector<std::string>{test::content(folder_ / "x")});
  EXPECT_EQ(names(), std::vector<std::string>{"x"});
}

TEST_F(WholeFiles, ADanglingLinkIsSomething) {
  WholeFile file(folder_ / "x");
  fs::create_symlink("nowhere", folder_ / "x");
  EXPECT_FALSE(file.put_where_nothing_is());
  EXPECT_FALSE(fs::exists(folder_ / "nowhere"));
}

TEST(SpooledTexts, AreHandedOutAsTheyCame) {
  for (const std::size_t pieces : {0U, 3U, 40U}) {
    SpooledText text;
    std::string expected;
    for (std::size_t i = 0; i < pieces; ++i) {
      const std::string piece(1'000'000 + i, static_cast<char>('a' + i % 26));
      text.add(piece);
      expected += piece;
    }
    std::string found;
    text.hand_out([&](const std::string& piece) { found += piece; });
    EXPECT_TRUE(found == expected) << pieces;
  }
}

}  // namespace
}  // namespace hamjet::io
