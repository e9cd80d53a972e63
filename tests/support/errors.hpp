#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "hamjet/error.hpp"

namespace hamjet::test {

/// Expects that the action throws an Error of this kind whose message holds the text.
template <class Action>
void expect_error(ErrorKind kind, const std::string& text, Action&& action) {
  try {
    std::forward<Action>(action)();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    return;
  }
  ADD_FAILURE() << "no error was thrown; expected one that says '" << text << "'";
}

/// Expects an Error of this kind, whose message is one printable line (of at most a few lines'
/// length) with every one of the words. A failure of the test prints `about`.
template <class Action>
void expect_error(const Action& action, ErrorKind kind, const std::vector<std::string>& words,
                  const std::string& about) {
  SCOPED_TRACE(about.substr(0, 200));
  try {
    action();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.kind(), kind) << message;
    for (const std::string& word : words) {
      EXPECT_NE(message.find(word), std::string::npos) << message << "\nlacks " << word;
    }
    EXPECT_EQ(message.find_first_of(std::string("\n\r\t\x1b\0", 5)), std::string::npos) << message;
    EXPECT_LT(message.size(), 700U);
  }
}

}  // namespace hamjet::test
