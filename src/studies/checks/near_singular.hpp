#pragma once

#include <string>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// What a generating function near one of its singular times makes of the error of the map, which
/// is measured against a reference, else estimated, else rounding alone; empty where eight digits of
/// its linear part are left. The map may be right to all its digits there, and no check of it
/// fails.
std::string near_singular_warning(const Scene& scene, const RunResult& run);

}  // namespace hamjet
