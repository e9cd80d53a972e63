#include "hamjet/maps/truncation_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hamjet {
namespace {

using Support = TruncationEstimate::Support;
constexpr double infinity = std::numeric_limits<double>::infinity();

bool is_finite(const DegreeShares::Norms& norms) {
  return std::isfinite(norms.state) && std::isfinite(norms.position);
}

/// The mean rate of decay over `steps` degrees; 0 where the later share vanishes.
double mean_decay(double from, double to, int steps) {
  if (!(to > 0)) return 0;
  const double ratio = to / from;
  switch (steps) {
    case 1:
      return ratio;
    case 2:
      return std::sqrt(ratio);
    case 3:
      return std::cbrt(ratio);
    default:
      return std::pow(ratio, 1.0 / steps);
  }
}

/// The degrees above N, continued at rate q: max(d_N q, d_(N-1) q^2) / (1 - q).
double continued(double last, double last_but_one, double q) {
  return std::max(last * q, last_but_one * q * q) / (1 - q);
}

}  // namespace

double decay_of_degrees(int steps, double leading, double last_but_one, double last) {
  double decay = mean_decay(leading, last, steps);
  if (steps > 1) decay = std::max(decay, mean_decay(leading, last_but_one, steps - 1));
  const bool is_gap = steps > 1 && last_but_one <= last * decay;
  return is_gap ? decay : std::max(decay, last / last_but_one);
}

TruncationEstimate estimate_truncation(int degree, const DegreeShares& shares) {
  const auto& [lower, before, last] = shares;
  const bool is_usable = degree >= 2 && is_finite(lower) && is_finite(before) && is_finite(last);
  if (!is_usable) return {Support::unknown, infinity};
  if (last.state == 0 && before.state == 0) return {Support::inside, 0};
  const double leading = degree == 2 ? before.state : lower.state;
  const double decay = decay_of_degrees(degree - 1, leading, before.state, last.state);
  const bool decays = decay < 1 && continued(last.state, before.state, decay) < leading;
  if (!decays) return {Support::outside, infinity};
  return {Support::inside, continued(last.position, before.position, decay)};
}

}  // namespace hamjet
