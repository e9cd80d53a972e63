#include "septic_spline.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <cstddef>

#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {
namespace {

using Block = Eigen::Matrix<SplineNumber, 3, 3>;
using Column = Eigen::Matrix<SplineNumber, 3, 1>;
using Weights = std::array<std::array<SplineNumber, 8>, 4>;

/// Hermite's basis on [0, 1]: the coefficients of the polynomials of degree 7
///
///   L_j(t) = t^j (1 - t)^4 sum over i <= 3 - j of binomial(3 + i, i) t^i
///
/// with L_j = t^j + O(t^4) at 0 and O((1 - t)^4) at 1. Those of the other end are L_j(1 - t).
/// Source: P. J. Davis, Interpolation and Approximation, section 2.5.
struct HermiteBasis {
  HermiteBasis() {
    constexpr std::array<int, 4> binomial = {1, 4, 10, 20};
    constexpr std::array<int, 5> fourth_power = {1, -4, 6, -4, 1};
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i + j < 4; ++i) {
        for (std::size_t k = 0; k < 5; ++k) at_near[j][j + i + k] += binomial[i] * fourth_power[k];
      }
      // The polynomial in 1 - t, by Horner's rule.
      std::array<SplineNumber, 8>& mirrored = at_far[j];
      for (std::size_t i = 8; i-- > 0;) {
        for (std::size_t k = 8; k-- > 1;) mirrored[k] -= mirrored[k - 1];
        mirrored[0] += at_near[j][i];
      }
    }
  }

  Weights at_near{};  // Coefficients of L_j(t).
  Weights at_far{};   // Coefficients of L_j(1 - t).
};

/// What c_j = s^(j) / j!, j < 4, of one end of an interval gives to s^(k) / k! at one of its ends:
/// at the same (near) or at the other one. `to_next` is the width, taken negative at the right end.
class Interval {
 public:
  explicit Interval(const SplineNumber& to_next) {
    powers_[0] = 1;
    for (std::size_t n = 1; n < 8; ++n) powers_[n] = powers_[n - 1] / to_next;
  }

  SplineNumber near(int j, int k) const { return weight(basis().at_near, j, k); }
  /// Seen from here the other end's d has the opposite direction.
  SplineNumber far(int j, int k) const {
    return (j % 2 == 0 ? 1 : -1) * weight(basis().at_far, j, k);
  }

 private:
  static const HermiteBasis& basis() {
    static const HermiteBasis instance;
    return instance;
  }
  SplineNumber weight(const Weights& weights, int j, int k) const {
    return weights[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)] *
           powers_[static_cast<std::size_t>(k - j)];
  }

  std::array<SplineNumber, 8> powers_;  // Of 1 / to_next.
};

/// The conditions on c_1 to c_3 of a node and its neighbours: before * c_before + here * c + after
/// * c_after = right.
struct Conditions {
  Block before = Block::Zero();
  Block here = Block::Zero();
  Block after = Block::Zero();
  Column right = Column::Zero();
};

/// Adds sign * s^(4+row) / (4+row)!, of so many rows, of an interval beside a node. `beyond` is the
/// block of its other end.
void add_derivatives(const Interval& interval, int sign, const SplineNumber& value,
                     const SplineNumber& value_beyond, int rows, Conditions& at, Block& beyond) {
  for (int row = 0; row < rows; ++row) {
    const int k = 4 + row;
    at.right(row) -= sign * (interval.near(0, k) * value + interval.far(0, k) * value_beyond);
    for (int j = 1; j < 4; ++j) {
      at.here(row, j - 1) += sign * interval.near(j, k);
      beyond(row, j - 1) += sign * interval.far(j, k);
    }
  }
}

}  // namespace

std::vector<std::array<SplineNumber, 8>> septic_spline(const std::vector<SplineNumber>& nodes,
                                                       const std::vector<SplineNumber>& values) {
  const std::size_t last = nodes.size() - 1;
  // Elimination of blocks, from the first node on: c = right - after * c_after.
  std::vector<Conditions> at(nodes.size());
  for (std::size_t i = 0; i <= last; ++i) {
    Conditions& c = at[i];
    const bool is_end = i == 0 || i == last;
    // At an end s'' = s''' = 0 and one derivative of the only interval vanishes.
    const int rows = is_end ? 1 : 3;
    if (i > 0) {
      add_derivatives(Interval(nodes[i - 1] - nodes[i]), -1, values[i], values[i - 1], rows, c,
                      c.before);
    }
    if (i < last) {
      add_derivatives(Interval(nodes[i + 1] - nodes[i]), 1, values[i], values[i + 1], rows, c,
                      c.after);
    }
    if (is_end) c.here(1, 1) = c.here(2, 2) = 1;
    if (i > 0) {
      c.right -= c.before * at[i - 1].right;
      c.here -= c.before * at[i - 1].after;
    }
    const Block inverse = c.here.inverse();
    c.right = inverse * c.right;
    c.after = inverse * c.after;
  }
  std::vector<std::array<SplineNumber, 8>> result(nodes.size());
  for (std::size_t i = last + 1; i-- > 0;) {
    if (i < last) at[i].right -= at[i].after * at[i + 1].right;
    result[i][0] = values[i];
    for (int j = 1; j < 4; ++j) result[i][static_cast<std::size_t>(j)] = at[i].right(j - 1);
  }
  for (std::size_t i = 0; i < last; ++i) {
    const Interval interval(nodes[i + 1] - nodes[i]);
    for (int k = 4; k < 8; ++k) {
      SplineNumber& sum = result[i][static_cast<std::size_t>(k)];
      for (int j = 0; j < 4; ++j) {
        const auto place = static_cast<std::size_t>(j);
        sum += interval.near(j, k) * result[i][place] + interval.far(j, k) * result[i + 1][place];
      }
    }
  }
  return result;
}

}  // namespace hamjet
