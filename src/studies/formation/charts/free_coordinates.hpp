#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "hamjet/detail/maps/generating_function_kind.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// The number of coordinates along which deviations of a scene's system are told: one or two where
/// the scene writes a Hamiltonian of so many, otherwise three.
std::size_t told_coordinates(const SystemSettings& system);

/// Names of the six components of a deviation along a frame: of a system that the scene writes its
/// coordinates and, with a v before the name, their rates.
std::array<std::string, 6> component_names(const SystemSettings& system, RelativeFrame frame);

/// The places among six components of those along told coordinates: positions, then velocities.
std::vector<std::size_t> told_components(const SystemSettings& system);

/// The scene with three coordinates: where it writes a Hamiltonian of one or two, others stand
/// behind them that begin at rest and move freely, p^2 / 2 each, so that studies of three serve it.
/// What the scene wrote, its `own_text`, stays.
Scene with_free_coordinates(Scene scene);

/// The jet of such a scene after `time`, with the coordinates that move freely beside its own:
/// their flow q + t p, p is exact. Throws Error(usage) unless the jet is one of the coordinates and
/// momenta of a Hamiltonian of at most three.
FlowJet<double> with_free_coordinates(const FlowJet<double>& jet, double time);

/// A series of such a jet in the told variables alone.
Series<double> in_told_variables(const Series<double>& series, const SystemSettings& system);

/// The kind as it is told, without the letters of coordinates that move freely: `q-p` of one.
std::string told_kind(const GeneratingFunctionKind& kind, const SystemSettings& system);

/// Whether a kind takes the coordinates, and not the momenta, of all that moves freely; other such
/// kinds are told by the same letters.
bool has_told_name(const GeneratingFunctionKind& kind, const SystemSettings& system);

}  // namespace hamjet
