#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hamjet/formats/stored_jet.hpp"

namespace hamjet::cli {

/// Counts points at which a parameter of a jet deviates from its value by more than the value
/// itself, where the polynomials were not expanded for it: a density, a coefficient of drag or a
/// mass would have another sign there, or more than twice the size. Parameters that are 0 have no
/// such limit.
class ParameterRange {
 public:
  explicit ParameterRange(const io::StoredJet& jet);

  /// Looks at the values of the jet's variables at one point.
  void look(std::span<const double> variables);
  /// What is wrong with the points so far, naming the parameter that deviates furthest in parts of
  /// its value and the limit; no value if nothing is.
  std::optional<std::string> warning() const;

 private:
  struct Parameter {
    std::size_t place = 0;  ///< among the jet's variables
    std::string name;
    double value = 0;
    double furthest = 0;  ///< the deviation, with its sign
  };
  std::vector<Parameter> parameters_;
  std::size_t points_ = 0;
  std::size_t beyond_ = 0;
};

}  // namespace hamjet::cli
