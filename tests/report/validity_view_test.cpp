#include "report/formation/validity_view.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hamjet::io {
namespace {

ValidityResult result_of(const std::vector<ValidityEntry>& entries) {
  ValidityResult result;
  result.points.push_back({1.0, entries});
  return result;
}

// A separation of 0 is told for what it is: none that holds, or none that was found in time.
TEST(ValidityView, TellsASearchThatEndedWithoutAnAnswer) {
  ValidityEntry good{.order = 1, .proved_m = 5};
  ValidityEntry none{.order = 2};
  ValidityEntry unsettled{.order = 3, .is_unsettled = true};
  const std::string ended = "In order 3 the search for a separation that holds ended without";
  const std::string missed = "no separation could be proved";
  EXPECT_EQ(unproved_text(result_of({good})), "");
  EXPECT_EQ(unproved_text(result_of({good, none})).find(ended), std::string::npos);
  EXPECT_NE(unproved_text(result_of({good, none})).find(missed), std::string::npos);
  const std::string text = unproved_text(result_of({good, unsettled}));
  EXPECT_NE(text.find(ended), std::string::npos) << text;
  EXPECT_EQ(text.find(missed), std::string::npos) << text;
}

// Parts have signs and add up to the whole: what is above it, others take off again.
TEST(ValidityView, PartsAboveTheWholeAreMadeUpFor) {
  const std::vector<std::string> cells = limit_cells({5.1, "p_alpha", 5.8, "alpha", 1.2});
  EXPECT_EQ(cells[0], "5.1");
  EXPECT_EQ(cells[1], "5.8 by p_alpha and -0.7 by others");
  EXPECT_EQ(cells[2], "120 % in alpha and -20 % in others");
  const std::vector<std::string> usual = limit_cells({5, "T", 4.2, "R", 0.7});
  EXPECT_EQ(usual[1], "4.2 by T");
  EXPECT_EQ(usual[2], "70 % in R");
}

}  // namespace
}  // namespace hamjet::io
