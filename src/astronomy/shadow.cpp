#include "shadow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../algebra/scalar_search.hpp"

namespace hamjet {
namespace {

using Place = std::array<double, 3>;

double length(const Place& a) { return std::hypot(a[0], a[1], a[2]); }

double dot_product(const Place& a, const Place& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double cross_length(const Place& a, const Place& b) {
  return std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                    a[0] * b[1] - a[1] * b[0]);
}

/// The area of a disc of radius r beyond a chord at the distance x from its centre, which is
/// negative for more than half of the disc.
double cap(double r, double x) {
  const double part = std::clamp(x / r, -1.0, 1.0);
  return r * r * (std::acos(part) - part * std::sqrt((1 - part) * (1 + part)));
}

}  // namespace

double sunlit_fraction(const Shadow& shadow, const Place& position, const Place& sun) {
  const Place to_sun = {sun[0] - position[0], sun[1] - position[1], sun[2] - position[2]};
  const Place to_body = {-position[0], -position[1], -position[2]};
  const double a = std::asin(std::min(1.0, shadow.sun_radius / length(to_sun)));
  const double b = std::asin(std::min(1.0, shadow.radius / length(position)));
  const double c = std::atan2(cross_length(to_sun, to_body), dot_product(to_sun, to_body));
  if (c >= a + b) return 1;
  const double disc = std::numbers::pi * a * a;
  if (c <= std::abs(b - a)) return b >= a ? 0 : 1 - (b / a) * (b / a);
  // The circles meet on a chord at x from the Sun's centre.
  const double x = (c * c + (a - b) * (a + b)) / (2 * c);
  return 1 - (cap(a, x) + cap(b, c - x)) / disc;
}

std::array<double, 3> distances_to_shadow(const Shadow& shadow, const Place& position,
                                          const Place& sun) {
  const double distance = length(sun);
  const double behind = -dot_product(position, sun) / distance;
  const double off_axis = cross_length(position, sun) / distance;
  const double opening = (shadow.sun_radius + shadow.radius) / distance;
  const double closing = (shadow.sun_radius - shadow.radius) / distance;
  const double cos_opening = std::sqrt((1 - opening) * (1 + opening));
  const double cos_closing = std::sqrt((1 - closing) * (1 + closing));
  return {std::max(off_axis * cos_opening - behind * opening - shadow.radius, -behind),
          std::max(off_axis * cos_closing + behind * closing - shadow.radius, -behind),
          std::max(off_axis * cos_closing - behind * closing + shadow.radius, -behind)};
}

std::optional<ShadowCrossing> next_crossing(const Shadow& shadow, const ShadowedPath& path,
                                            const std::array<bool, 3>& inside, double from,
                                            double to, double least_step) {
  const double direction = to < from ? -1 : 1;
  const auto distances_at = [&](double time) {
    return distances_to_shadow(shadow, path.position(time), path.sun(time));
  };
  double time = from;
  std::array<double, 3> distances = distances_at(time);
  while (time != to) {
    double least = std::abs(distances[0]);
    for (const double distance : distances) least = std::min(least, std::abs(distance));
    const double step = std::max(least_step, least / path.greatest_speed);
    const double next = step < std::abs(to - time) ? time + direction * step : to;
    const std::array<double, 3> after = distances_at(next);
    std::optional<ShadowCrossing> first;
    for (std::size_t i = 0; i < after.size(); ++i) {
      if (std::isfinite(after[i]) && (after[i] < 0) == inside[i]) continue;
      double root = next;
      // At the start the path may be on the boundary.
      if ((distances[i] < 0) == inside[i] && after[i] != 0) {
        constexpr int bits = 50;
        root = root_between(
            "shadow", [&](double t) { return distances_at(t)[i]; }, {time, distances[i]},
            {next, after[i]}, bits);
      }
      if (!first || (root - first->time) * direction < 0) {
        first = ShadowCrossing{root, static_cast<ShadowEdge>(i)};
      }
    }
    if (first) return first;
    time = next;
    distances = after;
  }
  return std::nullopt;
}

}  // namespace hamjet
