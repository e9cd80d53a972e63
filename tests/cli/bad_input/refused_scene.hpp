#pragma once

#include <string>
#include <vector>

#include "../command_test.hpp"

namespace hamjet::test {

/// Tests of scenes that are right but for one mistake.
class RefusedScene : public CommandTest {
 protected:
  /// One text of a right scene in place of another, and what the refusal says of it.
  struct Mistake {
    std::string from, to;
    std::vector<std::string> words;
  };

  /// The scene with one text in place of another: `run` and `check` must refuse it in one line,
  /// which begins with the file and holds every one of the words.
  void expect_refused(const std::string& scene, const std::string& from, const std::string& to,
                      std::vector<std::string> words, int exit_code = 3) const {
    write("bad.toml", changed(scene, from, to));
    words.emplace_back("bad.toml:");
    for (const char* command : {"run", "check"}) {
      expect_error({command, "bad.toml"}, exit_code, words);
    }
  }
  /// The scene with each of the mistakes by itself.
  void expect_each_refused(const std::string& scene, const std::vector<Mistake>& mistakes) const {
    for (const auto& [from, to, words] : mistakes) {
      SCOPED_TRACE(to);
      expect_refused(scene, from, to, words);
    }
  }
};

}  // namespace hamjet::test
