#include "maps/legendre_transformation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hamjet/algebra/calculus.hpp"
#include "support/errors.hpp"
#include "support/map.hpp"
#include "support/random_series.hpp"

namespace hamjet {
namespace {

/// The oscillator's S of F1..F4 at time t, closed forms as in generating_function_test: with c =
/// cos t and s = sin t, ((x^2 + y^2) c - 2 x y) / (2 s) for F1 and F4, and -(x^2 + y^2) s / (2 c)
/// + x y / c for F2, with -x y / c for F3.
Series<double> oscillator_function(const std::string& kind, double t) {
  const double s = std::sin(t);
  const double c = std::cos(t);
  const bool is_alike = kind == "F1" || kind == "F4";
  const double squares = is_alike ? c / (2 * s) : -s / (2 * c);
  const double mixed = is_alike ? -1 / s : (kind == "F2" ? 1 / c : -1 / c);
  return {SeriesSpace::create(2, 2), {0, 0, 0, squares, mixed, squares}};
}

template <class T>
Series<T> direct_function(const FlowJet<T>& jet, const GeneratingFunctionKind& kind) {
  return generating_function(one_form(test::inverted_jet(jet, kind)));
}

/// The classical kinds and some mixed kinds, all with a condition below 40 at a quarter period.
std::vector<GeneratingFunctionKind> selected_kinds() {
  std::vector<GeneratingFunctionKind> kinds;
  for (const char* name : {"F1", "F2", "F3", "F4", "qpq-qqp", "qqp-pqp", "ppq-qpp"}) {
    kinds.push_back(parse_kind(name, 3));
  }
  return kinds;
}

TEST(LegendreTransformation, OfTheOscillatorHasItsClosedForms) {
  const std::vector<std::string> kinds{"F1", "F2", "F3", "F4"};
  for (const double t : {0.7, -1.2, 2.5}) {
    for (const auto& from : kinds) {
      for (const auto& to : kinds) {
        const auto S = legendre_transformation(oscillator_function(from, t), parse_kind(from, 1),
                                               parse_kind(to, 1));
        const auto expected = oscillator_function(to, t);
        ASSERT_EQ(S.order(), 2);
        for (std::size_t k = 0; k < 6; ++k) {
          EXPECT_NEAR(S[k], expected[k], 5e-15) << from << " to " << to << " at " << t;
        }
      }
    }
  }
}

/// S of each pair of kinds, transformed and transformed back, against the inverted jet and against
/// itself: per degree d relative to the largest coefficient, round-off times the power d - 1 of the
/// condition of the inversions that led there.
template <class T>
void expect_agreement(const FlowJet<T>& jet) {
  const double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
  std::vector<PartialInversion<T>> inversions;
  for (const auto& kind : selected_kinds()) inversions.push_back(test::inverted_jet(jet, kind));
  for (const auto& from : inversions) {
    const auto S = generating_function(one_form(from));
    for (const auto& to : inversions) {
      const auto direct = generating_function(one_form(to));
      const auto transformed = legendre_transformation(S, from.kind, to.kind);
      const auto back = legendre_transformation(transformed, to.kind, from.kind);
      const double condition = std::max(from.condition, to.condition);
      for (int d = 2; d <= S.order(); ++d) {
        const double bound = 4 * epsilon * std::pow(2 * condition, d - 1);
        EXPECT_LE(test::largest_of_degree(transformed - direct, d),
                  bound * test::largest_of_degree(direct, d))
            << from.kind.name() << " to " << to.kind.name() << ", degree " << d;
        EXPECT_LE(test::largest_of_degree(back - S, d), bound * test::largest_of_degree(S, d))
            << from.kind.name() << " to " << to.kind.name() << " and back, degree " << d;
      }
    }
  }
}

TEST(LegendreTransformation, AgreesWithTheInvertedJetThereAndBack) {
  expect_agreement(test::paper_jet<double>(test::quarter_period, 4, test::adaptive(8, 1e-16)));
  expect_agreement(test::paper_jet<Extended>(test::quarter_period, 4, test::adaptive(16, 1e-28)));
}

TEST(LegendreTransformation, SubtractsTheProductsOfTheExchangedPairs) {
  // Its definition, S'(w'(w)) = S(w) - sum of w_i sigma_i over the pairs that differ. w'(w) is
  // known to degree N only, but its degree N+1 meets S' from degree N+2 on.
  const auto jet = test::paper_jet<Extended>(test::quarter_period, 3, test::adaptive(16, 1e-28));
  const auto from = parse_kind("F2", 3);
  for (const auto& to : selected_kinds()) {
    const auto S = direct_function(jet, from);
    const auto transformed = legendre_transformation(S, from, to);
    const auto inversion = remaining_variables(S, from);
    const SpacePointer& space = S.space_pointer();
    Series<Extended> expected = S;
    std::vector<Series<Extended>> variables;
    for (std::size_t i = 0; i < 6; ++i) {
      const bool is_final = i < 3;
      const auto& chosen = is_final ? from.final_is_momentum : from.initial_is_momentum;
      const auto& wanted = is_final ? to.final_is_momentum : to.initial_is_momentum;
      const auto w = Series<Extended>::variable(space, i);
      const std::size_t pair = i % 3;
      if (chosen[pair] == wanted[pair]) {
        variables.push_back(w);
        continue;
      }
      variables.push_back(in_space(
          (is_final ? inversion.remaining_final : inversion.remaining_initial)[pair], space));
      expected -= w * in_space(one_form(inversion)[i], space);
    }
    const std::vector<Series<Extended>> outer{transformed};
    const auto composed = compose(outer, variables)[0];
    for (int d = 2; d <= 4; ++d) {
      EXPECT_LE(test::largest_of_degree(composed - expected, d),
                1e-32 * std::pow(80.0, d - 2) * test::largest_of_degree(expected, d))
          << to.name() << ", degree " << d;
    }
  }
}

TEST(LegendreTransformation, OfTheSameKindIsTheFunctionItself) {
  const auto jet = test::paper_jet<double>(test::quarter_period, 3);
  const auto kind = parse_kind("qpq-qqp", 3);
  const auto S = direct_function(jet, kind);
  const auto same = legendre_transformation(S, kind, kind);
  for (int d = 2; d <= 4; ++d) {
    EXPECT_LE(test::largest_of_degree(same - S, d), 4e-16 * test::largest_of_degree(S, d));
  }
}

TEST(LegendreTransformation, RefusesKindsThatDoNotExist) {
  // The identity is F2 = q p0 and F3 = -p q0, and has neither F1 nor F4; a quarter turn is F1 =
  // -q q0 and F4 = -p p0, and has neither F2 nor F3, with cos(pi / 2) = 6e-17 in double precision.
  const double quarter_turn = std::acos(-1.0) / 2;
  const struct {
    double t;
    const char* from;
    const char* exists;
    const char* absent[2];
  } cases[] = {{0, "F2", "F3", {"F1", "F4"}}, {quarter_turn, "F1", "F4", {"F2", "F3"}}};
  for (const auto& c : cases) {
    const auto S = oscillator_function(c.from, c.t);
    const auto from = parse_kind(c.from, 1);
    for (const char* name : c.absent) {
      const auto to = parse_kind(name, 1);
      const std::string names = "from " + from.name() + " to " + to.name();
      test::expect_error(ErrorKind::numerical, names,
                         [&] { legendre_transformation(S, from, to); });
      test::expect_error(ErrorKind::numerical, "smallest singular value",
                         [&] { legendre_transformation(S, from, to); });
    }
    const auto S2 = legendre_transformation(S, from, parse_kind(c.exists, 1));
    const auto expected = oscillator_function(c.exists, c.t);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(S2[k], expected[k], 1e-15);
  }
  // A period of Kepler's problem: dq/dp0 is of rank one, so that F1 and F4 do not exist.
  auto flow = test::flow_of(test::paper_orbit(), 2);
  flow.system = kepler();
  flow.duration = 4 * test::quarter_period;
  const auto S =
      direct_function(test::run_gauss(flow, test::adaptive(8, 1e-16)), parse_kind("F2", 3));
  for (const char* absent : {"F1", "F4"}) {
    test::expect_error(ErrorKind::numerical, "does not exist", [&] {
      legendre_transformation(S, parse_kind("F2", 3), parse_kind(absent, 3));
    });
  }
}

TEST(RemainingVariables, AreThoseOfTheInvertedJet) {
  const auto jet = test::paper_jet<Extended>(test::quarter_period, 3, test::adaptive(16, 1e-28));
  for (const auto& kind : selected_kinds()) {
    const auto direct = test::inverted_jet(jet, kind);
    const auto recovered = remaining_variables(generating_function(one_form(direct)), kind);
    EXPECT_EQ(recovered.kind, kind);
    EXPECT_NEAR(recovered.condition, direct.condition, 1e-12 * direct.condition);
    for (int d = 1; d <= 3; ++d) {
      const double bound = 1e-32 * std::pow(2 * direct.condition, d);
      for (std::size_t i = 0; i < 3; ++i) {
        ASSERT_EQ(recovered.remaining_final[i].order(), 3);
        EXPECT_LE(
            test::largest_of_degree(recovered.remaining_final[i] - direct.remaining_final[i], d),
            bound * test::largest_of_degree(direct.remaining_final[i], d))
            << kind.name() << ", degree " << d;
        EXPECT_LE(test::largest_of_degree(
                      recovered.remaining_initial[i] - direct.remaining_initial[i], d),
                  bound * test::largest_of_degree(direct.remaining_initial[i], d))
            << kind.name() << ", degree " << d;
      }
    }
  }
}

TEST(RemainingVariables, RefuseWhatGeneratesNoMapOfDeviations) {
  const auto kind = parse_kind("F2", 1);
  const auto S = oscillator_function("F2", 0.7);
  auto moved = S;
  moved[1] = 1e-3;
  test::expect_error(ErrorKind::usage, "degree 1", [&] { remaining_variables(moved, kind); });
  test::expect_error(ErrorKind::usage, "6 variables",
                     [&] { remaining_variables(S, parse_kind("F2", 3)); });
  const Series<double> flat(SeriesSpace::create(2, 1));
  test::expect_error(ErrorKind::usage, "order 2", [&] { remaining_variables(flat, kind); });
  test::expect_error(ErrorKind::usage, "degrees of freedom",
                     [&] { legendre_transformation(S, kind, parse_kind("F1", 2)); });
  // A constant generates nothing.
  auto lifted = S;
  lifted[0] = 5;
  EXPECT_EQ(remaining_variables(lifted, kind).remaining_final[0][1],
            remaining_variables(S, kind).remaining_final[0][1]);
}

}  // namespace
}  // namespace hamjet
