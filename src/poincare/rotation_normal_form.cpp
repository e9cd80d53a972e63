#include "rotation_normal_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <complex>

#include "hamjet/algebra/calculus.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

using Complex = std::complex<double>;
using Coefficients = std::vector<Complex>;

/// One variable of a pair as a linear combination of two others.
struct Combination {
  Complex first;
  Complex second;
};
constexpr Combination x_of_w{{0.5, 0}, {0.5, 0}};   // X = (w + w*) / 2
constexpr Combination y_of_w{{0, -0.5}, {0, 0.5}};  // Y = (w - w*) / 2i
constexpr Combination w_of_xy{{1, 0}, {0, 1}};
constexpr Combination conjugate_of_xy{{1, 0}, {0, -1}};

/// The powers of a combination: coefficients of first^k second^(n - k).
Coefficients power(const Combination& base, int n) {
  Coefficients result = {Complex(1)};
  for (int i = 0; i < n; ++i) {
    Coefficients next(result.size() + 1);
    for (std::size_t k = 0; k < result.size(); ++k) {
      next[k + 1] += result[k] * base.first;
      next[k] += result[k] * base.second;
    }
    result = std::move(next);
  }
  return result;
}

/// The polynomial with its pair of variables replaced by combinations of two others, in the same
/// places.
Coefficients substituted(const SeriesSpace& space, const Coefficients& given, const Combination& q,
                         const Combination& p) {
  Coefficients result(given.size());
  for (std::size_t m = 0; m < given.size(); ++m) {
    if (given[m] == Complex(0)) continue;
    const auto exponents = space.exponents(m);
    const int n_q = exponents[q_variable];
    const int n_p = exponents[p_variable];
    const Coefficients by_q = power(q, n_q);
    const Coefficients by_p = power(p, n_p);
    std::array<std::uint8_t, nodal_variables> to;
    std::copy(exponents.begin(), exponents.end(), to.begin());
    for (std::size_t i = 0; i < by_q.size(); ++i) {
      for (std::size_t k = 0; k < by_p.size(); ++k) {
        const std::size_t first = i + k;
        to[q_variable] = static_cast<std::uint8_t>(first);
        to[p_variable] = static_cast<std::uint8_t>(static_cast<std::size_t>(n_q + n_p) - first);
        result[space.index(to)] += given[m] * by_q[i] * by_p[k];
      }
    }
  }
  return result;
}

/// The power of w less that of its conjugate.
int excess(const SeriesSpace& space, std::size_t monomial) {
  const auto exponents = space.exponents(monomial);
  return static_cast<int>(exponents[q_variable]) - static_cast<int>(exponents[p_variable]);
}

}  // namespace

RotationNormalForm::RotationNormalForm(const NodalFlight<double>& flight)
    : space_(flight.q.space_pointer()),
      turn_cosine_(space_),
      turn_sine_(space_),
      period_(space_),
      node_(space_),
      action_(space_) {
  const auto variable = [&](std::size_t i) { return Series<double>::variable(space_, i); };
  const auto slope = [&](const Series<double>& s, NodalVariable v) {
    return s[space_->linear_index(v)];
  };
  const double cosine = (slope(flight.q, q_variable) + slope(flight.p, p_variable)) / 2;
  if (!(std::abs(cosine) < 1)) {
    // The rounding of a sum of numbers near 1.
    constexpr double rounding = 1e-14;
    throw Error(ErrorKind::numerical,
                std::abs(cosine) < 1 + rounding
                    ? "normal form: to double precision both multipliers are 1 or -1, so that no "
                      "turn about the frozen orbit can be told"
                    : fmt::format("normal form: the frozen orbit is unstable, its multipliers add "
                                  "up to {:.12g}, beyond 2, so that no orbit librates about it",
                                  2 * cosine));
  }
  // The linear return as a turn, by the axes of its invariant ellipse (Courant and Snyder):
  // q = sqrt(beta) X, p = (Y - alpha X) / sqrt(beta), w' = exp(-i mu) w.
  const double b = slope(flight.q, p_variable);
  const double sine = std::copysign(std::sqrt((1 - cosine) * (1 + cosine)), b);
  const double beta = b / sine;
  const double alpha = (slope(flight.q, q_variable) - slope(flight.p, p_variable)) / (2 * sine);
  linear_turn_ = -std::atan2(sine, cosine);
  const double root = std::sqrt(beta);
  const Complex lambda = std::polar(1.0, linear_turn_);

  // The return in (u_0, X, u_H, Y).
  std::vector<Series<double>> to_pair = {
      variable(energy_variable), root * variable(q_variable), variable(momentum_variable),
      (variable(p_variable) - alpha * variable(q_variable)) / root};
  std::vector<Series<double>> outer =
      compose(without_constants(std::vector<Series<double>>{flight.q, flight.p}), to_pair);
  const std::vector<Series<double>> back = {variable(energy_variable), outer[0] / root,
                                            variable(momentum_variable),
                                            root * outer[1] + alpha * outer[0] / root};
  std::vector<Series<double>> transform = {variable(0), variable(1), variable(2), variable(3)};
  std::vector<Series<double>> normal = transform;
  const double c = lambda.real(), s = lambda.imag();
  normal[q_variable] = c * variable(q_variable) - s * variable(p_variable);
  normal[p_variable] = s * variable(q_variable) + c * variable(p_variable);

  // A term r u^a w^j w*^k of back(transform) - transform(normal) is taken out by
  // -r / (lambda - lambda^(j - k)) in the transformation, but where j - k = 1, which stays.
  const SeriesSpace& space = *space_;
  Coefficients kept(space.size());
  for (int degree = 1; degree <= space.order(); ++degree) {
    const auto reached = compose(back, transform);
    const auto wanted = compose(transform, normal);
    Coefficients left(space.size());
    for (std::size_t m = space.first(degree); m < space.first(degree + 1); ++m) {
      left[m] = {reached[q_variable][m] - wanted[q_variable][m],
                 reached[p_variable][m] - wanted[p_variable][m]};
    }
    left = substituted(space, left, x_of_w, y_of_w);
    Coefficients change(space.size());
    Coefficients stays(space.size());
    for (std::size_t m = space.first(degree); m < space.first(degree + 1); ++m) {
      const int n = excess(space, m);
      if (n == 1) {
        stays[m] = left[m];
        continue;
      }
      const Complex divisor = lambda - std::polar(1.0, linear_turn_ * n);
      smallest_divisor_ = std::min(smallest_divisor_, std::abs(divisor));
      change[m] = -left[m] / divisor;
    }
    for (std::size_t m = 0; m < space.size(); ++m) kept[m] += stays[m];
    change = substituted(space, change, w_of_xy, conjugate_of_xy);
    stays = substituted(space, stays, w_of_xy, conjugate_of_xy);
    for (std::size_t m = space.first(degree); m < space.first(degree + 1); ++m) {
      transform[q_variable][m] += change[m].real();
      transform[p_variable][m] += change[m].imag();
      normal[q_variable][m] += stays[m].real();
      normal[p_variable][m] += stays[m].imag();
    }
  }
  constexpr double least_divisor = 1e-9;
  if (smallest_divisor_ < least_divisor) {
    throw Error(
        ErrorKind::numerical,
        fmt::format("normal form: resonance, a divisor of order {} or below is {:.2g}, less "
                    "than what the series resolve",
                    space.order(), smallest_divisor_));
  }
  transformation_ = compose(to_pair, transform);
  // nu of a circle: terms w^(k+1) w*^k are kept as those of equal powers, w taken off; see value.
  for (std::size_t m = 0; m < space.size(); ++m) {
    turn_cosine_[m] = kept[m].real();
    turn_sine_[m] = kept[m].imag();
  }
  period_ = mean(flight.time);
  node_ = mean(flight.node);
  // The area over 2 pi is the mean of (q dp - p dq)/2 over the angle, d/dangle = X d_Y - Y d_X.
  const auto by_angle = [&](const Series<double>& series) {
    return variable(q_variable) * derivative(series, p_variable) -
           variable(p_variable) * derivative(series, q_variable);
  };
  const Series<double>& q = transformation_[q_variable];
  const Series<double>& p = transformation_[p_variable];
  const Series<double> area = (q * by_angle(p) - p * by_angle(q)) / 2;
  Coefficients terms(area.coefficients().begin(), area.coefficients().end());
  terms = substituted(space, terms, x_of_w, y_of_w);
  for (std::size_t m = 0; m < space.size(); ++m) {
    if (excess(space, m) == 0) action_[m] = terms[m].real();
  }
}

Series<double> RotationNormalForm::mean(const Series<double>& series) const {
  Series<double> without = series;
  without[0] = 0;
  const Series<double> composed = compose({without}, transformation_)[0];
  Coefficients terms(composed.coefficients().begin(), composed.coefficients().end());
  terms = substituted(*space_, terms, x_of_w, y_of_w);
  Series<double> result(space_);
  for (std::size_t m = 0; m < result.size(); ++m) {
    if (excess(*space_, m) == 0) result[m] = terms[m].real();
  }
  result[0] = series[0];
  return result;
}

double RotationNormalForm::value(const Series<double>& series, const Circle& circle) const {
  const std::array<double, nodal_variables> point = {circle.energy, circle.radius, circle.momentum,
                                                     circle.radius};
  return evaluate<double>(series, point);
}

double RotationNormalForm::rotation_number(const Circle& circle) const {
  // Of w^(k+1) w*^k the values at w = w* = |w| are nu's terms times |w|; a circle of no radius has
  // the turn of its neighbours.
  constexpr double least_radius = 1e-8;
  Circle taken = circle;
  taken.radius = std::max(circle.radius, least_radius);
  const Complex linear = std::polar(1.0, linear_turn_);
  const Complex nu =
      linear + Complex(value(turn_cosine_, taken), value(turn_sine_, taken)) / taken.radius;
  return (linear_turn_ + std::arg(nu / linear)) / boost::math::double_constants::two_pi;
}

double RotationNormalForm::angle_after(const Circle& circle, double angle, double returns) const {
  return angle + boost::math::double_constants::two_pi * rotation_number(circle) * returns;
}

std::optional<RotationNormalForm::Place> RotationNormalForm::place_of(
    const std::array<double, 2>& wanted) const {
  // Newton's method on (X, Y), from the inverse of the linear part.
  constexpr int most_iterations = 40;
  const Series<double>& q = transformation_[q_variable];
  const Series<double>& p = transformation_[p_variable];
  const std::array<Series<double>, 4> slopes = {
      derivative(q, q_variable), derivative(q, p_variable), derivative(p, q_variable),
      derivative(p, p_variable)};
  std::array<double, nodal_variables> point = {};
  const double size = std::hypot(wanted[0], wanted[1]);
  for (int i = 0; i < most_iterations; ++i) {
    const double miss_q = evaluate<double>(q, point) - wanted[0];
    const double miss_p = evaluate<double>(p, point) - wanted[1];
    const double radius = std::hypot(point[q_variable], point[p_variable]);
    if (std::hypot(miss_q, miss_p) <= 1e-13 * size) {
      return Place{{radius, 0, 0}, std::atan2(point[p_variable], point[q_variable])};
    }
    std::array<double, 4> d;
    for (std::size_t k = 0; k < 4; ++k) d[k] = evaluate<double>(slopes[k], point);
    const double determinant = d[0] * d[3] - d[1] * d[2];
    point[q_variable] -= (d[3] * miss_q - d[1] * miss_p) / determinant;
    point[p_variable] -= (d[0] * miss_p - d[2] * miss_q) / determinant;
    if (!std::isfinite(point[q_variable] + point[p_variable])) break;
  }
  return std::nullopt;
}

std::array<double, 2> RotationNormalForm::pair(const Circle& circle, double angle) const {
  const std::array<double, nodal_variables> point = {circle.energy, circle.radius * std::cos(angle),
                                                     circle.momentum,
                                                     circle.radius * std::sin(angle)};
  return {evaluate<double>(transformation_[q_variable], point),
          evaluate<double>(transformation_[p_variable], point)};
}

}  // namespace hamjet
