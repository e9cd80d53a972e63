#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

#include "../real_number.hpp"
#include "hamjet/detail/algebra/pack.hpp"

namespace hamjet {

/// A square matrix M of the stages' components, and Gauss-Jordan elimination with it. A column
/// consists of one pack for each component, whose lanes are the stages, so that every update of a
/// column is a sequence of packs; the row `component * stages + stage` is a lane.
template <class Real, int Lanes>
class StageElimination {
 public:
  using P = Pack<Real, Lanes>;

  StageElimination(std::size_t components, std::size_t stages)
      : components_(components),
        stages_(stages),
        matrix_(components * stages * components),
        pivot_row_(components * stages),
        used_(components * stages) {
    for (std::size_t i = 0; i < stages_; ++i) {
      units_.push_back(P::of_lanes([&](std::size_t lane) { return Real(lane == i ? 1 : 0); }));
    }
  }

  /// The column of a component at a stage, which `solve` overwrites.
  P* column(std::size_t component, std::size_t stage) {
    return &matrix_[(component * stages_ + stage) * components_];
  }

  /// Replaces the columns R by M^-1 R, without pivoting if the matrix is dominated by its diagonal.
  /// Pivots are compared in units of the components, whose inverses are given. Returns false if the
  /// matrix is singular or not finite.
  bool solve(std::initializer_list<std::span<P>> columns, bool is_dominant,
             std::span<const Real> inverse_units) {
    if (is_dominant) {
      eliminate_in_order(columns);
      return true;
    }
    if (!eliminate(columns, inverse_units)) return false;
    for (const std::span<P>& of : columns) undo_pivoting(of);
    return true;
  }

 private:
  using Columns = std::initializer_list<std::span<P>>;

  Real row_of(const P* column, std::size_t row) const {
    return column[row / stages_].lane(static_cast<int>(row % stages_));
  }
  void set_row(P* column, std::size_t row, const Real& value) const {
    column[row / stages_].set_lane(static_cast<int>(row % stages_), value);
  }

  /// The pivot row: the diagonal unless another entry is ten times larger (threshold pivoting, by
  /// which the order of rows rarely changes).
  std::optional<std::size_t> choose_pivot(std::size_t column,
                                          std::span<const Real> inverse_units) const {
    const P* m = &matrix_[column * components_];
    std::size_t best = pivot_row_.size();
    Real largest = 0;
    std::size_t row = 0;
    for (std::size_t c = 0; c < components_; ++c) {
      for (std::size_t i = 0; i < stages_; ++i, ++row) {
        const Real value = magnitude(Real(m[c].lane(static_cast<int>(i)) * inverse_units[c]));
        if (!(value <= largest) && !used_[row]) {
          largest = value;
          best = row;
        }
      }
    }
    if (best == pivot_row_.size() || !is_finite(largest)) return std::nullopt;
    const Real diagonal = magnitude(Real(row_of(m, column) * inverse_units[column / stages_]));
    if (!used_[column] && 10 * diagonal >= largest) best = column;
    return best;
  }

  /// Each row is divided by its pivot and subtracted from all others.
  bool eliminate(const Columns& columns, std::span<const Real> inverse_units) {
    std::fill(used_.begin(), used_.end(), false);
    for (std::size_t r = 0; r < pivot_row_.size(); ++r) {
      const auto pivot = choose_pivot(r, inverse_units);
      if (!pivot) return false;
      pivot_row_[r] = *pivot;
      used_[*pivot] = true;
      P* factor = &matrix_[r * components_];
      const Real inverse = 1 / row_of(factor, *pivot);
      set_row(factor, *pivot, Real(0));
      for_each_column(r + 1, columns, [&](P* column) {
        const Real x = row_of(column, *pivot) * inverse;
        if (x == 0) return;  // the right-hand sides start with blocks of zeros
        const P broadcast(x);
        for (std::size_t c = 0; c < components_; ++c) column[c] -= factor[c] * broadcast;
        set_row(column, *pivot, x);
      });
    }
    return true;
  }

  /// Calls `reduce` for all columns that the elimination has still to change.
  template <class Reduce>
  void for_each_column(std::size_t first, const Columns& columns, const Reduce& reduce) {
    const auto of = [&](std::span<P> run) {
      for (std::size_t q = 0; q < run.size(); q += components_) reduce(&run[q]);
    };
    of(std::span<P>(matrix_).subspan(first * components_));
    for (const std::span<P>& run : columns) of(run);
  }

  /// Elimination without pivoting.
  void eliminate_in_order(const Columns& columns) {
    // The usual numbers of components are unrolled, because this is a large part of a step of order
    // 1.
    if (components_ == 3) return eliminate_in_order<3>(columns);
    if (components_ == 2) return eliminate_in_order<2>(columns);
    eliminate_in_order<0>(columns);
  }

  /// Components 0 means that their number is known at run time only. Pivots are taken four at a
  /// time if a component has that many stages left, so that a column is read and written once for
  /// four pivots.
  template <std::size_t Components>
  void eliminate_in_order(const Columns& columns) {
    for (std::size_t c = 0; c < components_; ++c) {
      std::size_t lane = 0;
      for (; lane + 4 <= stages_; lane += 4) {
        eliminate_block<Components, 4>(c, lane, columns);
      }
      for (; lane < stages_; ++lane) eliminate_block<Components, 1>(c, lane, columns);
    }
  }

  /// Let F be the columns of the pivots and P their block in the pivots' rows. In a column with the
  /// entries v in the pivots' rows, these become x = P^-1 v, and the column itself becomes column -
  /// F x elsewhere. As v - (P - I) x = x, one formula serves all rows if P - I takes the place of
  /// P.
  template <std::size_t Components, std::size_t Count>
  void eliminate_block(std::size_t component, std::size_t lane, const Columns& columns) {
    const std::size_t components = Components == 0 ? components_ : Components;
    const std::size_t first = component * stages_ + lane;
    P* const factors = &matrix_[first * components];
    const auto pivots = [&](const P* column) {
      std::array<Real, Count> v;
      for (std::size_t i = 0; i < Count; ++i) {
        v[i] = column[component].lane(static_cast<int>(lane + i));
      }
      return v;
    };
    std::array<std::array<Real, Count>, Count> block;  // by columns
    for (std::size_t j = 0; j < Count; ++j) block[j] = pivots(factors + j * components);
    invert(block);
    for (std::size_t j = 0; j < Count; ++j) {
      factors[j * components + component] -= units_[lane + j];
    }
    std::array<P, Components * Count> unrolled;
    std::copy_n(factors, unrolled.size(), unrolled.begin());
    for_each_column(first + Count, columns, [&](P* column) {
      const std::array<Real, Count> v = pivots(column);
      bool vanishes = true;
      for (const Real& entry : v) vanishes = vanishes && entry == 0;
      if (vanishes) return;
      for (std::size_t j = 0; j < Count; ++j) {
        Real x = block[0][j] * v[0];
        for (std::size_t i = 1; i < Count; ++i) x += block[i][j] * v[i];
        const P broadcast(x);
        for (std::size_t c = 0; c < components; ++c) {
          column[c] -=
              (Components == 0 ? factors : unrolled.data())[j * components + c] * broadcast;
        }
      }
    });
  }

  /// Inversion of the block, by elimination in order as for the whole matrix.
  template <std::size_t Count>
  static void invert(std::array<std::array<Real, Count>, Count>& block) {
    for (std::size_t r = 0; r < Count; ++r) {
      const Real inverse = 1 / block[r][r];
      block[r][r] = Real(1);
      for (std::size_t j = 0; j < Count; ++j) block[j][r] *= inverse;
      for (std::size_t i = 0; i < Count; ++i) {
        if (i == r) continue;
        const Real factor = block[r][i];
        block[r][i] = Real(0);
        for (std::size_t j = 0; j < Count; ++j) block[j][i] -= factor * block[j][r];
      }
    }
  }

  void undo_pivoting(std::span<P> columns) const {
    bool in_order = true;
    for (std::size_t r = 0; r < pivot_row_.size(); ++r) in_order = in_order && pivot_row_[r] == r;
    if (in_order) return;
    std::vector<P> copy(components_);
    for (std::size_t q = 0; q < columns.size(); q += components_) {
      std::copy_n(&columns[q], components_, copy.begin());
      for (std::size_t r = 0; r < pivot_row_.size(); ++r) {
        set_row(&columns[q], r, row_of(copy.data(), pivot_row_[r]));
      }
    }
  }

  std::size_t components_;
  std::size_t stages_;
  std::vector<P> matrix_;
  std::vector<P> units_;  ///< for each stage, 1 in its lane
  std::vector<std::size_t> pivot_row_;
  std::vector<char> used_;
};

}  // namespace hamjet
