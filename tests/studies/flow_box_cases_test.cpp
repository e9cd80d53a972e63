#include "studies/stability/flow_box_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hamjet {
namespace {

// For each orbit at the edge of a chart the answer agrees with an independent integration, in nodal
// sections or in their replacement, or the orbit is refused with the reason.
TEST(FlowBoxCases, AreAnsweredReplacedOrRefusedWithTheReason) {
  int right = 0;
  int replaced = 0;
  int refused = 0;
  for (const StabilityCase& subject : flow_box_cases()) {
    const StabilityResult result = run_stability_case(subject);
    EXPECT_EQ(result.outcome, subject.expected.outcome) << subject.name << ": " << result.text;
    if (result.outcome == CaseOutcome::refused) ++refused;
    if (result.outcome != CaseOutcome::right) continue;
    ++right;
    ASSERT_TRUE(result.error);
    if (result.error->quantity.find("in place of") != std::string::npos) ++replaced;
  }
  EXPECT_GE(right, 25);
  EXPECT_GE(replaced, 5);  // equators and orbits that are no ellipses
  EXPECT_GE(refused, 3);
}

// The test notices mistakes: a refusal for another reason, a refusal where an answer is expected,
// and an answer where a refusal is expected.
TEST(FlowBoxCases, FindWhatIsWrong) {
  std::vector<StabilityCase> cases = flow_box_cases();
  const auto refused = std::find_if(cases.begin(), cases.end(), [](const StabilityCase& subject) {
    return subject.expected.outcome == CaseOutcome::refused;
  });
  ASSERT_NE(refused, cases.end());
  refused->expected.message = "another reason";
  EXPECT_EQ(run_stability_case(*refused).outcome, CaseOutcome::wrong);
  refused->expected = cases.front().expected;
  EXPECT_EQ(run_stability_case(*refused).outcome, CaseOutcome::wrong);
  cases.front().expected.outcome = CaseOutcome::refused;
  EXPECT_EQ(run_stability_case(cases.front()).outcome, CaseOutcome::wrong);
}

}  // namespace
}  // namespace hamjet
