#pragma once

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <string_view>

#include "hamjet/error.hpp"
#include "hamjet/optimal_control/newton_settings.hpp"

namespace hamjet {

/// A Newton step and the rank of the matrix that it was solved with.
struct NewtonStep {
  Eigen::VectorXd change;
  Eigen::Index rank = 0;
};

/// How an iteration ended.
struct NewtonOutcome {
  int iterations = 0;
  double residual = 0;  ///< largest component
};

/// Solves `residual(s)` = 0 from `s`; `step(s)` returns the full Newton step, to be added. A step
/// is halved until the 2-norm of the residual falls; points where the residual cannot be evaluated,
/// an Error(numerical), or is not finite count as no descent. Throws Error(numerical) that names
/// `what`, iteration, residual and rank.
template <class Residual, class Step>
NewtonOutcome damped_newton(Eigen::VectorXd& s, std::string_view what,
                            const NewtonSettings& settings, const Residual& residual,
                            const Step& step) {
  constexpr int most_halvings = 30;
  constexpr double least_gain = 0.5;  // of a further iteration near round-off
  const auto norm_at = [&](const Eigen::VectorXd& place, Eigen::VectorXd& values) {
    try {
      values = residual(place);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      return std::numeric_limits<double>::infinity();
    }
    return values.allFinite() ? values.norm() : std::numeric_limits<double>::infinity();
  };
  Eigen::VectorXd r = residual(s);
  double norm = r.norm();
  if (!std::isfinite(norm)) {
    throw Error(ErrorKind::numerical,
                fmt::format("{}: the start gives a residual that is not finite", what));
  }
  NewtonStep last;
  for (int iteration = 0;; ++iteration) {
    const double largest = r.lpNorm<Eigen::Infinity>();
    if (settings.watch) settings.watch(iteration, largest);
    const bool is_solved = largest <= settings.tolerance * s.lpNorm<Eigen::Infinity>();
    if (largest == 0) return {iteration, largest};
    if (iteration == settings.most_iterations && !is_solved) {
      throw Error(ErrorKind::numerical,
                  fmt::format("{}: no convergence in {} iterations, residual {:.3g}, rank {} of {}",
                              what, iteration, largest, last.rank, s.size()));
    }
    last = step(s);
    double damping = 1;
    Eigen::VectorXd trial_residual;
    Eigen::VectorXd trial;
    double trial_norm = std::numeric_limits<double>::infinity();
    for (int halvings = 0; halvings <= (is_solved ? 0 : most_halvings); ++halvings) {
      trial = s + damping * last.change;
      trial_norm = norm_at(trial, trial_residual);
      if (trial_norm < (1 - 1e-4 * damping) * norm) break;
      damping /= 2;
    }
    if (is_solved && !(trial_norm < least_gain * norm)) return {iteration, largest};
    if (!(trial_norm < norm)) {
      throw Error(ErrorKind::numerical,
                  fmt::format("{}: stopped after {} iterations at a residual of {:.3g} that no "
                              "Newton step lowers, rank {} of {}",
                              what, iteration, largest, last.rank, s.size()));
    }
    s = trial;
    r = trial_residual;
    norm = trial_norm;
  }
}

}  // namespace hamjet
