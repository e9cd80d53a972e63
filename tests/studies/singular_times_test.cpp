#include "hamjet/detail/studies/singular_times.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "formation_scenes.hpp"
#include "studies/exact_flow.hpp"
#include "support/errors.hpp"
#include "support/reference_data.hpp"

namespace hamjet {
namespace {

std::vector<double> times_of(const std::vector<SingularTime>& found) {
  std::vector<double> times;
  for (const SingularTime& singular : found) times.push_back(singular.time);
  return times;
}

/// The times of a kind over a span.
std::vector<SingularTime> search(const Scene& scene, const char* kind, double span,
                                 double per_revolution = 240) {
  const ComputedProblem problem = make_problem(scene);
  const LinearFlow flow(problem, span, per_revolution);
  return find_singular_times(flow, parse_kind(kind, 3));
}

void expect_times(const std::vector<double>& found, const std::vector<double>& expected,
                  double tolerance, const std::string& what) {
  SCOPED_TRACE(what);
  ASSERT_EQ(found.size(), expected.size()) << ::testing::PrintToString(found);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], tolerance);
}

// Cross-track sin t = 0; in the plane t = 2 pi k and tan(t/2) = 3t/8, published to 7 digits in
// revolutions and to 18 digits in row 18 of the extreme cases (8 - 8 cos t - 3 t sin t = 0).
TEST(SingularTimes, F1OnACircularOrbit) {
  const double pi = std::numbers::pi;
  const auto found = search(kepler_chief(0, 7000, 1000, 1), "F1", 4.6 * 2 * pi);
  const std::vector<double> expected = {
      pi,     2 * pi, 8.838742844152040827, 3 * pi, 4 * pi, 15.36426129078697875,
      5 * pi, 6 * pi, 2 * pi * 3.4611622,   7 * pi, 8 * pi, 2 * pi * 4.4698669,
      9 * pi};
  ASSERT_EQ(found.size(), expected.size()) << ::testing::PrintToString(times_of(found));
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool has_seven_digits = i == 8 || i == 11;
    EXPECT_NEAR(found[i].time, expected[i], has_seven_digits ? 4e-7 : 1e-9) << i;
    EXPECT_LT(found[i].smallest_ratio, 1e-9) << i;
  }
  // Half a revolution cannot command the normal direction, N = z.
  EXPECT_NEAR(std::abs(found[0].direction[2]), 1, 1e-9);
  EXPECT_GT(found[0].second_ratio, 1e-3);
  EXPECT_EQ(found[0].directions_lost, 1);
  // A whole one loses R (here x) and N: what is left is commanded along T, here y.
  EXPECT_LT(found[1].second_ratio, 1e-9);
  EXPECT_EQ(found[1].directions_lost, 2);
  EXPECT_NEAR(found[1].direction[1], 0, 1e-6);
}

// Expected: conjugate_times_seed of reference_cases.json, to 25 digits.
TEST(SingularTimes, AllFourKindsOnThePapersOrbit) {
  const auto& roots = test::reference_cases()["conjugate_times_seed"]["roots"]["J2J3"];
  const auto& pairs =
      test::reference_cases()["conjugate_times_seed"]["missed_by_that_grid_close_pairs_of_B_J2J3"];
  for (const auto& [kind, block] :
       {std::pair("F1", "B"), std::pair("F2", "A"), std::pair("F3", "D"), std::pair("F4", "C")}) {
    std::vector<double> expected;
    for (const auto& root : roots[block]) expected.push_back(std::stod(root.get<std::string>()));
    if (std::string(block) == "B") {
      for (const auto& pair : pairs) expected.push_back(std::stod(pair["t"].get<std::string>()));
    }
    std::sort(expected.begin(), expected.end());
    const auto found = times_of(search(paper_chief(1), kind, 32));
    std::vector<double> unmatched;
    for (const double time : expected) {
      const auto place = std::min_element(found.begin(), found.end(), [&](double a, double b) {
        return std::abs(a - time) < std::abs(b - time);
      });
      ASSERT_NE(place, found.end());
      EXPECT_NEAR(*place, time, 1e-10) << kind;
    }
    // The reference allows for pairs that its grid missed: those found beyond it must be zeros.
    EXPECT_GE(found.size(), expected.size()) << kind;
    EXPECT_LE(found.size(), expected.size() + 4) << kind << ::testing::PrintToString(found);
  }
}

// Expected: the same reference times as above. Twice, two of the nine times lie between two
// neighbouring steps of Gauss's method with 8 stages.
TEST(SingularTimes, TheFigureShowsThoseOfTheFlowWhateverTheStep) {
  const auto& references = test::reference_cases()["conjugate_times_seed"];
  std::vector<double> expected;
  for (const auto& root : references["roots"]["J2J3"]["B"]) {
    expected.push_back(std::stod(root.get<std::string>()));
  }
  for (const auto& pair : references["missed_by_that_grid_close_pairs_of_B_J2J3"]) {
    expected.push_back(std::stod(pair["t"].get<std::string>()));
  }
  std::sort(expected.begin(), expected.end());
  Scene scene = paper_chief(1);
  scene.duration = 10 * std::numbers::pi;
  std::erase_if(expected, [&](double time) { return time > scene.duration; });
  scene.figure = {FigureQuantity::exactness, "F1"};
  scene.integrators.push_back(scene.integrators[0]);
  scene.integrators[1].tolerance.reset();
  scene.integrators[1].step_canonical = 1.0;
  for (const RunResult& run : propagate(scene).runs) {
    ASSERT_TRUE(run.along_time.has_value());
    expect_times(run.along_time->singular_times, expected, 1e-10, "along time");
  }
}

// Expected: the zeros of sin(omega t), omega = 2 and 3; of both oscillators at once F1 loses two
// directions, which no change of the determinant's sign shows.
TEST(SingularTimes, OfAPairOfOscillators) {
  Scene scene;
  scene.system.model = SystemModel::oscillator_pair;
  scene.system.stiffness_N_per_m = 4;
  scene.system.second_stiffness_N_per_m = 9;
  scene.nominal = {1, 1, 0, 0};
  scene.duration = 1;
  scene.order = 1;
  scene.variables = {0, 1, 2, 3};
  scene.integrators = {precise_gauss()};
  const ComputedProblem problem = make_problem(scene);
  const double pi = std::numbers::pi;
  const LinearFlow flow(problem, 4, 240);
  const auto found = find_singular_times(flow, parse_kind("F1", 2));
  expect_times(times_of(found), {pi / 3, pi / 2, 2 * pi / 3, pi}, 1e-12, "2 and 3");
  EXPECT_EQ(found[0].directions_lost, 1);
  EXPECT_EQ(found[3].directions_lost, 2);
  scene.system.second_stiffness_N_per_m = 4;
  const ComputedProblem alike = make_problem(scene);
  expect_times(times_without_kind(alike, 4, parse_kind("F1", 2)).times, {pi / 2, pi}, 1e-12, "2");
}

TEST(SingularTimes, TheClosePairIsFoundOnACoarseGridToo) {
  // The pair is 0.0027 apart; checkpoints are 0.07 apart at perigee and more elsewhere.
  const auto found = times_of(search(paper_chief(1), "F1", 12, 90));
  expect_times(found, {5.3585655609220937, 10.707717268719494690, 10.710460038641982717}, 1e-10,
               "first pair");
}

TEST(SingularTimes, AnExactDoubleZeroIsOneTime) {
  // Kepler's problem after a whole revolution: dq/dp0 has rank 1.
  const auto found = search(kepler_chief(0.3, 7000, 1000, 1), "F1", 12);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].time, paper_period / 2, 1e-10);  // half a revolution, the normal direction
  EXPECT_EQ(found[1].directions_lost, 2);
  EXPECT_LT(found[1].resolution, 1e-11);
  EXPECT_NEAR(found[1].time, paper_period, found[1].resolution);
  EXPECT_LT(found[1].second_ratio, 1e-8);
}

// J2 splits the double zero of a whole revolution in proportion to itself: by 2.7e-3 for the
// Earth's (to 16 digits in the references), so by 2.5e-6 for a thousandth of it.
TEST(SingularTimes, AClosePairIsTwoTimesOrSaysThatItIsNot) {
  Scene scene = paper_chief(1);
  scene.system.J = {};
  std::map<double, double> apart;
  for (const double share : {1e-1, 1e-3}) {
    scene.system.J[2] = share * 1e-3;
    const auto found = search(scene, "F1", 12);
    ASSERT_EQ(found.size(), 3U) << share << ::testing::PrintToString(times_of(found));
    for (const SingularTime& zero : found) {
      EXPECT_EQ(zero.directions_lost, 1) << share;
      EXPECT_LT(zero.resolution, 1e-11);
    }
    apart[share] = found[2].time - found[1].time;
  }
  EXPECT_GT(apart[1e-3], 1e-6);
  EXPECT_LT(apart[1e-3], 5e-6);
  // The part that is quadratic in J2 is a ten thousandth of the distance here.
  EXPECT_NEAR(apart[1e-3], apart[1e-1] / 100, 1e-3 * apart[1e-3]);
  // Two times that are closer than rounding can tell are found as one, which says so.
  scene.system.J[2] = 1e-13;
  const auto found = search(scene, "F1", 12);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[1].directions_lost, 2);
}

TEST(SingularTimes, ACircularOrbitsDoubleZerosAreOneTimeEach) {
  // The zeros of Clohessy and Wiltshire's block: at 2 pi k two at once, R and N.
  const double pi = std::numbers::pi;
  int doubles = 0;
  for (const SingularTime& zero : search(kepler_chief(0, 7000, 1000, 1), "F1", 33.4)) {
    const double turns = zero.time / (2 * pi);
    if (std::abs(turns - std::round(turns)) > 1e-6) continue;
    ++doubles;
    EXPECT_EQ(zero.directions_lost, 2) << zero.time;
    EXPECT_NEAR(zero.time, 2 * pi * std::round(turns), 1e-6);
  }
  EXPECT_EQ(doubles, 5);
}

TEST(SingularTimes, AFinerGridFindsNoMore) {
  // Kinds in which zeros come three at a time, on an orbit of high eccentricity from apogee.
  Scene scene = kepler_chief(0.9, 7000, 1000, 1);
  scene.nominal = {-1, 0, 0, 0, -std::sqrt(0.1), 0};  // mu = 1, r = 1 at apogee
  const double period = 2 * std::numbers::pi * std::pow(1 / 1.9, 1.5);
  for (const char* kind : {"qqq-qqq", "qqq-ppp", "qpp-qpp", "pqq-pqq"}) {
    for (const auto& [chief, span] :
         {std::pair(scene, 2.2 * period), std::pair(paper_chief(1), 22.0)}) {
      const auto coarse = times_of(search(chief, kind, span));
      const auto fine = times_of(search(chief, kind, span, 8 * 240));
      EXPECT_EQ(coarse.size(), fine.size()) << kind << ' ' << span;
    }
  }
}

TEST(SingularTimes, BackwardsAsForwards) {
  // The flow back from the same perigee mirrors the flow forth.
  const auto forth = times_of(search(kepler_chief(0.3, 7000, 1000, 1), "F2", 10));
  const auto back = times_of(search(kepler_chief(0.3, 7000, 1000, 1), "F2", -10));
  ASSERT_EQ(forth.size(), back.size());
  ASSERT_GE(forth.size(), 2U);
  for (std::size_t i = 0; i < forth.size(); ++i) EXPECT_NEAR(back[i], -forth[i], 1e-9);
}

// On a circle the rate is sqrt(2) times the mean motion, r^(-3/2), in any unit of length: from an
// astronomical unit to a metre for the Earth's orbits.
TEST(LinearFlow, HasTheCheckpointsOfACircleInAnyUnitOfLength) {
  for (const double r : {4.7e-5, 1.0, 42164.0, 2.6e7, 1e9}) {
    SCOPED_TRACE(r);
    Scene scene = kepler_chief(0, 7000, 1000, 1);
    for (std::size_t i = 0; i < 3; ++i) scene.nominal[i] *= r;
    for (std::size_t i = 3; i < 6; ++i) scene.nominal[i] /= std::sqrt(r);
    const double revolution = 2 * std::numbers::pi * r * std::sqrt(r);
    const ComputedProblem problem = make_problem(scene);
    const LinearFlow flow(problem, 2 * revolution, 32);
    ASSERT_GE(flow.times().size(), 64U);
    EXPECT_LE(flow.times().size(), 66U);
    EXPECT_NEAR((flow.times()[40] - flow.times()[39]) / revolution, 1.0 / 32, 1e-9);
  }
}

TEST(LinearFlow, BetweenCheckpointsIsTheFlow) {
  const ComputedProblem problem = make_problem(paper_chief(1));
  const LinearFlow coarse(problem, 10, 16);
  const LinearFlow direct(problem, 7.77, 0.5);
  EXPECT_LT((coarse.at(7.77) - direct.checkpoint(1)).norm(), 1e-11 * direct.checkpoint(1).norm());
  EXPECT_EQ(coarse.at(0), LinearFlow::StateTransition::Identity(6, 6));
}

// Expected: the flow over one time alone, in a single adaptive integration from the start. What the
// step to a checkpoint rounds is magnified as deviations are.
TEST(LinearFlow, BetweenCloseCheckpointsIsTheFlowToRounding) {
  Scene eccentric = kepler_chief(0.9, 7000, 1000, 1);
  eccentric.nominal = {-1, 0, 0, 0, -std::sqrt(0.1), 0};  // mu = 1, r = 1 at apogee
  for (const Scene& scene : {paper_chief(1), eccentric}) {
    const ComputedProblem problem = make_problem(scene);
    const LinearFlow flow(problem, 5, 240);
    for (const double time : {0.003, 0.7, 1.19, 2.222, 3.8, 4.9999}) {
      SCOPED_TRACE(time);
      const auto direct = [&](const ComputedProblem& start) {
        const LinearFlow straight(start, time, 1);
        return LinearFlow::StateTransition(straight.checkpoint(straight.times().size() - 1));
      };
      const LinearFlow::StateTransition expected = direct(problem);
      // A product of a thousand matrices rounds to 1e-12. What a step's local error, in the
      // position at the start, does to the flow is allowed for: near the pericentre its second
      // derivatives are large.
      ComputedProblem moved = problem;
      moved.nominal[0] *= 1 + 1e-14;
      const double allowance = (direct(moved) - expected).norm() + 1e-12 * expected.norm();
      EXPECT_LT((flow.at(time) - expected).norm(), allowance);
      const std::vector<double> nominal = flow.nominal(time);
      const std::vector<double> flown =
          exact_flow(problem.system, problem.nominal, problem.start_time, time);
      for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(nominal[i], flown[i], 2e-12) << i;
    }
  }
}

// The limit is 500 000 checkpoints, 2083 revolutions of 240: twice as much is refused in the first
// twentieth of the work, a tenth more in a fifth.
TEST(LinearFlow, ASpanThatIsTooLongIsRefusedAtOnce) {
  const ComputedProblem problem = make_problem(kepler_chief(0.3, 7000, 1000, 1));
  for (const auto& [times, part] : std::map<double, double>{{2, 0.05}, {1.1, 0.2}}) {
    double done = 0;
    test::expect_error(ErrorKind::too_large, "more than 500000 checkpoints", [&, times = times] {
      LinearFlow(problem, times * 2083 * paper_period, 240, [&](double now) { done = now; });
    });
    EXPECT_LT(done, part);
  }
}

// From rest at the distance 1 the fall takes pi / sqrt(8).
TEST(LinearFlow, EndsWhereTheChiefFallsIn) {
  Scene scene = kepler_chief(0.3, 7000, 1000, 1);
  scene.nominal = {1, 0, 0, 0, 0, 0};
  const ComputedProblem problem = make_problem(scene);
  test::expect_error(ErrorKind::numerical, "1.1107", [&] { LinearFlow(problem, 5, 240); });
}

}  // namespace
}  // namespace hamjet
