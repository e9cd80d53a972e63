#pragma once

#include <optional>
#include <vector>

#include "../integration.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "initial_states.hpp"
#include "uncertainty.hpp"

namespace hamjet {

/// Moments by polynomials of a start's deviations, by the orders 1..N.
std::vector<Cumulants> moments_by_order(const std::vector<Series<double>>& map,
                                        const InitialState& start);

/// Of coordinates at the end, with the noise of canonical states there, whose jet is given, to
/// first order.
std::vector<Cumulants> charted_moments(const std::vector<Series<double>>& coordinates,
                                       const InitialState& start, const FlowJet<double>& jet,
                                       const std::optional<Covariance>& noise);

/// Adds an independent vector, noise or a known one, to all.
void add_noise(std::vector<Cumulants>& all, const Cumulants& noise);

/// Of the difference of two independent vectors, as far as both have orders.
std::vector<Cumulants> difference_by_order(const std::vector<Cumulants>& from,
                                           const std::vector<Cumulants>& what);

/// The moments at the last time in the coordinates that the scene asks for (`uncertainty
/// .coordinates`); `jet` and `noise` are of that time.
std::vector<MomentsInCoordinates> moments_in_coordinates(
    const Scene& scene, const ComputedProblem& problem, const IntegratorSettings& integrator,
    const std::vector<InitialState>& starts, const FlowJet<double>& jet,
    const std::optional<Covariance>& noise, const ProgressCallback& progress);

}  // namespace hamjet
