#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hamjet/studies/propagation.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// What serves a system that a scene writes in place of the studies of orbits.
inline constexpr std::string_view studies_of_own_systems =
    "for equations of one's own `hamjet transfer`, `hamjet validity` and `hamjet uncertainty` have "
    "the deviations of a Hamiltonian, along its coordinates, `hamjet periodic` its periodic "
    "orbits, `hamjet poincare` its events, and `hamjet run` the polynomials of any system";

/// Throws Error(scene) unless a study of formation flight can be made on the scene: it needs the
/// study's table, an orbit, all variables, double precision and a symplectic integrator.
void require_formation_problem(const Scene& scene, bool has_table, std::string_view table);

/// The same, but for the orbit, where the study also serves systems without one, along three
/// coordinates (missing_for_deviations).
void require_deviation_problem(const Scene& scene, bool has_table, std::string_view table);

/// Whether the deputy has the chief's C_D A / m and C_R A / m.
bool is_like_chief(const Scene& scene);

/// The chief's own system, beside the problem of an orbit of the scene with_deputy_coefficients.
SharedSystem system_of_chief(const Scene& scene, const ComputedProblem& orbit);

/// Throws Error(scene) if jets are expanded in a parameter.
void require_states_alone(const Scene& scene, std::string_view table);

/// Throws Error(scene) if the deputy is unlike its chief, or if jets are expanded in a parameter:
/// this study has polynomials about one kind of spacecraft.
void require_one_spacecraft(const Scene& scene, std::string_view table);

/// The scene whose chief has the deputy's C_D A / m and C_R A / m, in the light of the chief.
Scene with_deputy_coefficients(Scene scene);

/// Whether polynomials in these coordinates can have parameters among their variables.
inline bool serve_parameters(const CoordinatesAtEnds& coordinates) {
  return coordinates == JetCoordinates::cartesian || coordinates == JetCoordinates::flow_box;
}

/// The scene whose states end with the parameters in which the deputy differs from the chief, those
/// alone, and whose jets are expanded in them.
Scene with_deputy_parameters(Scene scene);

/// The deputy's parameters less the chief's, for a scene of with_deputy_parameters.
std::vector<double> deputy_parameters(const Scene& scene);

/// The names of the parameters in which the deputy differs from the chief, and the difference of
/// one of all parameters, which is 0 for others.
std::vector<std::string> differing_parameters(const Scene& scene);
double parameter_difference(const Scene& scene, std::string_view name);

/// The deputy's deviation (dq, dp) from the chief at the start, canonical, and that of its
/// parameters, for a scene of with_deputy_parameters.
std::vector<double> deputy_deviation(const Scene& scene);

/// The scene's first integrator that is symplectic in (q, p), as generating functions require.
const IntegratorSettings& symplectic_integrator(const Scene& scene);

}  // namespace hamjet
