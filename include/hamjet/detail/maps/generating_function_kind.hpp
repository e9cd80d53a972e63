#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hamjet {

/// Which variables a generating function takes: one of each pair (q_i, p_i) of the final state and
/// one of each pair of the initial state, 2^n x 2^n kinds in all.
///
/// The name is the final choice, a hyphen and the initial choice, with one letter per degree of
/// freedom: `qqq-qqq` is F1, `qqq-ppp` F2, `ppp-qqq` F3, `ppp-ppp` F4, `qpq-qqp` a mixed one.
struct GeneratingFunctionKind {
  std::vector<bool> final_is_momentum;    ///< n entries: whether p_i is chosen
  std::vector<bool> initial_is_momentum;  ///< n entries: whether p0_i is chosen

  std::size_t degrees_of_freedom() const noexcept { return final_is_momentum.size(); }
  /// The kind in explicit notation, such as `qqq-qqq`.
  std::string name() const;
  /// Index in z = (q, p) of the chosen (or the remaining) variable of the i-th final pair.
  std::size_t final_variable(std::size_t i, bool chosen = true) const;
  /// Index in (q0, p0) of the chosen (or the remaining) variable of the i-th initial pair.
  std::size_t initial_variable(std::size_t i, bool chosen = true) const;

  bool operator==(const GeneratingFunctionKind&) const = default;
};

/// Reads `F1`..`F4` or the explicit notation for n degrees of freedom. Throws Error(usage) for any
/// other text.
GeneratingFunctionKind parse_kind(std::string_view text, std::size_t degrees_of_freedom);

/// All 2^n x 2^n kinds, F1 first.
std::vector<GeneratingFunctionKind> all_kinds(std::size_t degrees_of_freedom);

}  // namespace hamjet
