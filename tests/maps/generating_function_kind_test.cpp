#include "hamjet/detail/maps/generating_function_kind.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "support/errors.hpp"

namespace hamjet {
namespace {

TEST(AllKinds, AreFourToThePowerOfTheDegreesOfFreedom) {
  std::size_t expected = 1;
  for (std::size_t n = 1; n <= 4; ++n) {
    expected *= 4;
    const auto kinds = all_kinds(n);
    std::set<std::string> names;
    for (const auto& kind : kinds) {
      names.insert(kind.name());
      EXPECT_EQ(kind.degrees_of_freedom(), n);
      EXPECT_EQ(parse_kind(kind.name(), n), kind) << kind.name();
    }
    EXPECT_EQ(kinds.size(), expected);
    EXPECT_EQ(names.size(), expected);
    EXPECT_EQ(kinds.front(), parse_kind("F1", n));
  }
  EXPECT_EQ(all_kinds(3).size(), 64u);
}

TEST(ParseKind, KnowsTheFourClassicalKinds) {
  EXPECT_EQ(parse_kind("F1", 3).name(), "qqq-qqq");
  EXPECT_EQ(parse_kind("F2", 3).name(), "qqq-ppp");
  EXPECT_EQ(parse_kind("F3", 3).name(), "ppp-qqq");
  EXPECT_EQ(parse_kind("F4", 3).name(), "ppp-ppp");
  EXPECT_EQ(parse_kind("F2", 1).name(), "q-p");
}

TEST(Kind, NamesChosenAndRemainingVariables) {
  const auto kind = parse_kind("qpq-qqp", 3);
  EXPECT_EQ(kind.final_variable(0), 0u);
  EXPECT_EQ(kind.final_variable(1), 4u);
  EXPECT_EQ(kind.final_variable(1, false), 1u);
  EXPECT_EQ(kind.final_variable(2, false), 5u);
  EXPECT_EQ(kind.initial_variable(2), 5u);
  EXPECT_EQ(kind.initial_variable(0, false), 3u);
}

TEST(ParseKind, RefusesEverythingElse) {
  for (const char* text : {"", "F", "F0", "F5", "f1", "F11", "qqq", "qqqqqqq", "qqq-qq", "qq-qq",
                           "qqq-qqqq", "qqx-qqq", "qqq_qqq", "QQQ-QQQ", "---", "auto", "qqq-qq-"}) {
    test::expect_error(ErrorKind::usage, "generating function kind", [&] { parse_kind(text, 3); });
  }
}

}  // namespace
}  // namespace hamjet
