#include "hamjet/astronomy/earth_orientation.hpp"

#include <gtest/gtest.h>

#include <string>

#include "astronomy/earth_days.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

using std::chrono::days;
using std::chrono::sys_days;
using std::chrono::year;

std::string problem_of(const auto& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input_output);
    return error.what();
  }
  return "";
}

TEST(EarthOrientation, ATableIsRefusedOutsideItsDates) {
  std::vector<EarthOrientationDay> rows;
  const sys_days first(year(2010) / 7 / 20);
  for (const int i : {0, 1, 2, 3, 4, 8, 9, 10, 30}) {
    EarthOrientationDay row;
    row.day = first + days(i);
    row.ut1_minus_utc_s = 0.1 + i;
    rows.push_back(row);
  }
  const EarthOrientation table("finals", rows);
  EXPECT_EQ(table.dates(), "2010-07-20 to 2010-07-24, 2010-07-28 to 2010-07-30");
  const auto found =
      table.between(instant("2010-07-21T06:00:00"), instant("2010-07-21T18:00:00"), 1);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].start, instant("2010-07-20T00:00:00"));
  // TAI - UTC was 34 s.
  EXPECT_NEAR(found[1].values.ut1_minus_tt_s, 1.1 - 34 - 32.184, 1e-13);
  EXPECT_EQ(table.between(instant("2010-07-24T00:00:00"), instant("2010-07-24T00:00:00"), 0).size(),
            1U + 0U);
  for (const auto& [from, to] : {std::pair{"2010-07-19T23:59:59", "2010-07-21T00:00:00"},
                                 {"2010-07-23T00:00:00", "2010-07-24T00:00:01"},
                                 {"2010-07-25T00:00:00", "2010-07-26T00:00:00"},
                                 {"2010-08-19T00:00:00", "2010-08-19T00:00:00"}}) {
    const std::string problem = problem_of([&] { table.between(instant(from), instant(to), 0); });
    const std::string first_day = std::string(from).substr(0, 10);
    const std::string last_day = std::string(to).substr(0, 10);
    EXPECT_EQ(problem, "finals: no Earth orientation for " + first_day +
                           (first_day == last_day ? "" : " to " + last_day) +
                           ", must be within its dates: 2010-07-20 to 2010-07-24, 2010-07-28 to "
                           "2010-07-30");
  }
}

TEST(EarthOrientation, DaysMustAscend) {
  const auto table = [](int step) {
    return problem_of([&] {
      EarthOrientationDay one, other;
      one.day = sys_days(year(2020) / 1 / 2);
      other.day = one.day + days(step);
      EarthOrientation("finals", {one, other});
    });
  };
  EXPECT_EQ(table(-1), "finals: days out of order, got 2020-01-01 after 2020-01-02, must ascend");
  EXPECT_EQ(table(2),
            "finals: no Earth orientation, got 2 days, must be two or more in succession");
}

}  // namespace
}  // namespace hamjet
