#include "threshold_crossing.hpp"

namespace hamjet {
namespace {

/// What is above a threshold, as a function of the place.
class Excess {
 public:
  Excess(const std::vector<double>& polynomial, double threshold)
      : polynomial_(polynomial), threshold_(threshold) {}

  double value(double x) const {
    double sum = 0;
    for (std::size_t k = polynomial_.size(); k-- > 1;) sum = (sum + polynomial_[k]) * x;
    return sum + (polynomial_.front() - threshold_);
  }
  double slope(double x) const {
    double sum = 0;
    for (std::size_t k = polynomial_.size(); k-- > 1;) {
      sum = sum * x + static_cast<double>(k) * polynomial_[k];
    }
    return sum;
  }

 private:
  const std::vector<double>& polynomial_;
  double threshold_;
};

/// The last number before which a condition holds, which does at `a` and does not at `b`.
template <class Condition>
double bisected(double a, double b, const Condition& holds) {
  while (true) {
    const double middle = a + (b - a) / 2;
    if (!(middle > a) || !(middle < b)) return b;
    (holds(middle) ? a : b) = middle;
  }
}

}  // namespace

std::optional<ThresholdCrossing> first_fall_below(const std::vector<double>& polynomial,
                                                  double threshold, double last,
                                                  bool begins_there) {
  constexpr int parts = 16;
  const Excess excess(polynomial, threshold);
  const auto is_above = [&](double x) { return excess.value(x) > 0; };
  const auto found = [&](double x) { return ThresholdCrossing{x, excess.slope(x)}; };
  for (int part = 0; part < parts; ++part) {
    const double a = last * part / parts;
    const double b = last * (part + 1) / parts;
    const bool is_at_threshold = begins_there && part == 0;
    if (!is_at_threshold && !is_above(a)) return found(a);
    const double slope = excess.slope(a);
    // A place between at which it begins to rise, or to fall.
    std::optional<double> extremum;
    if (slope * excess.slope(b) < 0) {
      extremum = bisected(a, b, [&](double x) { return excess.slope(x) * slope > 0; });
    }
    if (extremum && slope < 0 && !is_above(*extremum)) {
      return found(is_at_threshold ? a : bisected(a, *extremum, is_above));
    }
    if (is_above(b)) continue;
    const double from = extremum && slope > 0 ? *extremum : a;
    if (from > a && !is_above(from)) return found(from);
    return found(from == a && is_at_threshold ? a : bisected(from, b, is_above));
  }
  return std::nullopt;
}

std::optional<ThresholdCrossing> first_rise_above(std::vector<double> polynomial, double threshold,
                                                  double last, bool begins_there) {
  for (double& coefficient : polynomial) coefficient = -coefficient;
  auto crossing = first_fall_below(polynomial, -threshold, last, begins_there);
  if (crossing) crossing->slope = -crossing->slope;
  return crossing;
}

}  // namespace hamjet
