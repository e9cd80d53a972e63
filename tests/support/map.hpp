#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "hamjet/algebra/composition.hpp"
#include "hamjet/maps/exactness.hpp"
#include "hamjet/maps/symplecticity.hpp"
#include "support/flow.hpp"

namespace hamjet::test {

template <class T>
PartialInversion<T> inverted_jet(const FlowJet<T>& jet, const GeneratingFunctionKind& kind) {
  return invert_partially(jet, kind);
}
template <class T>
PartialInversion<T> inverted_jet(const FlowJet<T>& jet, const char* kind) {
  return inverted_jet(jet, parse_kind(kind, jet.size() / 2));
}
/// The composition of two maps: the deviations of the first are inserted into the second.
template <class T>
FlowJet<T> chained(const FlowJet<T>& second, const FlowJet<T>& first) {
  const auto inner = without_constants(first);
  return compose(second, inner);
}

template <class T>
std::vector<SymplecticityDefect> symplecticity(const FlowJet<T>& jet) {
  return symplecticity_by_degree(jet);
}

/// The largest scaled symplecticity defect over all degrees.
template <class T>
double worst_symplecticity(const FlowJet<T>& jet) {
  double worst = 0;
  for (const auto& defect : symplecticity(jet)) worst = larger(worst, defect.scaled);
  return worst;
}

/// The jet of the paper's orbit after the given time instead of its own.
template <class Real>
FlowJet<Real> paper_jet(double duration, int order, const GaussSettings& settings = adaptive()) {
  auto flow = flow_of<Real>(paper_orbit(), order);
  flow.duration = duration;
  return run_gauss(flow, settings);
}

/// A quarter of the smallest Kepler period of the paper's orbit, after which every kind is
/// well-conditioned.
inline constexpr double quarter_period = 2.6820867274609114512;

}  // namespace hamjet::test
