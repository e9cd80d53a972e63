#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>

// Properties that hold for all numbers are tested on random numbers by rapidcheck.

namespace hamjet::test {

/// Checks a property on `cases` random cases, which are the same in every run and on every machine.
/// The variable HAMJET_PROPERTY_FACTOR multiplies their number for a longer search. A case that
/// fails is simplified as long as it fails, and its numbers are printed by the names with which
/// they were drawn (`Gen::as`).
template <class Property>
void expect_property(Property&& property, int cases) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  rc::detail::TestMetadata metadata;
  metadata.id = std::string(test->test_suite_name()) + "." + test->name();
  metadata.description = test->name();
  rc::detail::TestParams parameters;
  parameters.seed = 20261121;
  const char* const factor = std::getenv("HAMJET_PROPERTY_FACTOR");
  parameters.maxSuccess = cases * (factor != nullptr ? std::stoi(factor) : 1);
  const auto result =
      rc::detail::checkTestable(std::forward<Property>(property), metadata, parameters);
  if (result.template is<rc::detail::SuccessResult>()) return;
  std::ostringstream message;
  rc::detail::printResultMessage(result, message);
  ADD_FAILURE() << message.str();
}

/// A whole number between two bounds, both included; the simplest one is the lowest.
inline rc::Gen<int> whole_number(int lowest, int highest) {
  // rapidcheck draws from a part of the range first; here the first case already uses the whole
  // range.
  return rc::gen::resize(rc::kNominalSize, rc::gen::inRange(lowest, highest + 1));
}

/// A number of many digits between two bounds; the simplest one is the lowest.
inline rc::Gen<double> number(double lowest, double highest) {
  constexpr int parts = 1'000'003;
  return rc::gen::map(whole_number(0, parts), [=](int part) {
    return lowest + (highest - lowest) * static_cast<double>(part) / parts;
  });
}

}  // namespace hamjet::test
