#include "sunlight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

void require_in_order(bool is_in_order) {
  if (!is_in_order) {
    throw Error(ErrorKind::usage, "sunlight: an edge lies among earlier edges, must be beyond");
  }
}

}  // namespace

Sunlight::Piece Sunlight::interpolated(const std::function<double(double)>& fraction, double from,
                                       double to) {
  constexpr std::size_t n = 16;
  Piece piece{from + (to - from) / 2, (to - from) / 2, std::vector<double>(n + 1, 0)};
  const auto cosine = [](std::size_t k, std::size_t j) {
    return std::cos(std::numbers::pi * static_cast<double>(k * j) / n);
  };
  std::array<double, n + 1> values;
  for (std::size_t j = 0; j <= n; ++j) {
    const double share = (1 + cosine(1, j)) / 2;
    values[j] = fraction(j == 0 ? to : (j == n ? from : from + share * (to - from)));
  }
  // Coefficients of T_k, by the sums that are exact for a polynomial of degree n; then powers, by
  // T_(k+1) = 2 s T_k - T_(k-1).
  std::array<double, n + 1> before{}, present{};
  for (std::size_t k = 0; k <= n; ++k) {
    double sum = 0;
    for (std::size_t j = 0; j <= n; ++j) {
      sum += (j == 0 || j == n ? 0.5 : 1) * values[j] * cosine(k, j);
    }
    const double coefficient = sum * (k == 0 || k == n ? 1.0 : 2.0) / n;
    std::array<double, n + 1> next{};
    if (k == 0) {
      next[0] = 1;
    } else {
      for (std::size_t i = 0; i < n; ++i) next[i + 1] = (k == 1 ? 1 : 2) * present[i];
      for (std::size_t i = 0; i <= n; ++i) next[i] -= before[i];
    }
    before = k == 0 ? before : present;
    present = next;
    for (std::size_t i = 0; i <= n; ++i) piece.coefficients[i] += coefficient * present[i];
  }
  return piece;
}

void Sunlight::append(double edge, Piece piece) {
  require_in_order(edges_.empty() || edge > edges_.back());
  edges_.push_back(edge);
  pieces_.push_back(std::move(piece));
}

void Sunlight::prepend(double edge, Piece piece) {
  require_in_order(edges_.empty() || edge < edges_.front());
  edges_.insert(edges_.begin(), edge);
  pieces_.insert(pieces_.begin(), std::move(piece));
}

template <class Real>
void Sunlight::expand_as(const Real& t, int degree, Real* out) const {
  const auto place = std::upper_bound(edges_.begin(), edges_.end(), t,
                                      [](const Real& a, double b) { return a < Real(b); });
  const Piece& piece = pieces_[static_cast<std::size_t>(place - edges_.begin())];
  std::fill(out, out + degree + 1, Real(0));
  const std::size_t size = piece.coefficients.size();
  std::vector<Real> shifted(piece.coefficients.begin(), piece.coefficients.end());
  const Real s = (t - Real(piece.middle)) / Real(piece.half);
  Real unit(1);
  for (std::size_t k = 0; k < size && k <= static_cast<std::size_t>(degree); ++k) {
    for (std::size_t j = size - 1; j > k; --j) shifted[j - 1] += s * shifted[j];
    out[k] = shifted[k] * unit;
    unit /= Real(piece.half);
  }
}

template void Sunlight::expand_as(const double&, int, double*) const;
template void Sunlight::expand_as(const Extended&, int, Extended*) const;

}  // namespace hamjet
