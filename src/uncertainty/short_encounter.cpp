#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "../algebra/symmetric_eigenvalues.hpp"
#include "encounter_trajectories.hpp"
#include "hamjet/error.hpp"
#include "hamjet/uncertainty/closest_approach.hpp"

namespace hamjet {
namespace {

using std::numbers::pi;

/// The problem that the formulas solve: a normal density in a plane, and a disc about its origin.
struct PlaneEncounter {
  double x, y;    ///< the mean
  double sx, sy;  ///< standard deviations
  double radius;
};

/// Beyond this many standard deviations the density is below 1e-31 of its peak.
constexpr double reach = 12;

/// The integral over an interval that is cut at places where the integrand may have a narrow peak.
/// The depth of halving is limited, because the rounding of the integrand, which no halving
/// removes, may exceed the tolerance.
template <class Function>
double integral(const Function& f, std::vector<double> cuts, unsigned halvings) {
  constexpr double tolerance = 1e-11;
  std::sort(cuts.begin(), cuts.end());
  double sum = 0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    if (!(cuts[k] < cuts[k + 1])) continue;
    sum += boost::math::quadrature::gauss_kronrod<double, 61>::integrate(f, cuts[k], cuts[k + 1],
                                                                         halvings, tolerance);
  }
  return sum;
}

double foster(const PlaneEncounter& e) {
  // Along a direction (c, s) the density is again normal, with mean r and standard deviation w. 61
  // points over 12 standard deviations to each side integrate it to rounding:
  //   1/w^2 = c^2/sx^2 + s^2/sy^2 ,   r = w^2 (c x/sx^2 + s y/sy^2) .
  const auto along = [&](double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    const double w = 1 / std::hypot(c / e.sx, s / e.sy);
    const double peak = w * w * (c * e.x / (e.sx * e.sx) + s * e.y / (e.sy * e.sy));
    const double middle = std::clamp(peak, 0.0, e.radius);
    const double from = std::max(0.0, middle - reach * w);
    const double to = std::min(e.radius, middle + reach * w);
    return integral(
        [&](double r) {
          const double x = (r * c - e.x) / e.sx, y = (r * s - e.y) / e.sy;
          return r * std::exp(-(x * x + y * y) / 2);
        },
        {from, middle, to}, 0);
  };
  // The density may be narrow about the directions of the mean and of the longer axis.
  const double mean = std::atan2(e.y, e.x), distance = std::hypot(e.x, e.y);
  const double widest = reach * std::max(e.sx, e.sy);
  const double width = distance > widest ? std::asin(widest / distance) : pi;
  std::vector<double> cuts = {mean - width, mean, mean + width};
  for (const double axis : {-1.5 * pi, -0.5 * pi, 0.5 * pi, 1.5 * pi}) {
    if (axis > mean - width && axis < mean + width) cuts.push_back(axis);
  }
  return integral(along, cuts, 6) / (2 * pi * e.sx * e.sy);
}

double alfano(const PlaneEncounter& e) {
  const auto column = [&](double x) {
    const double half = std::sqrt(std::max(0.0, e.radius * e.radius - x * x));
    const double scale = std::numbers::sqrt2 * e.sy, z = (x - e.x) / e.sx;
    // erf(b) - erf(a), by a form that does not cancel far from the mean.
    const double low = (-half - e.y) / scale, high = (half - e.y) / scale;
    const double share = low > 0    ? std::erfc(low) - std::erfc(high)
                         : high < 0 ? std::erfc(-high) - std::erfc(-low)
                                    : std::erf(high) - std::erf(low);
    return share * std::exp(-z * z / 2);
  };
  // With the angle t, x = radius sin(t), the integrand is smooth at the ends.
  const double middle = std::clamp(e.x, -e.radius, e.radius);
  const auto angle = [&](double x) { return std::asin(std::clamp(x / e.radius, -1.0, 1.0)); };
  return integral([&](double t) { return column(e.radius * std::sin(t)) * e.radius * std::cos(t); },
                  {angle(middle - reach * e.sx), angle(middle), angle(middle + reach * e.sx)}, 8) /
         (std::sqrt(8 * pi) * e.sx);
}

double chan(const PlaneEncounter& e) {
  const double u = e.radius * e.radius / (e.sx * e.sy) / 2;
  const double v = (e.x * e.x / (e.sx * e.sx) + e.y * e.y / (e.sy * e.sy)) / 2;
  // exp(-v) sum over m of v^m / m! (1 - exp(-u) sum over k <= m of u^k / k!), where the last factor
  // is a regularised gamma function.
  constexpr double longest_sum = 50000;
  if (v > longest_sum) {
    // The distance from the centre is normally distributed by then, up to terms of 1/v.
    const double mean = std::sqrt(2 * v) + 1 / (2 * std::sqrt(2 * v));
    return std::erfc((mean - std::sqrt(2 * u)) / std::numbers::sqrt2) / 2;
  }
  double sum = 0;
  for (int m = 0; m < 2 * longest_sum; ++m) {
    const double weight = std::exp(-v + m * std::log(std::max(v, 1e-300)) - std::lgamma(m + 1.0));
    const double term = weight * boost::math::gamma_p(m + 1.0, u);
    sum += term;
    if (m > v && term <= 1e-17 * sum) break;
  }
  return sum;
}

}  // namespace

ShortEncounter short_encounter(const EncounterProblem& problem, double time_of_closest_approach) {
  validate(problem);
  EncounterProblem linear = problem;
  linear.order = 1;
  const EncounterTrajectories trajectories(linear);
  const double time = time_of_closest_approach;
  const LinearRelativeState state = trajectories.linear(time);
  ShortEncounter result;
  result.time = time;
  result.distance = state.mean.head(3).norm();
  result.speed = state.mean.tail(3).norm();
  if (!(result.speed > 0)) {
    throw Error(ErrorKind::numerical, "short encounter: there is no relative velocity");
  }
  const Eigen::Vector3d along = state.mean.tail<3>() / result.speed;
  const auto covariance_of = [](const LinearRelativeState& s) {
    return Eigen::Matrix3d(s.by_deviation.topRows(3) * s.by_deviation.topRows(3).transpose());
  };
  const Eigen::Matrix3d covariance = covariance_of(state);
  const Eigen::Matrix<double, 3, 2> plane = plane_across(state).transpose();
  const auto principal = symmetric_eigenvalues(
      "short encounter", Eigen::Matrix2d(plane.transpose() * covariance * plane));
  const Eigen::Matrix<double, 3, 2> axes = plane * principal.eigenvectors();
  const Eigen::Vector2d offset = axes.transpose() * state.mean.head<3>();
  for (Eigen::Index i = 0; i < 2; ++i) {
    const auto k = static_cast<std::size_t>(i);
    result.offset[k] = offset[i];
    result.deviation[k] = std::sqrt(std::max(0.0, principal.eigenvalues()[i]));
  }
  if (!(result.deviation[0] > 1e-12 * result.deviation[1])) {
    throw Error(ErrorKind::numerical,
                "short encounter: the position is certain in a direction across the velocity");
  }
  const PlaneEncounter e{result.offset[0], result.offset[1], result.deviation[0],
                         result.deviation[1], problem.radius};
  result.foster = foster(e);
  result.alfano = alfano(e);
  result.chan = chan(e);
  // The same integral was computed along circles and along lines, because neither quadrature shows
  // its own error.
  constexpr double largest_difference = 1e-4;
  if (!(std::abs(result.foster - result.alfano) <=
        largest_difference * std::max(result.foster, result.alfano))) {
    throw Error(
        ErrorKind::numerical,
        fmt::format("short encounter: two quadratures of the density disagree, {:.3g} along "
                    "directions and {:.3g} along lines; it is too flat",
                    result.foster, result.alfano));
  }

  const double spread = std::sqrt(std::max(0.0, along.dot(covariance * along)));
  result.passage = (problem.radius + 3 * spread) / result.speed;
  result.is_cut = time - result.passage < problem.from || time + result.passage > problem.to;
  for (const double side : {-1.0, 1.0}) {
    const double then = std::clamp(time + side * result.passage, problem.from, problem.to);
    const LinearRelativeState other = trajectories.linear(then);
    const Eigen::Vector3d straight = state.mean.head<3>() + (then - time) * state.mean.tail<3>();
    const Eigen::Vector2d bend = axes.transpose() * (other.mean.head<3>() - straight);
    const Eigen::Matrix2d changed = axes.transpose() * covariance_of(other) * axes;
    for (Eigen::Index i = 0; i < 2; ++i) {
      const double deviation = result.deviation[static_cast<std::size_t>(i)];
      result.departure = std::max({result.departure, std::abs(bend[i]) / deviation,
                                   std::abs(std::sqrt(changed(i, i)) / deviation - 1)});
    }
  }
  return result;
}

}  // namespace hamjet
