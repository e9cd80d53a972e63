#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hamjet/maps/exactness.hpp"
#include "hamjet/maps/map_evaluator.hpp"
#include "jet.hpp"

namespace hamjet::python {

/// A jet solved for the variables that one kind of generating function does not take, with that
/// function; immutable. All are polynomials in w, see PartialInversion.
class InvertedJet {
 public:
  /// `kind` as in scenes: F1..F4, letters, or auto. Computed in extended precision, as the command
  /// does. Throws as parse_kind and invert_partially do.
  InvertedJet(const Jet& jet, std::string_view kind);

  const GeneratingFunctionKind& kind() const noexcept { return kind_; }
  double condition() const noexcept { return condition_; }
  /// Names of the 2n variables w, initial ones with a 0 behind, and of those solved for.
  const std::vector<std::string>& variables() const noexcept { return variables_; }
  const std::vector<std::string>& remaining_variables() const noexcept { return remaining_names_; }
  /// Of the generating function, whose order is one more than the jet's.
  const SpacePointer& space() const noexcept { return space_; }
  const std::vector<double>& coefficients() const noexcept { return coefficients_; }
  const std::vector<ExactnessResidual>& exactness() const noexcept { return exactness_; }

  const MapEvaluator& value() const noexcept { return evaluators_[0]; }
  const MapEvaluator& gradient() const noexcept { return evaluators_[1]; }
  const MapEvaluator& remaining() const noexcept { return evaluators_[2]; }

 private:
  GeneratingFunctionKind kind_;
  double condition_;
  std::vector<std::string> variables_;
  std::vector<std::string> remaining_names_;
  SpacePointer space_;
  std::vector<double> coefficients_;
  std::vector<ExactnessResidual> exactness_;
  std::vector<MapEvaluator> evaluators_;
};

}  // namespace hamjet::python
