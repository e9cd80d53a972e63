#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

namespace hamjet {

/// What a search for a reach works on: separations in any one unit, misses in that of the
/// tolerance.
struct ReachProblem {
  int order = 0;  ///< of the polynomials, whose miss grows as the separation to the power order + 1
  double tolerance = 0;
  double smallest = 0;  ///< separation below which none is tried
  double largest = 0;   ///< separation above which none is tried
  /// The largest miss of the deputies that are known to be worst at a separation.
  std::function<double(double separation)> miss = {};
  /// The largest miss of all deputies at a separation, by a search that may find worse ones.
  std::function<double(double separation)> worst_miss = {};
};

struct FoundReach {
  /// The largest separation that holds; 0: none of those that were tried does.
  double separation = 0;
  double miss = 0;                ///< the worst miss there
  double next = 0;                ///< the smallest separation above it that did not hold; 0: none
  double next_miss = 0;           ///< the worst miss there
  bool is_at_limit = false;       ///< the largest separation holds
  bool is_out_of_trials = false;  ///< the search ended before it knew, and the separation is 0
};

/// Finds the largest separation that holds. Starting from the prediction, the next separation that
/// is tried is the one at which the law of the order meets the tolerance, until the largest that
/// holds is known to a few percent. There worse deputies are sought; if one is beyond the
/// tolerance, the search is repeated below.
inline FoundReach search_reach(const ReachProblem& problem, double predicted) {
  constexpr int most_trials = 40;
  constexpr double close = 1.03;
  const double tolerance = problem.tolerance;
  const auto factor_of = [&](double miss) {
    return miss > 0 ? std::pow(tolerance / miss, 1.0 / (problem.order + 1)) : 2;
  };
  double good = 0;
  double bad = 0;
  double bad_miss = 0;
  double trial = predicted;
  for (int k = 0; k < most_trials; ++k) {
    const double found = problem.miss(trial);
    if (found <= tolerance) {
      good = trial;
    } else {
      bad = trial;
      bad_miss = found;
    }
    double factor = factor_of(found);
    const bool is_at_limit = good >= problem.largest;
    if (good > 0 && (is_at_limit || (bad > 0 && bad < close * good))) {
      const double worst = problem.worst_miss(good);
      if (worst <= tolerance) return {good, worst, bad, bad_miss, is_at_limit, false};
      trial = bad = good;
      bad_miss = worst;
      good = 0;
      factor = factor_of(worst);
    }
    factor = std::clamp(factor, 0.1, 2.0);
    // The next trial lies slightly on the other side, so that the two bounds approach each other.
    trial *= factor * (trial == good ? 1.01 : 0.99);
    // If the miss grows by another law, bisection takes over after this many trials.
    constexpr int few_trials = 4;
    const bool is_slow = k >= few_trials && k % 2 == 0;
    if (good > 0 && bad > 0 && (is_slow || !(trial > good && trial < bad))) {
      trial = std::sqrt(good * bad);
    }
    trial = std::min(trial, problem.largest);
    if (trial < problem.smallest) return {};
  }
  FoundReach none;
  none.is_out_of_trials = true;
  return none;
}

}  // namespace hamjet
