#pragma once

#include <string_view>
#include <vector>

#include "hamjet/uncertainty/polynomial_moments.hpp"
#include "initial_states.hpp"
#include "uncertainty.hpp"

namespace hamjet {

/// The scene whose chief is the spacecraft of a start: with its C_D A / m and C_R A / m, and with
/// states that end with the start's uncertain parameters.
Scene scene_of_start(const Scene& scene, const InitialState& start);

/// Whether a spacecraft takes polynomials of its own: its parameters are uncertain, or it is not
/// like its chief.
bool takes_own_flow(const Scene& scene, const InitialState& start);

/// Throws Error(scene) if a parameter is uncertain or jets are expanded in one: paths of two
/// spacecraft are polynomials of twelve numbers, those of their states.
void require_known_parameters(const Scene& scene, std::string_view table);

/// Throws Error(scene) if the scene asks for polynomials in other coordinates beside uncertain
/// parameters or an unlike deputy.
void require_moments_of_parameters(const Scene& scene, const std::vector<InitialState>& starts);

/// The moments of the deputy less the chief where both share uncertain parameters, for the orders
/// 1..N: for given values of these both are independent, and over the values it is a mixture, by a
/// quadrature that is exact for these polynomials. `deputy` and `chief` are polynomials, without
/// constants, of the deviations of each start from its mean.
std::vector<Cumulants> relative_moments(const std::vector<Series<double>>& deputy,
                                        const InitialState& of_deputy,
                                        const std::vector<Series<double>>& chief,
                                        const InitialState& of_chief);

/// What each uncertain parameter alone adds at one time to the standard deviations of the states,
/// linearly; `flows` has the linear part of each start's flow in the frame of the results, 6 rows.
std::vector<ParameterEffect> parameter_effects(const std::vector<InitialState>& starts,
                                               const std::vector<Matrix<double>>& flows);

}  // namespace hamjet
