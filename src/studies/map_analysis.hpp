#pragma once

#include <map>
#include <string>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// Judges the jets of a scene's runs: symplecticity, error against the reference, and the
/// generating functions that the scene asks for with their exactness. The floors, which depend on
/// the kind and not on the run, are computed once a kind.
class MapAnalysis {
 public:
  MapAnalysis(const Scene& scene, const ComputedProblem& problem,
              const std::optional<ReferenceResult>& reference)
      : scene_(scene), problem_(problem), reference_(reference) {}

  /// Fills in all that the scene asks for; a kind that does not exist is marked in its result.
  void analyse(RunResult& run);

 private:
  KindResult invert(const FlowJet<Extended>& jet, const std::string& requested);
  const std::vector<ExactnessResidual>* floor(const GeneratingFunctionKind& kind);
  std::vector<double> scales(const GeneratingFunctionKind& kind) const;

  const Scene& scene_;
  const ComputedProblem& problem_;
  const std::optional<ReferenceResult>& reference_;
  std::map<std::string, std::vector<ExactnessResidual>> floors_;
};

}  // namespace hamjet
