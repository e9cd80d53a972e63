#pragma once

#include <string>
#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// What a generating function near one of its singular times makes of the error of the map, which
/// is measured against a reference, else estimated, else rounding alone; empty where eight digits
/// of its linear part are left. The map may be right to all its digits there, and no check of it
/// fails.
std::string near_singular_warning(const Scene& scene, const RunResult& run);

/// A degree of the jet of which not one digit is right, by its error against a reference or else
/// its estimate; empty where there is none. Fixed steps promise no error, so that no check fails
/// there.
std::string no_digits_warning(const RunResult& run);

/// All of these and tolerance_warning, for those who show them.
std::vector<std::string> run_warnings(const Scene& scene, const RunResult& run);

}  // namespace hamjet
