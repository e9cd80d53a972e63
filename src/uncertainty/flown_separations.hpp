#pragma once

#include <span>
#include <vector>

#include "hamjet/uncertainty/encounter.hpp"
#include "relative_paths.hpp"

namespace hamjet {

/// The least separations in the window of spacecraft that start with these deviations, flown with
/// the full equations of motion. They share neither polynomials nor nodes with RelativePaths: each
/// flight is looked at along its own expansions in time, and its minima are the roots of rho.v that
/// lie between the looks. In the units of the system. Throws Error(numerical) where a flight ends
/// in the centre.
std::vector<double> flown_separations(const EncounterProblem& problem,
                                      std::span<const EncounterDeviation> deviations);

/// The same of the means alone.
double flown_separation_of_means(const EncounterProblem& problem);

/// What is so many times a separation away is as good as anything further.
constexpr double farthest_told = 2;

/// The places of so many of the separations, or all, that are nearest to one that matters, the
/// nearest first: where flights are compared.
std::vector<std::size_t> nearest_to(double wanted, std::span<const double> separations,
                                    std::size_t count);

/// By how much a flight differs from what was told of it, as far as it matters to a separation:
/// farthest_told.
double difference_near(double wanted, double told, double flown);

}  // namespace hamjet
