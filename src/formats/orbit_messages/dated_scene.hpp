#pragma once

#include <string>
#include <vector>

#include "hamjet/astronomy/epoch.hpp"
#include "hamjet/studies/scene.hpp"

// Statements that messages of different kinds share about a scene that has an ephemeris.

namespace hamjet::io {

/// The present time in UTC, to the second.
Epoch current_epoch();

/// The time system of a scene's dates.
TimeSystem time_system_of(const EphemerisSettings& settings);

/// Which program wrote the message, from which scene, and what the message describes; printable
/// ASCII.
std::vector<std::string> origin_comments(const Scene& scene, const std::string& source);

/// The model by which states move, their axes, and the calendar of their dates.
std::vector<std::string> model_comments(const Scene& scene);

/// The moment of a canonical time. The reader of scenes has checked the scene's own time span, but
/// a stored jet may bring another one: throws Error(input_output) for a moment that cannot be
/// dated.
Epoch moment_of(const Scene& scene, double time);

}  // namespace hamjet::io
