#pragma once

#include "../jets_along_time.hpp"
#include "hamjet/uncertainty/covariance.hpp"

namespace hamjet {

/// The covariance that white noise of the acceleration, of power spectral density q along each
/// axis, adds to a linear flow,
///
///   Q(t) = q integral from 0 to t of Phi(t, s) G G^T Phi(t, s)^T ds ,   G = [0; 1] ,
///
/// computed by Simpson's rule, refined until two successive results agree to 1e-4.
class ProcessNoise {
 public:
  /// `problem`, of order 1, and `settings` must outlive this object. q is canonical; `period` is
  /// that of a revolution or, if there is none, a similar time.
  ProcessNoise(const ComputedProblem& problem, const IntegratorSettings& settings, double density,
               double period);

  /// The covariance of canonical deviations at a time.
  Covariance at(double time) const;

 private:
  Covariance by_intervals(double time, int count) const;

  const ComputedProblem* problem_;
  const IntegratorSettings* settings_;
  double density_;
  double period_;
};

}  // namespace hamjet
