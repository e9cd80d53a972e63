#include "piecewise_hermite.hpp"

#include <algorithm>
#include <cmath>

namespace hamjet {
namespace {

/// The first coefficients, about x0, of the polynomial through points whose first is at x0:
/// Newton's form, with divided differences, multiplied out.
template <std::size_t count>
std::array<double, count> taylor_through(const std::vector<double>& x, std::vector<double> f) {
  const std::size_t n = x.size();
  for (std::size_t order = 1; order < n; ++order) {
    for (std::size_t i = n - 1; i >= order; --i) f[i] = (f[i] - f[i - 1]) / (x[i] - x[i - order]);
  }
  std::array<double, count> result{};
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = count; k-- > 0;) {
      result[k] = (k > 0 ? result[k - 1] : f[i]) - (x[i] - x[0]) * result[k];
    }
  }
  return result;
}

/// Turns a polynomial in x into one in x - shift, of which the coefficients up to `most` are right.
template <class Real, std::size_t count>
void shift_polynomial(std::array<Real, count>& c, const Real& shift, int most) {
  for (int k = 0; k <= most; ++k) {
    for (int i = static_cast<int>(count) - 2; i >= k; --i) {
      c[static_cast<std::size_t>(i)] += shift * c[static_cast<std::size_t>(i) + 1];
    }
  }
}

template <class Real, std::size_t count>
void scale_polynomial(std::array<Real, count>& c, const Real& factor, int most) {
  Real power = factor;
  for (int k = 1; k <= most; ++k, power *= factor) c[static_cast<std::size_t>(k)] *= power;
}

constexpr std::size_t of_node = 4;  ///< value and derivatives that neighbours share
using OfNode = std::array<double, of_node>;

/// The polynomial of degree 7 from 0 to 1 that has f^(k)/k! at the ends of a piece of length h.
/// With p the Taylor polynomial of degree 3 at the left end, what is missing is x^4 q(x) with q of
/// degree
/// 3. About the right end, with y = x - 1, q is the missing r(y) there times (1 + y)^-4.
PiecewiseHermite::Coefficients<Extended> polynomial_between(const OfNode& left, const OfNode& right,
                                                            const Extended& h) {
  PiecewiseHermite::Coefficients<Extended> c{};
  std::array<Extended, of_node> r;
  Extended power = 1;
  for (std::size_t k = 0; k < of_node; ++k, power *= h) {
    c[k] = left[k] * power;
    r[k] = right[k] * power;
  }
  r[0] -= c[0] + c[1] + c[2] + c[3];
  r[1] -= c[1] + 2 * c[2] + 3 * c[3];
  r[2] -= c[2] + 3 * c[3];
  r[3] -= c[3];
  const Extended s0 = r[0];
  const Extended s1 = r[1] - 4 * r[0];
  const Extended s2 = r[2] - 4 * r[1] + 10 * r[0];
  const Extended s3 = r[3] - 4 * r[2] + 10 * r[1] - 20 * r[0];
  c[4] = s0 - s1 + s2 - s3;
  c[5] = s1 - 2 * s2 + 3 * s3;
  c[6] = s2 - 3 * s3;
  c[7] = s3;
  return c;
}

}  // namespace

PiecewiseHermite::PiecewiseHermite(std::vector<double> nodes,
                                   const std::vector<std::vector<double>>& values,
                                   std::size_t reach, const Extended& scale)
    : nodes_(std::move(nodes)),
      components_(values.size()),
      scale_(scale),
      scale_high_(convert<double>(scale)),
      pieces_per_variable_(static_cast<double>(nodes_.size() - 1) / (nodes_.back() - nodes_[0])) {
  const std::size_t n = nodes_.size();
  const std::size_t width = std::min(n, 2 * reach + 1);
  std::vector<OfNode> of_nodes(n * components_);
  std::vector<double> x(width), f(width);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t begin = std::min(i > reach ? i - reach : 0, n - width);
    // The node itself comes first, for the polynomial is wanted about it.
    const auto place = [&](std::size_t k) {
      return k == 0 ? i : (begin + k - 1 < i ? begin + k - 1 : begin + k);
    };
    for (std::size_t k = 0; k < width; ++k) x[k] = nodes_[place(k)] - nodes_[i];
    for (std::size_t c = 0; c < components_; ++c) {
      for (std::size_t k = 0; k < width; ++k) f[k] = values[c][place(k)];
      of_nodes[i * components_ + c] = taylor_through<of_node>(x, f);
    }
  }
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Extended h = Extended(nodes_[i + 1]) - nodes_[i];
    for (std::size_t c = 0; c < components_; ++c) {
      const auto polynomial =
          polynomial_between(of_nodes[i * components_ + c], of_nodes[(i + 1) * components_ + c], h);
      exact_pieces_.insert(exact_pieces_.end(), polynomial.begin(), polynomial.end());
    }
  }
  for (const Extended& x_k : exact_pieces_) pieces_.push_back(convert<double>(x_k));
}

std::size_t PiecewiseHermite::piece_at(double variable) const {
  const auto last = static_cast<double>(nodes_.size() - 2);
  const double guess = std::clamp((variable - nodes_.front()) * pieces_per_variable_, 0.0, last);
  auto piece = static_cast<std::size_t>(guess);
  while (piece > 0 && variable < nodes_[piece]) --piece;
  while (piece + 2 < nodes_.size() && variable >= nodes_[piece + 1]) ++piece;
  return piece;
}

void PiecewiseHermite::expand(double t, int most, Coefficients<double>* out) const {
  const double variable = scale_high_ * t;
  const std::size_t piece = piece_at(variable);
  const double h = nodes_[piece + 1] - nodes_[piece];
  const double x = (variable - nodes_[piece]) / h;
  const double* from = &pieces_[piece * components_ * (degree + 1)];
  const int known = std::min(most, degree);
  for (std::size_t c = 0; c < components_; ++c, from += degree + 1) {
    if (known == 0) {
      double sum = from[degree];
      for (int k = degree - 1; k >= 0; --k) sum = sum * x + from[k];
      out[c][0] = sum;
      continue;
    }
    std::copy(from, from + degree + 1, out[c].begin());
    shift_polynomial(out[c], x, known);
    scale_polynomial(out[c], scale_high_ / h, known);
  }
}

void PiecewiseHermite::expand(const Extended& t, int most, Coefficients<Extended>* out) const {
  const Extended variable = scale_ * t;
  const std::size_t piece = piece_at(convert<double>(variable));
  const Extended h = Extended(nodes_[piece + 1]) - nodes_[piece];
  const Extended x = (variable - nodes_[piece]) / h;
  const Extended* from = &exact_pieces_[piece * components_ * (degree + 1)];
  const int known = std::min(most, degree);
  for (std::size_t c = 0; c < components_; ++c, from += degree + 1) {
    std::copy(from, from + degree + 1, out[c].begin());
    shift_polynomial(out[c], x, known);
    scale_polynomial(out[c], Extended(scale_ / h), known);
  }
}

}  // namespace hamjet
