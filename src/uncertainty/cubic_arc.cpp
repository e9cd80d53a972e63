#include "cubic_arc.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "../algebra/scalar_search.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// Parts of an interval shorter than this are not distinguished: a millionth of a second in half an
/// hour.
constexpr double shortest_part = 1e-9;
/// The number of halvings until a part is as short as that.
constexpr int deepest = 30;

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

LinearRelativeState between(const LinearRelativeState& start, const LinearRelativeState& end,
                            double length, double part) {
  const HermiteWeights w = hermite_weights(length, part);
  const auto combine = [&](const auto& first, const auto& last) {
    std::remove_cvref_t<decltype(first)> result;
    result.topRows(3) = w.position[0] * first.topRows(3) + w.position[1] * first.bottomRows(3) +
                        w.position[2] * last.topRows(3) + w.position[3] * last.bottomRows(3);
    result.bottomRows(3) = w.velocity[0] * first.topRows(3) + w.velocity[1] * first.bottomRows(3) +
                           w.velocity[2] * last.topRows(3) + w.velocity[3] * last.bottomRows(3);
    return result;
  };
  return {combine(start.mean, end.mean), combine(start.by_deviation, end.by_deviation)};
}

SquaredDistance::SquaredDistance(const std::array<double, 6>& start,
                                 const std::array<double, 6>& end, double length) {
  // Bezier's points of the cubic, and the product of two polynomials in Bernstein's basis:
  //   c_m = sum over i + j = m of binomial(3, i) binomial(3, j) / binomial(6, m) b_i . b_j .
  std::array<double, 3> b0{};
  std::array<double, 3> b1{};
  std::array<double, 3> b2{};
  std::array<double, 3> b3{};
  for (std::size_t i = 0; i < 3; ++i) {
    b0[i] = start[i];
    b1[i] = start[i] + length / 3 * start[i + 3];
    b2[i] = end[i] - length / 3 * end[i + 3];
    b3[i] = end[i];
  }
  c_ = {dot(b0, b0),
        dot(b0, b1),
        (2 * dot(b0, b2) + 3 * dot(b1, b1)) / 5,
        (dot(b0, b3) + 9 * dot(b1, b2)) / 10,
        (2 * dot(b1, b3) + 3 * dot(b2, b2)) / 5,
        dot(b2, b3),
        dot(b3, b3)};
  // With NaN, no distance would be below the square.
  if (!std::isfinite(std::accumulate(c_.begin(), c_.end(), 0.0))) {
    throw Error(ErrorKind::numerical, "encounter: the path of a spacecraft is not finite");
  }
}

double SquaredDistance::lower_bound() const { return *std::min_element(c_.begin(), c_.end()); }

std::array<SquaredDistance, 2> SquaredDistance::halves() const {
  // De Casteljau's triangle.
  std::array<double, 7> row = c_;
  std::array<double, 7> left{};
  std::array<double, 7> right{};
  for (std::size_t k = 0; k < 7; ++k) {
    left[k] = row[0];
    right[6 - k] = row[6 - k];
    for (std::size_t i = 0; i + 1 < 7 - k; ++i) row[i] = (row[i] + row[i + 1]) / 2;
  }
  return {SquaredDistance(left), SquaredDistance(right)};
}

double SquaredDistance::at(double part) const {
  std::array<double, 7> row = c_;
  for (std::size_t k = 6; k > 0; --k) {
    for (std::size_t i = 0; i < k; ++i) row[i] += part * (row[i + 1] - row[i]);
  }
  return row[0];
}

void SquaredDistance::entries(double square, std::vector<double>& parts) const {
  entries(square, 0, 1, parts);
}

int SquaredDistance::crossings(double square) const {
  // By Descartes' rule there are no more roots than changes of sign among the coefficients, and
  // their number has the same parity.
  int changes = 0;
  for (std::size_t i = 0; i + 1 < 7; ++i) changes += (c_[i] < square) != (c_[i + 1] < square);
  return changes;
}

bool SquaredDistance::enters(double square, double length) const {
  const int changes = crossings(square);
  if (changes == 0) return false;
  if (changes == 1 || length < shortest_part) return c_[0] >= square && c_[6] < square;
  const auto [left, right] = halves();
  return left.enters(square, length / 2) || right.enters(square, length / 2);
}

void SquaredDistance::entries(double square, double from, double to,
                              std::vector<double>& parts) const {
  const int changes = crossings(square);
  if (changes == 0) return;
  if (changes == 1 || to - from < shortest_part) {
    if (c_[0] < square || c_[6] >= square) return;
    const double part = root_between(
        "entries of a path", [&](double x) { return at(x) - square; }, {0, c_[0] - square},
        {1, c_[6] - square}, 40);
    parts.push_back(from + (to - from) * part);
    return;
  }
  const auto [left, right] = halves();
  const double middle = (from + to) / 2;
  left.entries(square, from, middle, parts);
  right.entries(square, middle, to, parts);
}

double SquaredDistance::least(double best) const { return least(best, 0); }

double SquaredDistance::least(double best, int depth) const {
  // Where the arc passes through the origin itself, the squares are rounding errors of either sign.
  best = std::max(std::min({best, c_[0], c_[6]}), 0.0);
  const double bound = lower_bound();
  double largest = 0;
  for (const double c : c_) largest = std::max(largest, std::abs(c));
  if (best - bound <= 1e-12 * best + 1e-15 * largest || depth == deepest) return best;
  const auto [left, right] = halves();
  // The half with the higher lower bound is put aside, so that the more promising one is searched
  // first.
  return left.lower_bound() < right.lower_bound()
             ? right.least(left.least(best, depth + 1), depth + 1)
             : left.least(right.least(best, depth + 1), depth + 1);
}

}  // namespace hamjet
