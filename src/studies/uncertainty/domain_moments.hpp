#pragma once

#include <optional>
#include <vector>

#include "../integration.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "initial_states.hpp"
#include "uncertainty.hpp"

namespace hamjet {

/// The same polynomials in standard normal variables that are turned so that the first is the one
/// that the linear flow stretches most.
Matrix<double> stretched_factor(const Covariance& covariance, const Matrix<double>& linear);

/// What belongs to one time of the scene's.
struct TimeOfDomains {
  Vector<double> chief;             ///< canonical state of the chief's nominal
  Matrix<double> to_frame;          ///< from canonical deviations to the frame of the results
  std::optional<Covariance> noise;  ///< canonical, if there is some
};

/// Adds to a result, whose points have all else, what the scene's domains say:
/// UncertainState::split and UncertaintyResult::domains.
///
/// The deviations of a start within three standard deviations, in the standard normal variables of
/// stretched_factor, are split by split_domains until the positions at all times are right to
/// `uncertainty.tolerance_m`. Beyond three standard deviations the outermost domains go on. The
/// moments are a mixture of those of the domains, each under the condition that the deviation is in
/// it, by a quadrature for normal variables within intervals.
///
/// `linear` has the linear part of each start's flow about its mean, at the last time. Throws as
/// the integrator and split_domains, Error(scene) for uncertain parameters, and Error(too_large) if
/// the polynomials of all domains take more than two gigabytes.
void set_domains(UncertaintyResult& result, const std::vector<InitialState>& starts,
                 const IntegratorSettings& integrator, const std::vector<Matrix<double>>& linear,
                 const std::vector<TimeOfDomains>& times, const ProgressCallback& progress);

}  // namespace hamjet
