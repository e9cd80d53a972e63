#include "hamjet/integrators/symmetric_composition.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/error.hpp"
#include "splitting_integration.hpp"

namespace hamjet {
namespace {

const char* method_name(int order) {
  if (order == 4) return "composition of order 4";
  return order == 6 ? "composition of order 6" : "composition of order 8";
}

}  // namespace

template <class Real>
Splitting<Real> splitting_of(const SymmetricCompositionSettings& settings) {
  Splitting<Real> splitting{method_name(settings.order), settings.step, {}, {}};
  // The half kicks at the end of one Verlet step and at the start of the next are joined.
  Extended previous = 0;
  for (const Extended& gamma : composition_substeps(settings.order)) {
    splitting.drifts.push_back(convert<Real>(gamma));
    splitting.kicks.push_back(convert<Real>(Extended((previous + gamma) / 2)));
    previous = gamma;
  }
  splitting.kicks.push_back(convert<Real>(Extended(previous / 2)));
  return splitting;
}

template <class Real>
FlowJet<Real> integrate_symmetric_composition(const FlowProblem<Real>& problem,
                                              const SymmetricCompositionSettings& settings,
                                              IntegrationStatistics& statistics,
                                              const StepObserver<Real>& observer) {
  return integrate_splitting(problem, splitting_of<Real>(settings), statistics, observer);
}

template Splitting<InstantiatedReal> splitting_of(const SymmetricCompositionSettings&);
template FlowJet<InstantiatedReal> integrate_symmetric_composition(
    const FlowProblem<InstantiatedReal>&, const SymmetricCompositionSettings&,
    IntegrationStatistics&, const StepObserver<InstantiatedReal>&);

}  // namespace hamjet
