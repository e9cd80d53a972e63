#pragma once

#include <map>
#include <string>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// Judges the jets of a scene's runs: symplecticity, error against the reference, and the
/// generating functions that the scene asks for, with their exactness. The rounding floors of
/// exactness do not depend on the run and are computed once for each kind. Of forces that are none
/// of a Hamiltonian their part of every residual is told; for exactness, a scene without a
/// reference takes one finer jet.
class MapAnalysis {
 public:
  MapAnalysis(const Scene& scene, const ComputedProblem& problem,
              const std::optional<ReferenceResult>& reference)
      : scene_(scene), problem_(problem), reference_(reference) {}

  /// Computes all that the scene asks for; a kind that does not exist is marked in its result.
  void analyse(RunResult& run);

  /// Number of inversions of the reference's map so far.
  long floor_inversions() const { return floor_inversions_; }

 private:
  KindResult invert(RunResult& run, const std::string& requested);
  void compose(RunResult& run, const PartialInversion<Extended>& inversion,
               const std::string& requested) const;
  const std::vector<ExactnessResidual>* floor(const GeneratingFunctionKind& kind);
  std::vector<double> scales(const GeneratingFunctionKind& kind) const;
  const FlowJet<Extended>* finer_jet();
  void add_forces(KindResult& result, const std::vector<Series<Extended>>& sigma);
  void add_integration_defects(RunResult& run, const FlowJet<Extended>& comparable);

  const Scene& scene_;
  const ComputedProblem& problem_;
  const std::optional<ReferenceResult>& reference_;
  std::map<std::string, std::vector<ExactnessResidual>> floors_;
  long floor_inversions_ = 0;
  std::optional<FlowJet<Extended>> finer_;  ///< empty if there is none
};

}  // namespace hamjet
