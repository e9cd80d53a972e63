#pragma once

#include <optional>
#include <vector>

#include "../integration.hpp"
#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "initial_states.hpp"
#include "uncertainty.hpp"

namespace hamjet {

/// Moments by polynomials of a start's deviations, by the orders 1..N.
std::vector<Cumulants> moments_by_order(const std::vector<Series<double>>& map,
                                        const InitialState& start);

/// Of coordinates at the end (see DeputyFlowPropagation::end_period_place), with the noise of
/// canonical states there, whose jet is given, to first order.
std::vector<Cumulants> charted_moments(const std::vector<Series<double>>& coordinates,
                                       std::optional<std::size_t> period_place,
                                       const InitialState& start, const FlowJet<double>& jet,
                                       const std::optional<Covariance>& noise);

/// Tells each distribution that it is what a flow has made of a start; of one whose covariance is
/// singular nothing.
void told_of_start(std::vector<Cumulants>& all, const InitialState& start);

/// Adds an independent vector, noise or a known one, to all.
void add_noise(std::vector<Cumulants>& all, const Cumulants& noise);

/// Of the difference of two independent vectors, as far as both have orders.
std::vector<Cumulants> difference_by_order(const std::vector<Cumulants>& from,
                                           const std::vector<Cumulants>& what);

/// The moments of a start by polynomials about its own mean at one time, and what tells whether
/// polynomials about the chief hold there.
struct MeanOfStart {
  Vector<double> deviation;            ///< of the mean's own flight from the chief's, canonical
  Matrix<double> to_frame;             ///< of canonical deviations to the frame of the results
  Vector<double> standard_deviations;  ///< there, of the linear theory
};

/// By how many standard deviations, in the worst component, polynomials about the chief miss where
/// the mean of a start is flown to: what they say of the distribution is then of another place. Of
/// a component without a deviation the thousandth part of the way from the chief stands for one.
/// Infinity where the mean has no place in the coordinates.
double miss_of_mean(const DeputyFlow& flow, int order, const InitialState& start,
                    const MeanOfStart& mean);
/// Above this the coordinates say nothing of a spacecraft.
constexpr double largest_miss = 0.1;

/// The moments at the last time in the coordinates that the scene asks for (`uncertainty
/// .coordinates`); `jet`, `noise` and `means` (of each start) are of that time. Coordinates whose
/// polynomials miss the mean of a start are refused.
std::vector<MomentsInCoordinates> moments_in_coordinates(
    const Scene& scene, const ComputedProblem& problem, const IntegratorSettings& integrator,
    const std::vector<InitialState>& starts, const FlowJet<double>& jet,
    const std::vector<MeanOfStart>& means, const std::optional<Covariance>& noise,
    const ProgressCallback& progress);

}  // namespace hamjet
