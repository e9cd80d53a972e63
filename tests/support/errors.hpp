#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

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

}  // namespace hamjet::test
