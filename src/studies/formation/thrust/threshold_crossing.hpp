#pragma once

#include <optional>
#include <vector>

namespace hamjet {

/// Where a polynomial passes a threshold, and its slope there.
struct ThresholdCrossing {
  double place = 0;
  double slope = 0;
};

/// The first place between 0 and `last` at which a polynomial, given by its coefficients, falls
/// below a threshold, to rounding; none if it does not. It is looked at in sixteen parts, in each
/// of which it has at most one extremum. If it `begins_there`, it is at the threshold at 0 and
/// above it behind.
std::optional<ThresholdCrossing> first_fall_below(const std::vector<double>& polynomial,
                                                  double threshold, double last, bool begins_there);
/// The same for a polynomial that rises above a threshold.
std::optional<ThresholdCrossing> first_rise_above(std::vector<double> polynomial, double threshold,
                                                  double last, bool begins_there);

}  // namespace hamjet
