#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "../flights/flight_arcs.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// Why the check `energy` of a system without a conserved quantity does not apply.
inline constexpr const char* no_energy_is_kept =
    "the forces depend on the time or take energy away, so that no energy is kept";

/// A flight that a study reports: that of the chief, a deputy, or a frozen orbit.
struct CheckedFlight {
  std::string name;           ///< for example "the chief"
  std::vector<double> start;  ///< (q, p), in canonical units
  ClockTime start_time;       ///< the system's clock at the start
  double time = 0;            ///< in canonical units; negative is backwards
};

/// The flight of the chief over a time and, if `with_deputy`, that of the scene's deputy, if it has
/// one.
std::vector<CheckedFlight> flights_of(const Scene& scene, double time, bool with_deputy);

/// The canonical distance from the centre below which a flight fails the scene's check `surface`;
/// no value if the check is off, or the model has no radius.
std::optional<double> surface_limit(const Scene& scene);

/// The least distance of a flight from the centre, also between its steps, in canonical units; the
/// start stands at `start_time` of the system's clock. If a
/// flight cannot be followed, its distance is 0 and `failure` gives the reason.
LowestPoint lowest_point(const SharedSystem& system, const std::vector<double>& start,
                         const ClockTime& start_time, double time);

/// The self-checks that belong to every study, `energy` and `surface`, for its flights with the
/// full equations of motion; each check reports the flight with the worst outcome. The table
/// [checks] turns them off and sets their limits, as for a run; the default limit of the energy is
/// 1e-9. A flight that cannot be followed fails both checks.
///
/// An observer, if given, sees the arcs of all flights side by side, whatever is checked; the
/// flights then begin and end together, and one that cannot be followed throws as fly_arcs.
std::vector<SelfCheck> flight_checks(const Scene& scene, const std::vector<CheckedFlight>& flights,
                                     const std::function<void(const FlightArc&)>& observer = {});

}  // namespace hamjet
