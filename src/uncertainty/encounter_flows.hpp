#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "../integrators/taylor_flow.hpp"
#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet {

/// Flights side by side of both spacecraft of an encounter, each by its own equations of motion:
/// a TaylorFlow where these are the same, and otherwise one for each of them, which expands the
/// lanes of the other one too.
class EncounterFlows {
 public:
  explicit EncounterFlows(const EncounterProblem& problem) {
    flows_.emplace_back(problem.system_of(0));
    if (!problem.has_one_system()) flows_.emplace_back(problem.system_of(1));
  }

  /// As those of TaylorFlow, of a lane whose state is of this spacecraft.
  void set_state(std::size_t lane, const ClockTime& time, std::span<const double> state) {
    for (TaylorFlow& flow : flows_) flow.set_state(lane, time, state);
  }
  void expand() {
    for (TaylorFlow& flow : flows_) flow.expand();
  }
  double reach(std::size_t craft, std::size_t lane) const { return of(craft).reach(lane); }
  bool ends_at_break(std::size_t craft, std::size_t lane, double step) const {
    return of(craft).ends_at_break(lane, step);
  }
  void evaluate(std::size_t craft, std::size_t lane, double time, std::span<double> state) const {
    of(craft).evaluate(lane, time, state);
  }

  /// As that of TaylorFlow, of states of one spacecraft.
  void advance(std::size_t craft, std::span<double> states, const ClockTime& start_time,
               std::span<const double> times) {
    flows_[place(craft)].advance(states, start_time, times);
  }

 private:
  std::size_t place(std::size_t craft) const { return flows_.size() == 1 ? 0 : craft; }
  const TaylorFlow& of(std::size_t craft) const { return flows_[place(craft)]; }

  std::vector<TaylorFlow> flows_;
};

}  // namespace hamjet
