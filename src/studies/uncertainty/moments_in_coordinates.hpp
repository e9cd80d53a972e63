#pragma once

#include <optional>
#include <vector>

#include "../integration.hpp"
#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "initial_states.hpp"
#include "uncertainty.hpp"

namespace hamjet {

/// Moments of polynomials of a start's deviations, for the orders 1..N.
std::vector<Cumulants> moments_by_order(const std::vector<Series<double>>& map,
                                        const InitialState& start);

/// The moments of coordinates at the end (see DeputyFlowPropagation::end_period_place), including,
/// to first order, the noise of canonical states there; `jet` is the jet of these states.
std::vector<Cumulants> charted_moments(const std::vector<Series<double>>& coordinates,
                                       std::optional<std::size_t> period_place,
                                       const InitialState& start, const FlowJet<double>& jet,
                                       const std::optional<Covariance>& noise);

/// Declares each distribution to be the image of a start under a flow that multiplies volumes by
/// exp(`log_change`); does nothing if the start's covariance is singular, or if the start has
/// parameters, of which the flow makes more than one state.
void told_of_start(std::vector<Cumulants>& all, const InitialState& start, double log_change = 0);

/// Adds an independent vector, random noise or a known one, to all distributions.
void add_noise(std::vector<Cumulants>& all, const Cumulants& noise);

/// The moments of the difference of two independent vectors, for the orders that both have.
std::vector<Cumulants> difference_by_order(const std::vector<Cumulants>& from,
                                           const std::vector<Cumulants>& what);

/// The moments of a start by polynomials about its own mean at one time, and the data that show
/// whether polynomials about the chief hold there.
struct MeanOfStart {
  Vector<double>
      deviation;  ///< deviation of the mean's own flight from the chief's, in canonical units
  Matrix<double> to_frame;  ///< matrix from canonical deviations to the frame of the results
  Vector<double> standard_deviations;  ///< standard deviations in this frame, by the linear theory
};

/// The error of polynomials about the chief at the flown mean of a start, in standard deviations of
/// the worst component. If it is large, their moments belong to another place. For a component
/// without a deviation, a thousandth of the distance from the chief replaces the standard
/// deviation. Infinity if the mean has no place in the coordinates.
double miss_of_mean(const DeputyFlow& flow, int order, const InitialState& start,
                    const MeanOfStart& mean);
/// Above this, polynomials in these coordinates are not used for a spacecraft.
constexpr double largest_miss = 0.1;

/// The moments at the last time in the coordinates that the scene asks for (`uncertainty
/// .coordinates`); `jet`, `noise` and `means` (one for each start) belong to that time. Coordinates
/// whose polynomials miss the mean of a start are refused.
std::vector<MomentsInCoordinates> moments_in_coordinates(
    const Scene& scene, const ComputedProblem& problem, const IntegratorSettings& integrator,
    const std::vector<InitialState>& starts, const FlowJet<double>& jet,
    const std::vector<MeanOfStart>& means, const std::optional<Covariance>& noise,
    const ProgressCallback& progress);

}  // namespace hamjet
