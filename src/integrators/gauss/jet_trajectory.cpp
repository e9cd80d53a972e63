#include "hamjet/integrators/jet_trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "../../algebra/instantiated_real.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// The number of jets that fit the memory, but at least two; between two kept jets steps are
/// repeated.
template <class Real>
std::size_t most_jets(const FlowProblem<Real>& problem, double most_bytes) {
  const double each = static_cast<double>(problem.initial_state.size()) *
                      static_cast<double>(problem.space->size()) * sizeof(Real);
  return static_cast<std::size_t>(std::clamp(most_bytes / each, 2.0, 1e9));
}

}  // namespace

template <class Real>
JetTrajectory<Real>::JetTrajectory(const FlowProblem<Real>& problem, const GaussSettings& settings,
                                   double most_bytes, const StepObserver<Real>& observer)
    : problem_(problem), settings_(settings), most_kept_(most_jets(problem, most_bytes)) {
  validate(problem);
  problem_.observes_constant_terms =
      false;  // the jets at the steps are kept, so that they must have all variables
  times_.push_back(Real(0));
  kept_.push_back(starting_jet(problem));
  final_ = integrate_gauss<Real>(problem_, settings, statistics_,
                                 [&](const Real& time, const FlowJet<Real>& jet) {
                                   times_.push_back(time);
                                   keep(jet);
                                   if (observer) observer(time, jet);
                                 });
  // A short step has a given length, and nothing to choose or to measure.
  settings_.tolerance.reset();
  settings_.estimates_step_error = false;
  settings_.controls_all_degrees = false;
  settings_.profile = nullptr;
}

template <class Real>
void JetTrajectory<Real>::keep(const FlowJet<Real>& jet) {
  if ((times_.size() - 1) % stride_ != 0) return;
  if (kept_.size() == most_kept_) {
    for (std::size_t i = 1; 2 * i < kept_.size(); ++i) kept_[i] = std::move(kept_[2 * i]);
    kept_.resize((kept_.size() + 1) / 2);
    stride_ *= 2;
    if ((times_.size() - 1) % stride_ != 0) return;
  }
  kept_.push_back(jet);
}

template <class Real>
FlowJet<Real> JetTrajectory<Real>::step(FlowJet<Real> jet, const Real& from,
                                        const Real& length) const {
  FlowProblem<Real> problem = problem_;
  problem.start_time = problem_.start_time + from;
  for (std::size_t i = 0; i < jet.size(); ++i) problem.initial_state[i] = jet[i][0];
  problem.initial_jet = std::move(jet);
  problem.duration = length;
  GaussSettings settings = settings_;
  settings.step = std::abs(static_cast<double>(length));
  IntegrationStatistics statistics;
  return integrate_gauss<Real>(problem, settings, statistics);
}

template <class Real>
FlowJet<Real> JetTrajectory<Real>::at(const Real& time) const {
  const bool is_backwards = problem_.duration < 0;
  const bool is_within = is_backwards ? time <= 0 && time >= problem_.duration
                                      : time >= 0 && time <= problem_.duration;
  if (!is_within) {
    throw Error(ErrorKind::usage,
                fmt::format("trajectory of jets: the time must be between 0 and {:.17g}, got {}",
                            static_cast<double>(problem_.duration), static_cast<double>(time)));
  }
  if (time == problem_.duration) return final_;
  // The first step that begins after the time. There is an earlier one, which begins at 0.
  const auto after =
      std::upper_bound(times_.begin(), times_.end(), time,
                       [&](const Real& a, const Real& b) { return is_backwards ? a > b : a < b; });
  const auto last = static_cast<std::size_t>(after - times_.begin()) - 1;
  std::size_t taken = std::min(last / stride_, kept_.size() - 1) * stride_;
  FlowJet<Real> jet = kept_[taken / stride_];
  for (; taken < last; ++taken) {
    jet = step(std::move(jet), times_[taken], times_[taken + 1] - times_[taken]);
  }
  return time == times_[last] ? jet : step(std::move(jet), times_[last], time - times_[last]);
}

template class JetTrajectory<InstantiatedReal>;

}  // namespace hamjet
