#include "legendre_transformation.hpp"

#include <fmt/format.h>

#include <span>
#include <vector>

#include "../algebra/instantiated_real.hpp"
#include "../algebra/singular_values.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// Whether the variable w_i of a kind is the momentum of its pair (q, p). i = `pair` counts the 2n
/// pairs, the final ones first.
bool chooses_momentum(const GeneratingFunctionKind& kind, std::size_t pair) {
  const std::size_t n = kind.degrees_of_freedom();
  return pair < n ? kind.final_is_momentum[pair] : kind.initial_is_momentum[pair - n];
}

template <class T>
const Series<T>& remaining(const PartialInversion<T>& inversion, std::size_t pair) {
  const std::size_t n = inversion.kind.degrees_of_freedom();
  return pair < n ? inversion.remaining_final[pair] : inversion.remaining_initial[pair - n];
}

/// The condition of d(remaining initial) / d(chosen final), which is the inverse of
/// `inverted_block`.
template <class T>
double condition_of(const std::vector<Series<T>>& remaining_initial) {
  const auto n = static_cast<Eigen::Index>(remaining_initial.size());
  return condition_number<T>(linear_part(remaining_initial).leftCols(n));
}

/// Refuses a change of kind whose linear part, the derivative of the variables chosen by `to` by w
/// over the differing pairs, is singular to working precision. The criterion is that of
/// invert_partially.
template <class T>
void require_change(const PartialInversion<T>& from, const GeneratingFunctionKind& to,
                    const std::vector<std::size_t>& differing, double precision) {
  std::vector<Series<T>> all = from.remaining_final;
  all.insert(all.end(), from.remaining_initial.begin(), from.remaining_initial.end());
  const Matrix<T> whole = linear_part(all);
  const std::vector<Eigen::Index> indices(differing.begin(), differing.end());
  const Matrix<T> block = whole(indices, indices);
  const Vector<T> values = singular_values(block);
  const double smallest = static_cast<double>(values(values.size() - 1));
  const double condition = condition_number(block);
  const double norm = static_cast<double>(whole.norm());
  // The norm is at least the largest singular value of the block, so that this test covers the
  // condition of the block as well.
  if (!(smallest * largest_condition(precision) > norm)) {
    throw Error(ErrorKind::numerical,
                fmt::format("Legendre transformation from {} to {}: the latter does not exist at "
                            "this time: the smallest singular value of the linear part of the "
                            "change of variables is {:.3g} (condition {:.3g}), the norm of all "
                            "second derivatives {:.3g}",
                            from.kind.name(), to.name(), smallest, condition, norm));
  }
}

}  // namespace

template <class T>
PartialInversion<T> remaining_variables(const Series<T>& S, const GeneratingFunctionKind& kind) {
  const std::size_t n = kind.degrees_of_freedom();
  if (S.space().variables() != 2 * n || S.order() < 2) {
    throw Error(ErrorKind::usage,
                fmt::format("generating function {}: a series of order 2 or more in {} variables "
                            "is needed",
                            kind.name(), 2 * n));
  }
  for (const T& c : S.slice(1)) {
    if (c != T(0)) {
      throw Error(ErrorKind::usage,
                  fmt::format("generating function {}: terms of degree 1 would move the nominal",
                              kind.name()));
    }
  }
  const SpacePointer space = SeriesSpace::create(2 * n, S.order() - 1);
  PartialInversion<T> result;
  result.kind = kind;
  for (std::size_t i = 0; i < n; ++i) {
    const Series<T> sigma = in_space(derivative(S, i), space);
    result.remaining_final.push_back(kind.final_is_momentum[i] ? -sigma : sigma);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Series<T> sigma = in_space(derivative(S, n + i), space);
    result.remaining_initial.push_back(kind.initial_is_momentum[i] ? sigma : -sigma);
  }
  result.condition = condition_of(result.remaining_initial);
  return result;
}

template <class T>
PartialInversion<T> change_of_kind(const PartialInversion<T>& from,
                                   const GeneratingFunctionKind& to, double precision) {
  const std::size_t n = from.kind.degrees_of_freedom();
  if (to.degrees_of_freedom() != n) {
    throw Error(ErrorKind::usage,
                fmt::format("Legendre transformation: {} and {} differ in the number of degrees of "
                            "freedom",
                            from.kind.name(), to.name()));
  }
  if (to == from.kind) return from;
  const SpacePointer& space = from.remaining_final[0].space_pointer();
  std::vector<std::size_t> differing;
  std::vector<Series<T>> chosen;  // the variables of `to` as series in those of `from`
  for (std::size_t i = 0; i < 2 * n; ++i) {
    const bool differs = chooses_momentum(from.kind, i) != chooses_momentum(to, i);
    if (differs) differing.push_back(i);
    chosen.push_back(differs ? remaining(from, i) : Series<T>::variable(space, i));
  }
  require_change(from, to, differing, precision);
  const std::vector<Series<T>> w = inverse(chosen);

  std::vector<Series<T>> kept;  // those that remain under both kinds
  for (std::size_t i = 0; i < 2 * n; ++i) {
    if (chooses_momentum(from.kind, i) == chooses_momentum(to, i)) {
      kept.push_back(remaining(from, i));
    }
  }
  std::vector<Series<T>> composed;
  if (!kept.empty()) {
    composed = compose(kept, w);
  }
  PartialInversion<T> result;
  result.kind = to;
  std::size_t next = 0;
  for (std::size_t i = 0; i < 2 * n; ++i) {
    const bool differs = chooses_momentum(from.kind, i) != chooses_momentum(to, i);
    (i < n ? result.remaining_final : result.remaining_initial)
        .push_back(differs ? w[i] : composed[next++]);
  }
  result.condition = condition_of(result.remaining_initial);
  return result;
}

template <class T>
Series<T> legendre_transformation(const Series<T>& S, const GeneratingFunctionKind& from,
                                  const GeneratingFunctionKind& to, double precision) {
  return generating_function(one_form(change_of_kind(remaining_variables(S, from), to, precision)));
}

template PartialInversion<InstantiatedReal> remaining_variables(const Series<InstantiatedReal>&,
                                                                const GeneratingFunctionKind&);
template PartialInversion<InstantiatedReal> change_of_kind(
    const PartialInversion<InstantiatedReal>&, const GeneratingFunctionKind&, double);
template Series<InstantiatedReal> legendre_transformation(const Series<InstantiatedReal>&,
                                                          const GeneratingFunctionKind&,
                                                          const GeneratingFunctionKind&, double);

}  // namespace hamjet
