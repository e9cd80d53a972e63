#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// A flight of which a study tells something: of the chief, a deputy, a frozen orbit.
struct CheckedFlight {
  std::string name;           ///< "the chief"
  std::vector<double> start;  ///< (q, p), canonical
  double time = 0;            ///< canonical, negative backwards
};

/// The chief's over a time, and that of the scene's deputy, if it has one and `with_deputy`.
std::vector<CheckedFlight> flights_of(const Scene& scene, double time, bool with_deputy);

/// The canonical distance from the centre below which a flight fails the scene's check `surface`;
/// none where that is off, or the model has no radius.
std::optional<double> surface_limit(const Scene& scene);

/// The least distance of a flight from the centre, between its steps too; canonical. A flight
/// that cannot be followed comes to the centre, and says why in `failure`.
LowestPoint lowest_point(const SharedSystem& system, const std::vector<double>& start, double time);

/// The self-checks that belong to every study, `energy` and `surface`, of its flights with the full
/// equations of motion; each tells of the flight that comes out worst. The table [checks] turns
/// them off and sets their limits, as those of a run; that of the energy is else 1e-9. A flight
/// that cannot be followed fails them.
std::vector<SelfCheck> flight_checks(const Scene& scene, const std::vector<CheckedFlight>& flights);

}  // namespace hamjet
