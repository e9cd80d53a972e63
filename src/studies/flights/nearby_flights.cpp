#include "nearby_flights.hpp"

#include <cmath>

#include "../../integrators/gauss/gauss_tolerance.hpp"
#include "../exact_flow.hpp"

namespace hamjet {

void NearbyFlights::try_tolerance(const std::vector<double>& start, const ClockTime& start_time,
                                  double duration) {
  const FlowProblem<double> problem = trajectory_problem(system_, start, start_time, duration);
  validate(problem);
  if (!needs_choice(problem, exact_gauss())) return;
  step_tolerance_ = choose_step_tolerance(problem, exact_gauss()).tolerance;
  tried_ = std::abs(duration);
}

std::vector<double> NearbyFlights::end(const std::vector<double>& start,
                                       const ClockTime& start_time, double duration) {
  const FlowProblem<double> problem = trajectory_problem(system_, start, start_time, duration);
  const GaussSettings settings = exact_gauss();
  IntegrationStatistics statistics;
  if (!needs_choice(problem, settings)) {
    return nominal_of(integrate_gauss(problem, settings, statistics));
  }
  if (step_tolerance_ && std::abs(duration) <= tried_) {
    validate(problem);
    return nominal_of(
        integrate_with_step_tolerance(problem, settings, *step_tolerance_, statistics));
  }
  const FlowJet<double> jet = integrate_gauss(problem, settings, statistics);
  step_tolerance_ = statistics.step_tolerance;
  tried_ = std::abs(duration);
  return nominal_of(jet);
}

FlowJet<double> NearbyFlights::linear_end(const std::vector<double>& start,
                                          const ClockTime& start_time, double duration) {
  if (!step_tolerance_ || std::abs(duration) > tried_) try_tolerance(start, start_time, duration);
  const FlowProblem<double> problem =
      linear_problem(system_, SeriesSpace::create(start.size(), 1), start, start_time, duration);
  validate(problem);
  const GaussSettings settings = exact_gauss();
  IntegrationStatistics statistics;
  return integrate_with_step_tolerance(problem, settings,
                                       step_tolerance_.value_or(*settings.tolerance), statistics);
}

}  // namespace hamjet
