#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "orbits.hpp"

namespace hamjet {

/// The linear equations of the stages of orbits side by side,
///
///   (I - W (x) Dg) Y = R ,
///
/// solved by elimination in blocks of the m components, without pivoting; the matrix is that of
/// StageSystem. With the stages as rows of blocks, A = L U, where the diagonal blocks of U are the
/// identity; each block is processed in registers. Components 0 means that their number is known at
/// run time only.
template <int Components>
class LaneElimination {
 public:
  /// The number of columns that are solved for together; they stand at (i m + c) width + column.
  static constexpr std::size_t width = 3;

  /// `coupling` has the entries a_ij of W / scale, by rows.
  LaneElimination(std::size_t components, std::size_t stages, const std::vector<double>& coupling)
      : components_(components),
        stages_(stages),
        coupling_(coupling),
        blocks_(stages * stages * components * components),
        scaled_(stages * components * components) {}

  /// Takes the gradients in the layout of LaneField, and the factors by which the entries (c, k) of
  /// a block are compared with one another, at c m + k.
  [[gnu::flatten]] void take(const std::vector<Orbits>& gradients, const Orbits& scale,
                             std::vector<Orbits> entry_weights) {
    const std::size_t m = components();
    entry_weights_ = std::move(entry_weights);
    for (std::size_t j = 0; j < stages_; ++j) {
      for (std::size_t e = 0; e < m * m; ++e) {
        scaled_[j * m * m + e] = scale * gradients[e * stages_ + j];
      }
    }
  }

  /// Entry (c, k) of scale Dg at stage j.
  const Orbits& scaled_gradient(std::size_t c, std::size_t k, std::size_t j) const {
    return scaled_[(j * components() + c) * components() + k];
  }

  /// Eliminates the matrix of the gradients that were taken. Returns, for each orbit, the largest
  /// weighted entry of L, U and the inverted diagonal blocks. The rounding errors of elimination
  /// without pivoting grow with |L| |U| (Higham, Accuracy and Stability of Numerical Algorithms,
  /// 2nd ed., theorem 9.3). If the diagonal dominates, this number is at most 2 (theorem 9.9); in
  /// steps that converge it is hardly larger, because W is nearly triangular.
  [[gnu::flatten]] Orbits factorise() {
    const std::size_t m = components();
    const std::size_t row = stages_ * m * m;
    for (std::size_t i = 0; i < stages_; ++i) {
      for (std::size_t j = 0; j < stages_; ++j) {
        const Orbits factor(-coupling_[i * stages_ + j]);
        Orbits* const target = block(i, j);
        for (std::size_t e = 0; e < m * m; ++e) target[e] = factor * scaled_[j * m * m + e];
        for (std::size_t c = 0; c < m && i == j; ++c) target[c * m + c] += Orbits(1.0);
      }
    }
    // Crout's order: each block is finished at once, with its sums in registers.
    for (std::size_t k = 0; k < stages_; ++k) {
      for (std::size_t i = k; i < stages_; ++i) {
        subtract_products<Components>(block(i, 0), block(0, k), row, k, block(i, k));
      }
      invert(block(k, k));
      for (std::size_t j = k + 1; j < stages_; ++j) {
        subtract_products<Components>(block(k, 0), block(0, j), row, k, block(k, j));
        multiply<Components>(block(k, k), block(k, j));
      }
    }
    Orbits growth(0.0);
    for (std::size_t e = 0; e < blocks_.size(); ++e) {
      growth = larger_magnitude(growth, blocks_[e] * entry_weights_[e % (m * m)]);
    }
    return growth;
  }

  /// Solves for `width` columns in place.
  [[gnu::flatten]] void solve(Orbits* columns) const {
    const std::size_t size = components() * width;
    for (std::size_t k = 0; k < stages_; ++k) {
      subtract_products<width>(block(k, 0), columns, size, k, columns + k * size);
      multiply<width>(block(k, k), columns + k * size);
    }
    for (std::size_t k = stages_ - 1; k-- > 0;) {
      subtract_products<width>(block(k, k + 1), columns + (k + 1) * size, size, stages_ - k - 1,
                               columns + k * size);
    }
  }

 private:
  std::size_t components() const {
    return Components == 0 ? components_ : static_cast<std::size_t>(Components);
  }
  Orbits* block(std::size_t i, std::size_t j) {
    return &blocks_[(i * stages_ + j) * components() * components()];
  }
  const Orbits* block(std::size_t i, std::size_t j) const {
    return &blocks_[(i * stages_ + j) * components() * components()];
  }

  /// The Gauss-Jordan inverse of a diagonal block, in place.
  void invert(Orbits* a) const {
    const std::size_t m = components();
    for (std::size_t k = 0; k < m; ++k) {
      const Orbits inverse = Orbits(1.0) / a[k * m + k];
      a[k * m + k] = Orbits(1.0);
      for (std::size_t j = 0; j < m; ++j) a[k * m + j] *= inverse;
      for (std::size_t i = 0; i < m; ++i) {
        if (i == k) continue;
        const Orbits factor = a[i * m + k];
        a[i * m + k] = Orbits(0.0);
        for (std::size_t j = 0; j < m; ++j) a[i * m + j] -= factor * a[k * m + j];
      }
    }
  }

  /// b = a b, for a block b with `Columns` columns.
  template <int Columns>
  void multiply(const Orbits* a, Orbits* b) const {
    if constexpr (Components > 0 && Columns > 0) {
      std::array<Orbits, Components * Columns> old;
      for (std::size_t e = 0; e < old.size(); ++e) old[e] = b[e];
      for (std::size_t r = 0; r < Components; ++r) {
        for (std::size_t t = 0; t < Columns; ++t) {
          Orbits sum = a[r * Components] * old[t];
          for (std::size_t k = 1; k < Components; ++k) {
            sum += a[r * Components + k] * old[k * Columns + t];
          }
          b[r * Columns + t] = sum;
        }
      }
    } else {
      const std::size_t m = components();
      const std::size_t columns = Columns > 0 ? static_cast<std::size_t>(Columns) : m;
      std::vector<Orbits>& old = copy_;
      old.assign(b, b + m * columns);
      for (std::size_t r = 0; r < m; ++r) {
        for (std::size_t t = 0; t < columns; ++t) {
          Orbits sum = a[r * m] * old[t];
          for (std::size_t k = 1; k < m; ++k) sum += a[r * m + k] * old[k * columns + t];
          b[r * columns + t] = sum;
        }
      }
    }
  }
  /// c -= sum of a_p b_p over the first `count` blocks of a row and of a column. The blocks of the
  /// row stand side by side, those of the column are `stride` apart; b and c have `Columns`
  /// columns.
  template <int Columns>
  void subtract_products(const Orbits* a, const Orbits* b, std::size_t stride, std::size_t count,
                         Orbits* c) const {
    if constexpr (Components > 0 && Columns > 0) {
      std::array<Orbits, Components * Columns> sum;
      for (std::size_t e = 0; e < sum.size(); ++e) sum[e] = c[e];
      for (std::size_t p = 0; p < count; ++p, a += Components * Components, b += stride) {
        for (std::size_t k = 0; k < Components; ++k) {
          for (std::size_t t = 0; t < Columns; ++t) {
            const Orbits x = b[k * Columns + t];
            for (std::size_t r = 0; r < Components; ++r) {
              sum[r * Columns + t] -= a[r * Components + k] * x;
            }
          }
        }
      }
      for (std::size_t e = 0; e < sum.size(); ++e) c[e] = sum[e];
    } else {
      const std::size_t m = components();
      const std::size_t columns = Columns > 0 ? static_cast<std::size_t>(Columns) : m;
      for (std::size_t p = 0; p < count; ++p, a += m * m, b += stride) {
        for (std::size_t r = 0; r < m; ++r) {
          for (std::size_t k = 0; k < m; ++k) {
            for (std::size_t t = 0; t < columns; ++t) {
              c[r * columns + t] -= a[r * m + k] * b[k * columns + t];
            }
          }
        }
      }
    }
  }

  std::size_t components_;
  std::size_t stages_;
  std::vector<double> coupling_;
  std::vector<Orbits> blocks_;  ///< rows of blocks; each block by rows
  std::vector<Orbits> scaled_;  ///< scale Dg, by stage
  std::vector<Orbits> entry_weights_;
  mutable std::vector<Orbits> copy_;
};

}  // namespace hamjet
