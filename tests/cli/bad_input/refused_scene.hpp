#pragma once

#include <string>
#include <vector>

#include "../command_test.hpp"

namespace hamjet::test {

/// Tests of scenes that are right but for one mistake.
class RefusedScene : public CommandTest {
 protected:
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
};

}  // namespace hamjet::test
