#include "hamjet/store/output_directory.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "../../src/store/sealed_summary.hpp"
#include "hamjet/error.hpp"
#include "store/result_set.hpp"
#include "support/errors.hpp"
#include "support/temporary_directory.hpp"

// Sets of results exist whole or not at all, and a changed set is noticed.

namespace hamjet::io {
namespace {

namespace fs = std::filesystem;

class ResultSets : public ::testing::Test {
 protected:
  using Files = std::map<std::string, std::string>;

  std::string commit(const Files& files, const std::string& summary = "{\n  \"a\": 1\n}\n") const {
    OutputDirectory output(directory_);
    for (const auto& [path, text] : files) output.write(path, text);
    output.write("summary.json", summary);
    return output.commit();
  }

  /// The contents of the directory, without the summary.
  Files found() const {
    Files files;
    for (const auto& entry : fs::recursive_directory_iterator(directory_)) {
      const std::string path = entry.path().lexically_relative(directory_).string();
      if (!entry.is_directory() && path != "summary.json")
        files[path] = test::content(entry.path());
    }
    return files;
  }

  void verify(const Files& files) const {
    ResultSet set(directory_, "summary.json");
    for (const auto& [path, text] : files) EXPECT_EQ(set.read(path), text);
    set.verify();
  }

  void expect_refused(const Files& files, const std::vector<std::string>& words) const {
    test::expect_error([&] { verify(files); }, ErrorKind::input_output, words, words[0]);
  }

  /// A committed set is refused with each of the damaged texts in place of a file's own.
  void expect_noticed(const std::function<std::vector<std::string>(const std::string&)>& damaged) {
    commit(new_);
    for (const char* name : {"summary.json", "a/x.csv"}) {
      const std::string good = test::content(directory_ / name);
      const std::vector<std::string> bad = damaged(good);
      for (std::size_t i = 0; i < bad.size(); ++i) {
        test::put(directory_ / name, bad[i]);
        ResultSet set(directory_, "summary.json");
        set.read("a/x.csv");
        EXPECT_THROW(set.verify(), Error) << name << " " << i;
      }
      test::put(directory_ / name, good);
    }
    verify(new_);
  }

  const test::TemporaryDirectory temporary_;
  const fs::path directory_ = temporary_.path() / "results";
  const Files old_ = {{"a/x.csv", "old x"}, {"a/y.csv", "old y"}, {"b/z.csv", "old z"}};
  const Files new_ = {{"a/x.csv", "new x"}, {"c/d/w.csv", "new w"}};
};

// The check value of CRC-32, that of the nine digits (the catalogue of parametrised CRC algorithms,
// CRC-32/ISO-HDLC).
TEST_F(ResultSets, AreDescribedByTheirSummary) {
  const std::string summary = commit({{"a/digits.txt", "123456789"}});
  EXPECT_EQ(test::content(directory_ / "summary.json"), summary);
  const auto json = nlohmann::json::parse(summary);
  EXPECT_EQ(json["a"], 1);
  ASSERT_EQ(json["files"].size(), 1U);
  EXPECT_EQ(json["files"][0]["path"], "a/digits.txt");
  EXPECT_EQ(json["files"][0]["bytes"], 9);
  EXPECT_EQ(json["files"][0]["crc32"], "cbf43926");
  verify({{"a/digits.txt", "123456789"}});
  EXPECT_EQ(nlohmann::json::parse(commit({}, "{}"))["files"].size(), 0U);
  verify({});
}

TEST_F(ResultSets, ReplaceTheEarlierOneButNotWhatIsTheUsers) {
  commit(old_);
  test::put(directory_ / "notes.txt", "mine");
  test::put(directory_ / "a/y.csv", "old y, and a remark of mine");
  commit(new_);
  Files expected = new_;
  expected["notes.txt"] = "mine";
  expected["a/y.csv"] = "old y, and a remark of mine";
  EXPECT_EQ(found(), expected);
  EXPECT_FALSE(fs::exists(directory_ / "b"));
  verify(new_);
}

TEST_F(ResultSets, AnEarlierSummaryCannotHaveFilesElsewhereRemoved) {
  test::put(temporary_.path() / "precious", "mine");
  for (const char* path : {"../precious", "a/../../precious"}) {
    test::put(directory_ / "summary.json", seal("{}", {record_of(path, "mine")}));
    EXPECT_TRUE(is_sealed(test::content(directory_ / "summary.json")));
    commit(new_);
    EXPECT_EQ(test::content(temporary_.path() / "precious"), "mine");
  }
}

// A file behind a link does not belong to the directory, although a file of its name would go
// there.
TEST_F(ResultSets, ALinkInPlaceOfAFolderIsNotFollowed) {
  const fs::path elsewhere = temporary_.path() / "elsewhere";
  fs::create_directories(elsewhere);
  test::put(elsewhere / "x.csv", "mine");
  fs::create_directories(directory_);
  fs::create_directory_symlink(elsewhere, directory_ / "a");
  test::expect_error([&] { commit(new_); }, ErrorKind::input_output,
                     {"a/x.csv: cannot be written", "/a is a symbolic link", "remove it"}, "link");
  EXPECT_EQ(test::content(elsewhere / "x.csv"), "mine");
  EXPECT_FALSE(fs::exists(directory_ / "summary.json"));
  // Files that an earlier set had under this name are not removed there either.
  fs::remove(directory_ / "a");
  commit(old_);
  fs::remove_all(directory_ / "a");
  test::put(elsewhere / "x.csv", "old x");
  fs::create_directory_symlink(elsewhere, directory_ / "a");
  commit({{"c/d/w.csv", "new w"}});
  EXPECT_EQ(test::content(elsewhere / "x.csv"), "old x");
  // The directory itself may be a link.
  fs::create_directory_symlink(directory_, temporary_.path() / "linked");
  OutputDirectory output(temporary_.path() / "linked");
  output.write("b/x.csv", "x");
  output.write("summary.json", "{}");
  EXPECT_NO_THROW(output.commit());
}

TEST_F(ResultSets, ALinkInPlaceOfAFileIsNotReplaced) {
  commit(old_);
  test::put(temporary_.path() / "elsewhere", "mine");
  fs::remove(directory_ / "a/x.csv");
  fs::create_symlink(temporary_.path() / "elsewhere", directory_ / "a/x.csv");
  test::expect_error([&] { commit(new_); }, ErrorKind::input_output,
                     {"a/x.csv: cannot be written", "it is a symbolic link to "}, "link");
  EXPECT_EQ(test::content(temporary_.path() / "elsewhere"), "mine");
  EXPECT_EQ(test::content(directory_ / "b/z.csv"), "old z");
}

// If others may write to the directory, they may replace the hidden folders.
TEST_F(ResultSets, WhatIsPlantedWhereTheyArePreparedIsNotFollowed) {
  const fs::path elsewhere = temporary_.path() / "elsewhere";
  test::put(elsewhere / "files/a/x.csv", "mine");
  {
    OutputDirectory output(directory_);
    fs::create_directory_symlink(elsewhere, directory_ / ".hamjet-new");
    for (const auto& [path, text] : new_) output.write(path, text);
    output.write("summary.json", "{}");
    output.commit();
  }
  EXPECT_EQ(test::content(elsewhere / "files/a/x.csv"), "mine");
  EXPECT_EQ(found(), new_);
  verify(new_);
}

TEST_F(ResultSets, WhatIsReadyIsNotPutBehindALink) {
  const std::string summary = commit(new_);
  fs::remove_all(directory_);
  const fs::path elsewhere = temporary_.path() / "elsewhere";
  test::put(elsewhere / "x.csv", "mine");
  test::put(directory_ / ".hamjet-ready/files/a/x.csv", "new x");
  test::put(directory_ / ".hamjet-ready/summary/summary.json", summary);
  fs::create_directory_symlink(elsewhere, directory_ / "a");
  expect_refused(new_, {"a/x.csv: cannot be written", "/a is a symbolic link"});
  EXPECT_EQ(test::content(elsewhere / "x.csv"), "mine");
}

TEST_F(ResultSets, WhatAnotherUserHasReadyIsLeftAlone) {
  if (::geteuid() != 0) GTEST_SKIP() << "the superuser alone can make files of others";
  const std::string summary = commit(new_);
  fs::remove_all(directory_);
  const fs::path ready = directory_ / ".hamjet-ready";
  test::put(ready / "files/a/x.csv", "new x");
  test::put(ready / "summary/summary.json", summary);
  ASSERT_EQ(::chown(ready.c_str(), 65534, 65534), 0);
  expect_refused(new_, {"holds results that another user is putting in place", "user 65534"});
  EXPECT_FALSE(fs::exists(directory_ / "a"));
}

TEST_F(ResultSets, ALockWritesIntoNoFileThatHasAnotherName) {
  test::put(temporary_.path() / "precious", "mine");
  fs::create_directories(directory_);
  fs::create_hard_link(temporary_.path() / "precious", directory_ / ".hamjet-lock");
  commit(new_);
  EXPECT_EQ(test::content(temporary_.path() / "precious"), "mine");
}

TEST_F(ResultSets, AreWholeUnlessTheySayThatANumericalFailureLeftThemOut) {
  EXPECT_FALSE(has_whole_results(directory_, "summary.json"));
  for (const auto& [code, is_whole] : {std::pair(0, true), {1, true}, {4, false}}) {
    commit(new_, "{\n  \"exit_code\": " + std::to_string(code) + "\n}\n");
    EXPECT_EQ(has_whole_results(directory_, "summary.json"), is_whole) << code;
  }
  commit(new_);
  EXPECT_TRUE(has_whole_results(directory_, "summary.json"));
  test::put(directory_ / "summary.json", "{}");
  EXPECT_FALSE(has_whole_results(directory_, "summary.json"));
}

TEST_F(ResultSets, LeaveNothingWhereTheyAreNotCommitted) {
  {
    OutputDirectory output(directory_ / "deep/deeper");
    output.write("a/x.csv", "x");
    output.write("summary.json", "{}");
  }
  EXPECT_FALSE(fs::exists(directory_));
  commit(old_);
  const std::string summary = test::content(directory_ / "summary.json");
  {
    OutputDirectory output(directory_);
    output.write("c/x.csv", "x");
    output.write("summary.json", "{}");
  }
  EXPECT_EQ(found(), old_);
  EXPECT_EQ(test::content(directory_ / "summary.json"), summary);
}

TEST_F(ResultSets, EveryBitThatIsFlippedIsNoticed) {
  expect_noticed([](const std::string& good) {
    std::vector<std::string> flipped(8 * good.size(), good);
    for (std::size_t bit = 0; bit < flipped.size(); ++bit) {
      char& byte = flipped[bit][bit / 8];
      byte = static_cast<char>(byte ^ (1 << (bit % 8)));
    }
    return flipped;
  });
}

TEST_F(ResultSets, WhatIsCutOffAtAnyByteIsNoticed) {
  expect_noticed([](const std::string& good) {
    std::vector<std::string> cut;
    for (std::size_t length = 0; length < good.size(); ++length) {
      cut.push_back(good.substr(0, length));
    }
    return cut;
  });
}

TEST_F(ResultSets, WhatIsMissingOrForeignIsNoticed) {
  commit(new_);
  test::put(directory_ / "a/foreign.csv", "of another run");
  expect_refused({{"a/foreign.csv", "of another run"}}, {"a/foreign.csv: is not of the set"});
  fs::remove(directory_ / "a/x.csv");
  expect_refused(new_, {"a/x.csv: cannot be read: No such file"});
  fs::remove(directory_ / "summary.json");
  expect_refused({}, {"summary.json: cannot be read: No such file"});
}

// The remains of a process that is killed while it puts a set in place: some files are already
// there, and the others still wait beside the summary.
TEST_F(ResultSets, PlacingThatWasBrokenOffAnywhereIsCompleted) {
  const std::string summary = commit(new_);
  fs::remove_all(directory_);
  const fs::path ready = directory_ / ".hamjet-ready";
  for (std::size_t placed = 0; placed <= new_.size() + 1; ++placed) {
    SCOPED_TRACE(placed);
    commit(old_);
    std::size_t number = 0;
    for (const auto& [path, text] : new_) {
      test::put((number++ < placed ? directory_ : ready / "files") / path, text);
    }
    // The earlier summary goes before the first file comes, and the new one comes last.
    if (placed > 0) fs::remove(directory_ / "summary.json");
    if (placed > new_.size()) {
      test::put(directory_ / "summary.json", summary);
      fs::create_directories(ready / "summary");
    } else {
      test::put(ready / "summary/summary.json", summary);
    }
    verify(new_);
    EXPECT_FALSE(fs::exists(ready));
    EXPECT_EQ(test::content(directory_ / "summary.json"), summary);
    if (placed == 0) {
      EXPECT_EQ(found(), new_);
    }
  }
}

TEST_F(ResultSets, WhatWasNotCompletelyWrittenIsForgotten) {
  commit(old_);
  test::put(directory_ / ".hamjet-new/files/a/x.csv", "half of the ne");
  test::put(directory_ / ".hamjet-lock", "1\n");
  verify(old_);
  { const OutputDirectory output(directory_); }
  EXPECT_EQ(found(), old_);
  commit(new_);
  EXPECT_EQ(found(), new_);
}

TEST_F(ResultSets, AreRefusedBeforeAnythingIsReplacedWhereAFileCannotGo) {
  commit(old_);
  test::put(directory_ / "c", "a file where a folder should be");
  test::expect_error([&] { commit(new_); }, ErrorKind::input_output,
                     {"c/d/w.csv: cannot be written", "c is not a directory"}, "a file");
  fs::remove(directory_ / "c");
  fs::create_directories(directory_ / "c/d/w.csv");
  test::expect_error([&] { commit(new_); }, ErrorKind::input_output,
                     {"c/d/w.csv: cannot be written", "is a directory"}, "a directory");
  EXPECT_EQ(found(), old_);
  verify(old_);
}

TEST_F(ResultSets, OneProcessAtATime) {
  const std::string own_number = "process " + std::to_string(::getpid());
  {
    const OutputDirectory output(directory_);
    test::expect_error([&] { OutputDirectory second(directory_); }, ErrorKind::input_output,
                       {directory_.string() + ": the output directory is in use", own_number},
                       "second");
    EXPECT_EQ(output.leftovers().front(), directory_ / ".hamjet-lock");
  }
  EXPECT_FALSE(fs::exists(directory_));
  { const OutputDirectory second(directory_); }
}

TEST_F(ResultSets, ADirectoryThatWasRemovedMeanwhileIsMadeAnew) {
  OutputDirectory output(directory_);
  fs::remove_all(directory_);
  output.write("a/x.csv", "new x");
  output.write("summary.json", "{}");
  output.commit();
  verify({{"a/x.csv", "new x"}});
  // Another file that has the name by now, and that somebody else uses, is not written to.
  fs::remove_all(directory_);
  const OutputDirectory other(directory_);
  test::expect_error([&] { output.write("a/x.csv", "x"); }, ErrorKind::input_output, {"in use"},
                     "other");
}

}  // namespace
}  // namespace hamjet::io
