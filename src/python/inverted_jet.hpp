#pragma once

#include <span>
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
  /// All numbers there are; polynomials in w, in double precision.
  struct Parts {
    GeneratingFunctionKind kind;
    double condition;
    std::vector<std::string> variables;
    std::vector<std::string> remaining_variables;
    std::vector<Series<double>> function;  ///< one component
    std::vector<Series<double>> gradient;
    std::vector<Series<double>> remaining;
    std::vector<ExactnessResidual> exactness;
  };

  /// `kind` as in scenes: F1..F4, letters, or auto. Computed in extended precision, as the command
  /// does. Throws as parse_kind and invert_partially do.
  InvertedJet(const Jet& jet, std::string_view kind);
  /// The inverted jet that has these parts.
  explicit InvertedJet(Parts parts);

  const Parts& parts() const noexcept { return parts_; }
  const GeneratingFunctionKind& kind() const noexcept { return parts_.kind; }
  double condition() const noexcept { return parts_.condition; }
  /// Names of the 2n variables w, initial ones with a 0 behind, and of those solved for.
  const std::vector<std::string>& variables() const noexcept { return parts_.variables; }
  const std::vector<std::string>& remaining_variables() const noexcept {
    return parts_.remaining_variables;
  }
  /// The space of the generating function, whose order is one more than the jet's.
  const SpacePointer& space() const noexcept { return parts_.function[0].space_pointer(); }
  std::span<const double> coefficients() const noexcept {
    return parts_.function[0].coefficients();
  }
  const std::vector<ExactnessResidual>& exactness() const noexcept { return parts_.exactness; }

  const MapEvaluator& value() const noexcept { return evaluators_[0]; }
  const MapEvaluator& gradient() const noexcept { return evaluators_[1]; }
  const MapEvaluator& remaining() const noexcept { return evaluators_[2]; }

 private:
  Parts parts_;
  std::vector<MapEvaluator> evaluators_;
};

}  // namespace hamjet::python
