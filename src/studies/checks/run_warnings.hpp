#pragma once

#include <string>
#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// A warning about a generating function near one of its singular times, which magnifies the error
/// of the map. This error is measured against a reference, or else estimated, or else rounding
/// alone. The text is empty if eight digits of the linear part are left. The map itself may be
/// right to all its digits, so that no check of it fails.
std::string near_singular_warning(const Scene& scene, const RunResult& run);

/// A warning about a degree of the jet without a single right digit, by its error against a
/// reference or else its estimate; empty if there is none. Fixed steps promise no error, so that no
/// check fails in this case.
std::string no_digits_warning(const RunResult& run);

/// The same warning for the run's polynomials in the scene's coordinates, by
/// degrees_without_digits.
std::string charted_digits_warning(const Scene& scene, const RunResult& run);

/// A warning about fixed steps that pass over edges of the shadow; empty for other runs.
std::string passed_edges_warning(const Scene& scene, const RunResult& run);

/// All of these warnings and tolerance_warning.
std::vector<std::string> run_warnings(const Scene& scene, const RunResult& run);

}  // namespace hamjet
