#include "hamjet/maps/partial_inversion.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "../algebra/instantiated_real.hpp"
#include "../algebra/singular_values.hpp"
#include "../integrators/momentum_unit.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

template <class T>
std::vector<double> rounded_singular_values(const Matrix<T>& matrix) {
  std::vector<double> result;
  for (const T& value : singular_values(matrix)) result.push_back(static_cast<double>(value));
  return result;
}

/// The condition number, as the ratio of the largest to the smallest singular value.
double ratio_of_ends(const std::vector<double>& values) {
  return values.back() > 0 ? values.front() / values.back()
                           : std::numeric_limits<double>::infinity();
}

template <class T>
void require_full_jet(const std::vector<Series<T>>& jet, const GeneratingFunctionKind& kind) {
  const std::size_t n = kind.degrees_of_freedom();
  if (jet.size() != 2 * n || jet[0].space().variables() != 2 * n) {
    throw Error(
        ErrorKind::usage,
        fmt::format("partial inversion {}: a jet of {} components in {} variables is needed",
                    kind.name(), 2 * n, 2 * n));
  }
}

template <class T>
const T& entry(const Matrix<T>& matrix, std::size_t i, std::size_t j) {
  return matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

/// The block of the linear part whose rows are the chosen (or remaining) final variables and whose
/// columns are the chosen (or remaining) initial ones.
template <class T>
Matrix<T> part_of(const Matrix<T>& linear, const GeneratingFunctionKind& kind, bool has_chosen_rows,
                  bool has_chosen_columns) {
  const std::size_t n = kind.degrees_of_freedom();
  Matrix<T> result(n, n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(kind.final_variable(i, has_chosen_rows));
    for (std::size_t j = 0; j < n; ++j) {
      const auto column = static_cast<Eigen::Index>(kind.initial_variable(j, has_chosen_columns));
      result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = linear(row, column);
    }
  }
  return result;
}

/// Solves the chosen final variables, f = A u + B v + N(u, v), for the remaining initial deviations
/// u(w), where w = (f, v) and v are the chosen initial deviations. The iteration
///
///   u = A^-1 (f - B v - N(u, v))
///
/// makes one more degree right each time, because N begins at degree 2. The last iteration also
/// gives the remaining final variables C u + D v + M(u, v), because M needs no higher degree of u
/// than N does.
template <class T>
void solve_for_the_rest(const std::vector<Series<T>>& jet, PartialInversion<T>& result) {
  const GeneratingFunctionKind& kind = result.kind;
  const std::size_t n = kind.degrees_of_freedom();
  const SpacePointer& space = jet[0].space_pointer();
  const Matrix<T> linear = linear_part(jet);
  const Matrix<T> inverse = part_of(linear, kind, true, false).partialPivLu().inverse();
  const Matrix<T> of_v = -inverse * part_of(linear, kind, true, true);
  std::vector<Series<T>> initial(2 * n, Series<T>(space));  // by initial variable
  for (std::size_t i = 0; i < n; ++i) {
    initial[kind.initial_variable(i)][space->linear_index(n + i)] = T(1);
    Series<T>& u = initial[kind.initial_variable(i, false)];
    for (std::size_t j = 0; j < n; ++j) {
      u[space->linear_index(j)] = entry(inverse, i, j);
      u[space->linear_index(n + j)] = entry(of_v, i, j);
    }
  }
  std::vector<Series<T>> nonlinear;  // N, and in the last iteration M
  const auto append_nonlinear = [&](bool is_chosen) {
    for (std::size_t i = 0; i < n; ++i) {
      nonlinear.push_back(jet[kind.final_variable(i, is_chosen)]);
      std::fill_n(nonlinear.back().coefficients().begin(), space->first(2), T(0));
    }
  };
  nonlinear.reserve(2 * n);
  append_nonlinear(true);
  for (int d = 2; d <= space->order(); ++d) {
    if (d == space->order()) append_nonlinear(false);
    auto composed = detail::compose_up_to(nonlinear, initial, d);
    for (std::size_t i = 0; i < n; ++i) {
      Series<T>& u = initial[kind.initial_variable(i, false)];
      for (std::size_t j = 0; j < n; ++j) {
        const T factor = entry(inverse, i, j);
        for (std::size_t k = space->first(d); k < space->first(d + 1); ++k) {
          u[k] -= factor * composed[j][k];
        }
      }
    }
    if (d < space->order()) continue;
    for (std::size_t i = 0; i < n; ++i) {
      result.remaining_final.push_back(std::move(composed[n + i]));
    }
  }
  result.remaining_final.resize(n, Series<T>(space));  // at order 1 there is no M
  const Matrix<T> c = part_of(linear, kind, false, false);
  const Matrix<T> d = part_of(linear, kind, false, true);
  for (std::size_t i = 0; i < n; ++i) {
    Series<T>& rest = result.remaining_final[i];
    for (std::size_t j = 0; j < n; ++j) {
      const Series<T>& u = initial[kind.initial_variable(j, false)];
      for (std::size_t k = 1; k < space->size(); ++k) rest[k] += entry(c, i, j) * u[k];
      rest[space->linear_index(n + j)] += entry(d, i, j);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    result.remaining_initial.push_back(std::move(initial[kind.initial_variable(i, false)]));
  }
}

}  // namespace

template <class T>
Matrix<T> inverted_block(const std::vector<Series<T>>& jet, const GeneratingFunctionKind& kind,
                         int momentum_exponent) {
  require_full_jet(jet, kind);
  const std::size_t n = kind.degrees_of_freedom();
  const double unit = std::ldexp(1.0, momentum_exponent);
  Matrix<T> block(n, n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const Series<T>& component = jet[kind.final_variable(i)];
      const std::size_t k = component.space().linear_index(kind.initial_variable(j, false));
      const double row = kind.final_is_momentum[i] ? 1 / unit : 1;
      const double column =
          kind.initial_is_momentum[j] ? 1 : unit;  // variables that are not chosen
      block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          component[k] * T(row * column);
    }
  }
  return block;
}

template <class T>
double condition_number(const Matrix<T>& matrix) {
  return ratio_of_ends(rounded_singular_values(matrix));
}

template <class T>
PartialInversion<T> invert_partially(const std::vector<Series<T>>& jet,
                                     const GeneratingFunctionKind& kind, double precision,
                                     int momentum_exponent) {
  const std::vector<double> values =
      rounded_singular_values(inverted_block(jet, kind, momentum_exponent));
  PartialInversion<T> result;
  result.kind = kind;
  result.condition = ratio_of_ends(values);
  const Matrix<T> linear = in_momentum_unit<Matrix<T>>(linear_part(jet), momentum_exponent);
  const double whole = static_cast<double>(linear.norm());
  if (!(result.condition < largest_condition(precision)) ||
      !(values.back() * largest_condition(precision) > whole)) {
    throw Error(ErrorKind::numerical,
                fmt::format("generating function {}: it does not exist at this time: the singular "
                            "values of its linear part run from {:.3g} down to {:.3g} (condition "
                            "{:.3g}), that of the whole map has the norm {:.3g}; another kind, or "
                            "'auto', may exist",
                            kind.name(), values.front(), values.back(), result.condition, whole));
  }
  result.amplification = std::max(result.condition, whole / values.back());
  solve_for_the_rest(jet, result);
  return result;
}

template <class T>
GeneratingFunctionKind best_conditioned_kind(const std::vector<Series<T>>& jet,
                                             int momentum_exponent) {
  const auto kinds = all_kinds(jet.size() / 2);
  constexpr double equal = 1 + 1e-6;
  double smallest = std::numeric_limits<double>::infinity();
  double size = 0;
  GeneratingFunctionKind best = kinds.front();
  for (const auto& kind : kinds) {
    const std::vector<double> values =
        rounded_singular_values(inverted_block(jet, kind, momentum_exponent));
    const double condition = ratio_of_ends(values);
    const bool is_better = condition * equal < smallest;
    if (is_better || (condition < equal * smallest && values.back() > size)) {
      smallest = is_better ? condition : std::min(smallest, condition);
      size = values.back();
      best = kind;
    }
  }
  return best;
}

template Matrix<InstantiatedReal> inverted_block(const std::vector<Series<InstantiatedReal>>&,
                                                 const GeneratingFunctionKind&, int);
template double condition_number(const Matrix<InstantiatedReal>&);
template PartialInversion<InstantiatedReal> invert_partially(
    const std::vector<Series<InstantiatedReal>>&, const GeneratingFunctionKind&, double, int);
template GeneratingFunctionKind best_conditioned_kind(const std::vector<Series<InstantiatedReal>>&,
                                                      int);

}  // namespace hamjet
