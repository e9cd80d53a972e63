#include "maps/inversion_miss.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "support/map.hpp"

// The expected value of a right inversion is 0, up to the rounding of the numbers; that of a wrong
// one is what was put in.

namespace hamjet {
namespace {

template <class T>
double miss(const FlowJet<T>& jet, const PartialInversion<T>& inversion) {
  return inversion_miss(jet, inversion);
}

const FlowJet<Extended>& jet() {
  static const FlowJet<Extended> result =
      convert_map<Extended>(test::paper_jet<double>(test::quarter_period, 3));
  return result;
}

TEST(InversionMiss, IsRoundOff) {
  // The bound is the round-off of extended precision times a power of the conditions, which are
  // below 1e4 here.
  const auto kinds = all_kinds(3);
  for (std::size_t k = 0; k < kinds.size(); k += 9) {
    EXPECT_LE(miss(jet(), test::inverted_jet(jet(), kinds[k])), 1e-29) << kinds[k].name();
  }
  const auto in_double = test::paper_jet<double>(test::quarter_period, 3);
  EXPECT_LE(miss(in_double, test::inverted_jet(in_double, "F1")), 1e-13);
}

TEST(InversionMiss, ShowsAWrongCoefficientOfEveryDegreeAndSeries) {
  const auto right = test::inverted_jet(jet(), "F1");
  const SeriesSpace& space = jet()[0].space();
  for (int d = 1; d <= space.order(); ++d) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (const std::size_t k : {space.first(d), space.first(d + 1) - 1}) {
        auto wrong = right;
        wrong.remaining_initial[i][k] += Extended(1e-20);
        EXPECT_GE(miss(jet(), wrong), 1e-26) << "initial " << i << " degree " << d;
        wrong = right;
        wrong.remaining_final[i][k] += Extended(1e-20);
        EXPECT_GE(miss(jet(), wrong), 1e-26) << "final " << i << " degree " << d;
      }
    }
  }
}

TEST(InversionMiss, IsInfiniteForWhatIsNoNumber) {
  auto wrong = test::inverted_jet(jet(), "F2");
  wrong.remaining_initial[1][20] = std::numeric_limits<Extended>::quiet_NaN();
  EXPECT_EQ(miss(jet(), wrong), std::numeric_limits<double>::infinity());
}

TEST(InversionMiss, OfALinearMap) {
  // A degree without terms has neither a miss nor a scale of its own.
  const test::Flow<double> flow{harmonic_oscillator(1, 1e12), {0.2, 0.1}, 0.7e-6, 3, {}};
  const auto map = convert_map<Extended>(test::run_gauss(flow));
  EXPECT_LE(miss(map, test::inverted_jet(map, "F1")), 1e-32);
  auto wrong = test::inverted_jet(map, "F1");
  wrong.remaining_initial[0][5] = Extended(1);
  EXPECT_GE(miss(map, wrong), 1e-8);
}

TEST(Amplification, IsTheConditionOrTheWholeMapBesideTheBlock) {
  // dq/dp0 of the oscillator is sin t; the whole map is a rotation, of norm sqrt 2. The only
  // condition of a single number is 1.
  const double t = 1e-3;
  const test::Flow<double> flow{harmonic_oscillator(), {0.2, 0.1}, t, 1, {}};
  const auto map = test::run_gauss(flow);
  const auto near = test::inverted_jet(map, "F1");
  EXPECT_EQ(near.condition, 1);
  EXPECT_NEAR(near.amplification, std::sqrt(2) / std::sin(t), 1e-9);
  EXPECT_NEAR(test::inverted_jet(map, "F2").amplification, std::sqrt(2) / std::cos(t), 1e-12);
  const auto kepler = test::inverted_jet(jet(), "F1");
  EXPECT_GE(kepler.amplification, kepler.condition);
}

}  // namespace
}  // namespace hamjet
