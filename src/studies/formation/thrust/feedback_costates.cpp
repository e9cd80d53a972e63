#include "feedback_costates.hpp"

#include <algorithm>

#include "../../../algebra/state_sums.hpp"
#include "../../jets_along_time.hpp"
#include "../formation_problem.hpp"
#include "hamjet/maps/generating_function.hpp"

namespace hamjet {

FeedbackCostates::FeedbackCostates(const Scene& scene, const ComputedProblem& problem,
                                   const ThrustedFlight& flight)
    : flight_(flight),
      units_(metric_units(scene)),
      frame_(scene.transfer->frame),
      costates_(static_cast<std::size_t>(scene.transfer->feedback)),
      values_(problem.space) {
  constexpr std::size_t states = ThrustedFlight::states;
  ComputedProblem back = problem;
  back.nominal = flight.orbit_end();
  // The orbit coasts; what its costates are after a flight is rounding.
  std::fill(back.nominal.begin() + states, back.nominal.end(), 0.0);
  back.start_time = problem.start_time + flight.time();
  std::vector<double> times;
  for (std::size_t k = count(); k-- > 0;) times.push_back(time(k) - flight.time());
  visit_jets(back, symplectic_integrator(scene), times,
             [&](std::size_t index, const FlowJet<double>& jet) {
               costates_[count() - 1 - index] =
                   invert_partially(jet, parse_kind("F1", states)).remaining_final;
             });
  for (std::size_t k = 0; k < count(); ++k) {
    chiefs_.push_back(flight.chief_at(time(k)));
    orbits_.push_back(flight.orbit_at(time(k)));
  }
  values_ = MonomialValues(costates_.front().front().space_pointer());
}

double FeedbackCostates::time(std::size_t k) const {
  return k == count() ? flight_.time()
                      : flight_.time() * static_cast<double>(k) / static_cast<double>(count());
}

ChiefFrame FeedbackCostates::frame(std::size_t k) const { return {chiefs_[k], units_, frame_}; }

std::vector<double> FeedbackCostates::with_costates(std::size_t k,
                                                    const std::vector<double>& state) {
  std::vector<double> ends = state_difference(state, orbits_[k]);
  ends.insert(ends.end(), flight_.end().begin(), flight_.end().end());
  values_.set_point(ends);
  std::vector<double> z = state;
  for (const Series<double>& one : costates_[k]) z.push_back(values_.value(one, one.order()));
  return z;
}

}  // namespace hamjet
