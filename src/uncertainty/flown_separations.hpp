#pragma once

#include <span>
#include <vector>

#include "hamjet/uncertainty/encounter.hpp"
#include "relative_paths.hpp"

namespace hamjet {

/// The least separations in the window of spacecraft that start with these deviations, flown with
/// the full equations of motion. The flights share neither polynomials nor nodes with
/// RelativePaths: each is looked at along its own expansions in time, and its minima are the roots
/// of rho.v between the looks. Lengths are in the units of the system. Throws Error(numerical)
/// where a flight ends in the centre.
std::vector<double> flown_separations(const EncounterProblem& problem,
                                      std::span<const EncounterDeviation> deviations);

/// The least separation of the means alone.
double flown_separation_of_means(const EncounterProblem& problem);

/// Separations beyond this multiple of the one that matters are all treated alike.
constexpr double farthest_told = 2;

/// The indices of the separations nearest to one that matters, the nearest first: this many, or
/// all. Flights are compared there.
std::vector<std::size_t> nearest_to(double wanted, std::span<const double> separations,
                                    std::size_t count);

/// The difference between a flight and its prediction, as far as it matters to a separation: see
/// farthest_told.
double difference_near(double wanted, double told, double flown);

}  // namespace hamjet
