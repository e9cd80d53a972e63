#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../algebra/instantiated_real.hpp"
#include "../algebra/singular_values.hpp"
#include "../integrators/momentum_unit.hpp"
#include "hamjet/error.hpp"
#include "hamjet/maps/generating_function.hpp"

namespace hamjet {
namespace {

template <class T>
std::vector<double> rounded_singular_values(const Matrix<T>& matrix) {
  std::vector<double> result;
  for (const T& value : singular_values(matrix)) result.push_back(static_cast<double>(value));
  return result;
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
      const double column = kind.initial_is_momentum[j] ? 1 : unit;  // what is not chosen
      block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          component[k] * T(row * column);
    }
  }
  return block;
}

template <class T>
double condition_number(const Matrix<T>& matrix) {
  const std::vector<double> values = rounded_singular_values(matrix);
  return values.back() > 0 ? values.front() / values.back()
                           : std::numeric_limits<double>::infinity();
}

template <class T>
PartialInversion<T> invert_partially(const std::vector<Series<T>>& jet,
                                     const GeneratingFunctionKind& kind, double precision,
                                     int momentum_exponent) {
  const Matrix<T> block = inverted_block(jet, kind, momentum_exponent);
  PartialInversion<T> result;
  result.kind = kind;
  result.condition = condition_number(block);
  const std::vector<double> values = rounded_singular_values(block);
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
  // The map w(initial deviations) is inverted as a whole: its last n rows are single variables.
  const std::size_t n = kind.degrees_of_freedom();
  const SpacePointer& space = jet[0].space_pointer();
  std::vector<Series<T>> chosen;
  for (std::size_t i = 0; i < n; ++i) {
    chosen.push_back(jet[kind.final_variable(i)]);
    chosen.back()[0] = T(0);
  }
  for (std::size_t i = 0; i < n; ++i) {
    chosen.push_back(Series<T>::variable(space, kind.initial_variable(i)));
  }
  const std::vector<Series<T>> initial = inverse(chosen);
  std::vector<Series<T>> final_rest;
  for (std::size_t i = 0; i < n; ++i) {
    final_rest.push_back(jet[kind.final_variable(i, false)]);
    final_rest.back()[0] = T(0);
    result.remaining_initial.push_back(initial[kind.initial_variable(i, false)]);
  }
  result.remaining_final = compose(final_rest, initial);
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
    const double condition = values.back() > 0 ? values.front() / values.back()
                                               : std::numeric_limits<double>::infinity();
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
