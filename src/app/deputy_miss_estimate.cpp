#include <algorithm>
#include <array>
#include <cmath>

#include "../maps/evaluation_error.hpp"
#include "deputy_evaluation.hpp"

// What the estimate of a deputy's miss is made of: the missing degrees, rounding and integration.

namespace hamjet::cli {
namespace {

/// Floors of flights are cautious. Beside closed forms, errors of a thousand random deputies that
/// rounding limits were a third of them in the median, and once in a hundred a fortieth or 1.2
/// times.
constexpr double rounding_margin = 3;

}  // namespace

bool DeputyEvaluation::is_nearly_straight(const SixNumbers<double>& initial,
                                          const DeputyPrediction& found) const {
  constexpr double largest_share = 0.1;  // the largest share of the deviation that a degree adds
  // The largest deviation as a share of the chief's distance.
  constexpr double largest_extent = 0.03;
  const auto length = [](const SixNumbers<double>& z) { return std::hypot(z[0], z[1], z[2]); };
  const double size = std::max(length(initial), length(found.deviation));
  return length(found.highest[0]) <= largest_share * size &&
         length(found.highest[1]) <= largest_share * size &&
         size <= largest_extent * length(scene_.flow->chief_end());
}

MissEstimate DeputyEvaluation::estimate(const DeputyPrediction& prediction) const {
  const io::StoredJet& chief = scene_.chief;
  const double length_m = chief.units.length_km * 1000;
  SixNumbers<double> lower = prediction.deviation;
  const auto& [last, last_but_one, last_but_two] = prediction.highest;
  for (std::size_t i = 0; i < 6; ++i) lower[i] -= last[i] + last_but_one[i];
  const auto norms = [&](const SixNumbers<double>& z) {
    const double position = std::hypot(z[0], z[1], z[2]);
    const double momentum = std::hypot(z[3], z[4], z[5]) / momentum_unit_;
    return DegreeShares::Norms{std::hypot(position, momentum), position * length_m};
  };
  const TruncationEstimate truncation =
      estimate_truncation(degree_, {norms(lower), norms(last_but_one), norms(last)});
  return {truncation.support, truncation.miss, 0};
}

double DeputyEvaluation::uncancelled(const SixNumbers<double>& initial) const {
  const auto& jet = scene_.flow->polynomials();
  const SeriesSpace& space = jet[0].space();
  double squares = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double sum = 0;
    for (std::size_t v = 0; v < initial.size(); ++v) {
      sum += std::abs(jet[i][space.linear_index(v)] * initial[v]);
    }
    squares += sum * sum;
  }
  return std::sqrt(squares);
}

double DeputyEvaluation::chief_error() const {
  const double length_m = scene_.chief.units.length_km * 1000;
  return std::max(scene_.error.of_chief(), scene_.rounding_m / length_m);
}

void DeputyEvaluation::add_errors(const SixNumbers<double>& initial,
                                  const SixNumbers<double>& found, MissEstimate& told) const {
  const auto speed = [](const SixNumbers<double>& z) { return std::hypot(z[3], z[4], z[5]); };
  const double length_m = scene_.chief.units.length_km * 1000;
  told.integration_m = scene_.error.of_deviation(initial) * length_m;
  if (scene_.coordinates == JetCoordinates::cartesian) {
    // Nothing is rounded but numbers of the deviation's own size.
    told.rounding_m = evaluation_rounding(scene_.flow->polynomials()[0].space(), degree_) *
                      uncancelled(initial) * length_m;
    // Where the chief is another spacecraft, its end and the polynomials' are two flights.
    if (scene_.companion != SixNumbers<double>{}) {
      told.rounding_m = std::hypot(told.rounding_m, scene_.rounding_m / rounding_margin);
    }
    return;
  }
  told.rounding_m = scene_.rounding_m / rounding_margin;
  const SixNumbers<double>& chief = scene_.flow->chief_end();
  SixNumbers<double> deputy = chief;
  for (std::size_t i = 0; i < deputy.size(); ++i) deputy[i] += found[i];
  // What is behind in time is behind by as much more in place as it is faster than the chief.
  const double faster = std::max(1.0, speed(deputy) / speed(chief));
  told.rounding_m *= faster;
  told.integration_m *= faster;
  told.integration_m += speed(found) / speed(chief) * chief_error() * length_m;
}

MissEstimate DeputyEvaluation::curved_estimate(const SixNumbers<double>& initial,
                                               const SixNumbers<double>& found,
                                               const std::array<SixNumbers<double>, 3>& lower,
                                               const DeputyPrediction* next) const {
  using Support = TruncationEstimate::Support;
  const auto distance = [](const SixNumbers<double>& a, const SixNumbers<double>& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  };
  const SixNumbers<double> none{};
  MissEstimate result{Support::unknown, 0, 0};
  add_errors(initial, found, result);
  if (degree_ < 2) return result;
  const double change = distance(found, lower[0]);
  if (!std::isfinite(change) || !std::isfinite(scene_.rounding_m)) return result;
  const double size = std::max(distance(initial, none), distance(found, none));
  // A change that is rounding says nothing of a decay.
  const double rounding = scene_.rounding_m / (scene_.chief.units.length_km * 1000);
  bool is_decaying = false;
  double missing = change;
  if (degree_ >= 3) {
    const double before = distance(lower[0], lower[1]);
    const double two_before = distance(lower[1], lower[2]);
    if (!std::isfinite(before)) return result;
    is_decaying = change < before || change <= rounding;
    // The lowest degrees may leave a deputy where the coordinates of the end are none.
    const double all = std::isfinite(two_before) ? decay_of_degrees(2, two_before, before, change)
                                                 : decay_of_degrees(1, before, before, change);
    constexpr double largest_decay = 2;
    const double decay = std::min(all, is_decaying ? 1.0 : largest_decay);
    // Degrees that bend little may fall off faster at first than they go on.
    constexpr double least_decay = 0.02;
    missing = std::max(change * std::max(decay, least_decay), before * decay * decay);
  }
  if (next) {
    // What is left goes on as the next degree does, which may vanish by chance, and then as those
    // before it. Where it changes far more, coefficients are no more than rounding, or the series
    // diverges.
    const double added = distance(next->deviation, found);
    const double share = change > 0 ? std::min(added / change, 0.5) : 0.5;
    const double ratio = degree_ == 2 ? change / size : missing / change;
    constexpr double most = 10;
    const double largest = most * std::max({change, missing, rounding});
    if (std::isfinite(added)) {
      const double least = change > 0 ? change * ratio * ratio : 0;
      missing = std::clamp(added / (1 - share), std::min(least, largest), largest);
    }
  } else if (degree_ == 2 && change > 0) {
    // Coordinates that bend as the flow does leave degree 2 little of a deviation, and degree 3 as
    // much less of that as deputies are near. Results state their coefficients' errors.
    constexpr double margin = 2;
    const double nearness = size / distance(scene_.flow->chief_end(), none);
    const std::vector<double>& errors = scene_.chief.error_by_degree;
    const double left =
        margin * std::max({change / size, nearness, errors.size() > 2 ? errors[2] : 1.0});
    missing = change * std::min(left, 1.0);
  }
  // Of the deviation that a degree may change. Degrees that are small already need not decay one by
  // one, for the lower may vanish by chance; less is relied upon then.
  const double largest_share = is_decaying ? 0.1 : 1e-4;
  result.support = change <= largest_share * size ? Support::inside : Support::outside;
  result.truncation_m = missing * scene_.chief.units.length_km * 1000;
  return result;
}

}  // namespace hamjet::cli
