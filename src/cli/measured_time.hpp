#pragma once

#include <string>

#include "hamjet/studies/scene.hpp"

namespace hamjet::cli {

/// How long each command would take that a scene has the tables for, in a line for people: each
/// study is begun in a process of its own and ended after a second. What has not finished by then
/// takes at least as long as its progress says, for what follows the task that it is in is not
/// known.
std::string measured_times(const Scene& scene);

}  // namespace hamjet::cli
