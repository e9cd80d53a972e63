#pragma once

#include "../../studies/paper/canonical_transformation.hpp"
#include "../../studies/paper/energy_conservation.hpp"
#include "../../studies/paper/optimal_control_study.hpp"
#include "hamjet/detail/report/study_report.hpp"

namespace hamjet::io {

/// A trajectory for each step size, `figure.svg` with the phase planes and the energy errors,
/// `summary.json`.
template <>
StudyReport study_report(const CanonicalTransformationResult& result, Figure figure);

/// Writes `trajectory.csv`, `summary.json`, and `figure.svg` with the energy errors and the step
/// size along time.
template <>
StudyReport study_report(const EnergyConservationResult& result, Figure figure);

/// `trajectory.csv` and `convergence.csv`; the trajectory, its controls and the cost's error
/// against the step as a figure.
template <>
StudyReport study_report(const OptimalControlResult& result, Figure figure);

}  // namespace hamjet::io
