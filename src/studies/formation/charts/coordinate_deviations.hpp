#pragma once

#include <optional>
#include <string>

#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

// Deviations from a nominal that is no orbit: along three coordinates, with their rates as
// velocities.

/// The law of the rates, if the first n components of the system's field are linear in coordinates
/// and momenta, the same at all places and times, and momenta follow from rates; otherwise no
/// value. `about` is a state near which this is looked at.
std::optional<VelocityLaw> velocity_law(const DynamicalSystem& system,
                                        const std::vector<double>& about);

/// What a scene without an orbit lacks for studies of deviations, as a message: "..., got ..., must
/// be ..."; empty if nothing.
std::string missing_for_deviations(const Scene& scene);

/// What such a scene, which lacks nothing for deviations, lacks for a thrust that lasts: momenta
/// that an acceleration along the coordinates changes at its own rate (W = 1 in VelocityLaw). The
/// message is one of the same form; empty if nothing.
std::string missing_for_thrust(const Scene& scene);

}  // namespace hamjet
