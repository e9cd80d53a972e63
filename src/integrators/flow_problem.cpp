#include "hamjet/integrators/flow_problem.hpp"

#include <fmt/format.h>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/algebra/extended.hpp"
#include "real_number.hpp"

namespace hamjet {

template <class Real>
void validate(const FlowProblem<Real>& problem) {
  if (!problem.system || problem.space == nullptr) {
    throw Error(ErrorKind::usage, "flow problem: no system or no series space");
  }
  const std::size_t dimension = problem.system->dimension();
  if (problem.initial_state.size() != dimension) {
    throw Error(ErrorKind::usage, fmt::format("flow problem: the initial state has {} numbers, "
                                              "the system {}",
                                              problem.initial_state.size(), dimension));
  }
  if (problem.variables.size() != problem.space->variables()) {
    throw Error(ErrorKind::usage, "flow problem: the space has another number of variables");
  }
  for (const std::size_t v : problem.variables) {
    if (v >= dimension) throw Error(ErrorKind::usage, "flow problem: no such variable");
  }
  for (const Real& x : problem.initial_state) {
    if (!is_finite(x)) {
      throw Error(ErrorKind::numerical, "flow problem: the initial state is not finite");
    }
  }
  if (problem.initial_jet) {
    if (problem.initial_jet->size() != dimension) {
      throw Error(ErrorKind::usage,
                  "flow problem: the initial jet has another number of components");
    }
    for (std::size_t i = 0; i < dimension; ++i) {
      const Series<Real>& component = (*problem.initial_jet)[i];
      require_same_space(component.space(), *problem.space);
      if (component[0] != problem.initial_state[i]) {
        throw Error(ErrorKind::usage,
                    "flow problem: the initial jet is not about the initial state");
      }
    }
  }
  if (!is_finite(problem.start_time.template in<Real>())) {
    throw Error(ErrorKind::numerical, "flow problem: the start time is not finite");
  }
  if (!is_finite(problem.duration)) {
    throw Error(ErrorKind::numerical, "flow problem: the duration is not finite");
  }
}

template <class Real>
void require_finite(const FlowJet<Real>& jet, const Real& time, const char* method) {
  for (std::size_t i = 0; i < jet.size(); ++i) {
    for (std::size_t k = 0; k < jet[i].size(); ++k) {
      if (is_finite(jet[i][k])) continue;
      throw Error(
          ErrorKind::numerical,
          fmt::format("{}: a coefficient of degree {} of component {} is not finite at t = {:.10g}",
                      method, jet[i].space().degree(k), i, static_cast<double>(time)));
    }
  }
}

template void validate(const FlowProblem<InstantiatedReal>&);
template void require_finite(const FlowJet<InstantiatedReal>&, const InstantiatedReal&,
                             const char*);

}  // namespace hamjet
