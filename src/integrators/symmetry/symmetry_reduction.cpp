#include "symmetry_reduction.hpp"

#include "../../algebra/instantiated_real.hpp"

namespace hamjet {

template <class Real>
std::optional<SymmetryReduction<Real>> SymmetryReduction<Real>::of(
    const FlowProblem<Real>& problem) {
  const bool has_jet = problem.duration != 0 && working_order(problem) >= 1;
  if (problem.symmetry == FlowSymmetry::none || problem.initial_jet || !has_jet) {
    return std::nullopt;
  }
  // A linear flow has no degrees above the first, which a symmetry put back would fill with
  // rounding.
  if (problem.system->vector_field.is_linear_system()) return std::nullopt;
  SymmetryReduction result;
  result.rotation_ = RotationReduction<Real>::of(problem);
  // A flow that depends on the time does not commute with shifts in it.
  if (has_time_shift(problem.symmetry) && problem.system->is_autonomous()) {
    std::optional<LeftOutRotation> rotation;
    if (result.rotation_) rotation = result.rotation_->left_out();
    result.time_ =
        TimeReduction<Real>::of(result.rotation_ ? result.rotation_->problem() : problem, rotation);
  }
  if (!result.rotation_ && !result.time_) return std::nullopt;
  return result;
}

template <class Real>
FlowSymmetry SymmetryReduction<Real>::left_out() const {
  if (!time_) return FlowSymmetry::rotation;
  return rotation_ ? FlowSymmetry::rotation_and_time : FlowSymmetry::time;
}

template <class Real>
FlowJet<Real> SymmetryReduction<Real>::expand(const FlowJet<Real>& reduced) const {
  FlowJet<Real> jet = time_ ? time_->expand(reduced) : reduced;
  if (rotation_) jet = rotation_->expand(jet);
  return jet;
}

template class SymmetryReduction<InstantiatedReal>;

}  // namespace hamjet
