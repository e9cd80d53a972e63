#pragma once

#include <span>
#include <vector>

#include "hamjet/formats/stored_jet.hpp"
#include "hamjet/maps/flow_map.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet::python {

/// The jet of a flow with what belongs to it, as Python holds it; immutable.
class Jet {
 public:
  explicit Jet(io::StoredJet stored);

  const io::StoredJet& stored() const noexcept { return stored_; }
  SpacePointer space() const noexcept { return map_.space(); }
  /// The coefficients in double precision, component by component; the first of each is the
  /// nominal's final state.
  std::span<const double> coefficients() const noexcept { return coefficients_; }
  /// The map of the final deviation: the jet without the nominal's final state.
  const MapEvaluator& deviation() const noexcept { return deviation_; }
  /// The map of the final deviation without the terms above `degree`. Throws Error(usage) unless
  /// that is from 1 to the order.
  MapEvaluator deviation_to(int degree) const;
  /// The derivatives of the map, one component a number: those of the first component by each
  /// variable, then those of the second. They are of one degree less than the map.
  MapEvaluator derivatives() const;

  /// The jet of this flow and then `after`'s, of the lower of the two orders. Throws Error(usage)
  /// unless `after` is of the same system, expanded in the components of this one, and starts where
  /// this one ends.
  Jet composed_with(const Jet& after) const;
  /// The jet of the flow back. Throws Error(usage) unless it is expanded in all its components.
  Jet inverse() const;
  /// Symplecticity defects by degree, formed in extended precision as by the command.
  std::vector<SymplecticityDefect> symplecticity() const;

 private:
  io::StoredJet stored_;
  FlowMap<double> map_;
  std::vector<double> coefficients_;
  MapEvaluator deviation_;
};

/// The jet of a run that has a result.
Jet jet_of(const PropagationResult& result, const RunResult& run);

}  // namespace hamjet::python
