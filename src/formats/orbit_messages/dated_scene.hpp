#pragma once

#include <string>
#include <vector>

#include "hamjet/detail/formats/epoch.hpp"
#include "hamjet/studies/scene.hpp"

// What messages of different kinds say alike of a scene that has an ephemeris.

namespace hamjet::io {

/// The present second, UTC.
Epoch current_epoch();

/// What wrote a message, of which scene, and what the message is of; printable ASCII.
std::vector<std::string> origin_comments(const Scene& scene, const std::string& source);

/// By which model states move, in which axes and by which calendar.
std::vector<std::string> model_comments(const Scene& scene);

/// The moment of a canonical time. The reader of scenes has checked the scene's own span; a stored
/// jet may bring another one: throws Error(input_output) for a moment that is not known.
Epoch moment_of(const Scene& scene, double time);

}  // namespace hamjet::io
