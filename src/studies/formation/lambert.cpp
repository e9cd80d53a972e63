#include "lambert.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "../../algebra/scalar_search.hpp"

namespace hamjet {
namespace {

using std::numbers::pi;

/// The time equation: with the chord c, s = (r1 + r2 + c) / 2 and lambda^2 = 1 - c / s, an ellipse
/// of a = s / (2 (1 - x^2)) takes the time T sqrt(s^3 / 2), where
///
///   T = ((psi + N pi) / sqrt(1 - x^2) - x + lambda y) / (1 - x^2) ,
///   y = sqrt(1 - lambda^2 (1 - x^2)) ,  cos psi = x y + lambda (1 - x^2) ,
///   sin psi = (y - lambda x) sqrt(1 - x^2) .
struct TimeEquation {
  double lambda = 0;
  int revolutions = 0;

  double y(double x) const { return std::sqrt(1 - lambda * lambda * (1 - x * x)); }
  double time(double x) const {
    const double room = (1 - x) * (1 + x);
    const double psi = std::atan2((y(x) - lambda * x) * std::sqrt(room), x * y(x) + lambda * room);
    return ((psi + revolutions * pi) / std::sqrt(room) - x + lambda * y(x)) / room;
  }
};

/// Beyond these values of x an ellipse is nearly a parabola, or falls through the centre.
constexpr double outermost = 1 - 1e-9;

/// The root of T(x) = time between two x at which T - time has different signs; empty if the signs
/// are equal. Throws as root_between, also if a value is NaN.
std::vector<double> shape_between(const TimeEquation& equation, double time, double a, double b) {
  const auto difference = [&](double x) { return equation.time(x) - time; };
  const double at_a = difference(a), at_b = difference(b);
  if (at_a * at_b > 0) return {};
  return {root_between("ellipses between two places", difference, {a, at_a}, {b, at_b}, 50)};
}

/// Without a whole revolution there is one root, because the time falls with x; with some there are
/// two, on either side of the minimum.
std::vector<double> roots(const TimeEquation& equation, double time) {
  if (equation.revolutions == 0) return shape_between(equation, time, -outermost, outermost);
  constexpr int bits = 26;
  const double least = minimum_between(
                           "ellipses between two places",
                           [&](double x) { return equation.time(x); }, -outermost, outermost, bits)
                           .place;
  std::vector<double> found = shape_between(equation, time, -outermost, least);
  const std::vector<double> other = shape_between(equation, time, least, outermost);
  found.insert(found.end(), other.begin(), other.end());
  return found;
}

}  // namespace

double angle_about(const Eigen::Vector3d& first, const Eigen::Vector3d& last,
                   const Eigen::Vector3d& momentum) {
  const double sine = first.cross(last).dot(momentum.normalized());
  const double angle = std::atan2(sine, first.dot(last));
  return angle < 0 ? angle + 2 * pi : angle;
}

std::vector<LambertEllipse> lambert_ellipses(const Eigen::Vector3d& first,
                                             const Eigen::Vector3d& last, double time,
                                             int revolutions, const Eigen::Vector3d& momentum) {
  const double r1 = first.norm(), r2 = last.norm();
  const double chord = (last - first).norm();
  const double s = (r1 + r2 + chord) / 2;
  const bool is_short = angle_about(first, last, momentum) <= pi;
  // lambda = sqrt(r1 r2) cos(theta / 2) / s, which avoids the difference 1 - c / s.
  const double cosine = first.dot(last) / (r1 * r2);
  const double half = std::sqrt(std::max(0.0, (1 + cosine) / 2));
  TimeEquation equation;
  equation.lambda = (is_short ? 1 : -1) * std::sqrt(r1 * r2) * half / s;
  equation.revolutions = revolutions;
  // The normal of the plane, in the sense of the motion.
  const Eigen::Vector3d u1 = first / r1;
  Eigen::Vector3d normal = (is_short ? 1 : -1) * u1.cross(last / r2);
  constexpr double on_a_line = 1e-6;
  if (normal.norm() < on_a_line) normal = momentum - momentum.dot(u1) * u1;
  const Eigen::Vector3d along = normal.normalized().cross(u1);
  // If c = 0, both ends are one point, and the ratio has no influence.
  const double rho = chord > 0 ? (r1 - r2) / chord : 0;
  const double sigma = std::sqrt(std::max(0.0, 1 - rho * rho));
  const double gamma = std::sqrt(s / 2);
  std::vector<LambertEllipse> ellipses;
  for (const double x : roots(equation, time * std::sqrt(2 / (s * s * s)))) {
    const double y = equation.y(x), lambda = equation.lambda;
    const double radial = gamma * ((lambda * y - x) - rho * (lambda * y + x)) / r1;
    const double transverse = gamma * sigma * (y + lambda * x) / r1;
    ellipses.push_back({radial * u1 + transverse * along, s / (2 * (1 - x) * (1 + x))});
  }
  std::sort(ellipses.begin(), ellipses.end(), [](const LambertEllipse& a, const LambertEllipse& b) {
    return a.semi_major_axis < b.semi_major_axis;
  });
  return ellipses;
}

}  // namespace hamjet
