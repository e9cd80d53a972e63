#include "extreme_distance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

using Number = Series<double>;

Number dot(const ArcCurve& a, const ArcCurve& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

ArcCurve cross(const ArcCurve& a, const ArcCurve& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Number inverse_length(const ArcCurve& a) {
  const Number square = dot(a, a);
  if (!(square[0] > 0)) {
    throw Error(ErrorKind::numerical, "the chief moves on a line through the centre: no R, T, N");
  }
  return pow(square, -0.5);
}

ArcCurve three(const std::vector<Number>& components, std::size_t first) {
  return {components[first], components[first + 1], components[first + 2]};
}

/// The square of a curve's length, with all of its powers, so that nothing is left out.
std::vector<double> squared_length(const ArcCurve& curve) {
  const std::size_t size = curve[0].size();
  std::vector<double> square(2 * size - 1, 0.0);
  for (const Number& x : curve) {
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j < size; ++j) square[i + j] += x[i] * x[j];
    }
  }
  return square;
}

/// The polynomial of the variable in units of `half` about `middle`.
std::vector<double> recentred(std::vector<double> f, double middle, double half) {
  for (std::size_t i = 0; i + 1 < f.size(); ++i) {
    for (std::size_t k = f.size() - 1; k-- > i;) f[k] += middle * f[k + 1];
  }
  double power = 1;
  for (double& c : f) {
    c *= power;
    power *= half;
  }
  return f;
}

/// The v from -1 to 1 at which g0 + g1 v + g2 v^2 is least, and the least value.
std::pair<double, double> least_of_parabola(const std::vector<double>& g) {
  const auto value = [&](double v) { return g[0] + v * (g[1] + v * g[2]); };
  double best = value(-1) < value(1) ? -1 : 1;
  if (g[2] > 0) {
    const double inside = std::clamp(-g[1] / (2 * g[2]), -1.0, 1.0);
    if (value(inside) < value(best)) best = inside;
  }
  return {best, value(best)};
}

}  // namespace

ArcCurve place_along(const FlightArc& arc, std::size_t craft) {
  return three(arc.spacecraft[craft], 0);
}

ArcCurve separation_along(const FlightArc& arc, std::size_t from, std::size_t to) {
  ArcCurve curve = place_along(arc, to);
  for (std::size_t i = 0; i < 3; ++i) curve[i] -= arc.spacecraft[from][i];
  return curve;
}

ArcCurve rtn_separation_along(const FlightArc& arc, std::size_t from, std::size_t to) {
  const ArcCurve difference = separation_along(arc, from, to);
  const ArcCurve place = place_along(arc, from);
  const ArcCurve normal = cross(place, three(arc.spacecraft[from], 3));
  const Number of_place = inverse_length(place);
  const Number of_normal = inverse_length(normal);
  return {dot(difference, place) * of_place,
          dot(difference, cross(normal, place)) * of_normal * of_place,
          dot(difference, normal) * of_normal};
}

double ExtremeDistance::length_at(const ArcCurve& curve, double share) const {
  return std::hypot(value_at(curve[0], share), value_at(curve[1], share),
                    value_at(curve[2], share));
}

bool ExtremeDistance::keep_better(const FlightArc& arc, const ArcCurve& curve, double share) {
  const double length = length_at(curve, share);
  if (is_started_ && !(sign_ * length < sign_ * distance_)) return false;
  is_started_ = true;
  distance_ = length;
  time_ = arc.time_at(share);
  share_ = share;
  return true;
}

bool ExtremeDistance::add(const FlightArc& arc, const ArcCurve& curve) {
  constexpr double accuracy = 1e-12;
  constexpr double rounding = 1e-14;
  constexpr double least_half = 1e-9;
  std::vector<double> f = squared_length(curve);
  double scale = 0;
  for (double& c : f) {
    scale += std::abs(c);
    c *= sign_;
  }
  // With NaN there is no bound, and the parts would be halved for ever.
  if (!std::isfinite(scale)) {
    throw Error(ErrorKind::numerical, "distance: a flight's polynomial in time is not finite");
  }
  bool is_here = keep_better(arc, curve, 0);
  is_here = keep_better(arc, curve, 1) || is_here;
  std::vector<std::pair<double, double>> parts = {{0.5, 0.5}};  // middle and half length
  while (!parts.empty()) {
    const auto [middle, half] = parts.back();
    parts.pop_back();
    const std::vector<double> g = recentred(f, middle, half);
    double rest = 0;
    for (std::size_t k = 3; k < g.size(); ++k) rest += std::abs(g[k]);
    const auto [v, least] = least_of_parabola(g);
    const double best = sign_ * distance_ * distance_;
    if (least - rest >= best - accuracy * std::abs(best) - rounding * scale) continue;
    is_here = keep_better(arc, curve, std::clamp(middle + v * half, 0.0, 1.0)) || is_here;
    if (half < least_half) continue;
    parts.emplace_back(middle + half / 2, half / 2);
    parts.emplace_back(middle - half / 2, half / 2);
  }
  return is_here;
}

}  // namespace hamjet
