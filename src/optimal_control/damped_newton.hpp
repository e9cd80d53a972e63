#pragma once

#include <fmt/format.h>

#include <Eigen/Dense>
#include <string_view>

#include "equilibration.hpp"
#include "hamjet/error.hpp"
#include "newton_settings.hpp"

namespace hamjet {

/// A full Newton step, with the rank and the scales of the matrix that it was solved with.
struct NewtonStep {
  Eigen::VectorXd change;
  Eigen::Index rank = 0;
  Equilibration scale;
};

/// How an iteration ended.
struct NewtonOutcome {
  int iterations = 0;
  double residual = 0;  ///< largest component of the residual
};

/// Solves `residual(s)` = 0 from `s`; `step(s)` returns the full Newton step, to be added. A step
/// is halved until the 2-norm of the equilibrated residual falls; a point where the residual throws
/// Error(numerical) or is not finite counts as no descent. Throws Error(numerical) that names
/// `what`, iteration, residual and rank.
template <class Residual, class Step>
NewtonOutcome damped_newton(Eigen::VectorXd& s, std::string_view what,
                            const NewtonSettings& settings, const Residual& residual,
                            const Step& step) {
  constexpr int most_halvings = 30;
  constexpr double least_descent =
      1e-4;  // fraction of the fall predicted by linearisation that counts as descent
  constexpr double least_gain =
      0.5;  // factor by which a further step must reduce a residual near round-off
  Eigen::VectorXd r = residual(s);
  if (!r.allFinite()) {
    throw Error(ErrorKind::numerical,
                fmt::format("{}: the start gives a residual that is not finite", what));
  }
  for (int iteration = 0;; ++iteration) {
    const double largest = r.lpNorm<Eigen::Infinity>();
    if (settings.watch) settings.watch(iteration, largest);
    if (largest == 0) return {iteration, largest};
    const NewtonStep newton = step(s);
    const Eigen::VectorXd scaled = newton.scale.rows.cwiseProduct(r);
    const Eigen::VectorXd scaled_unknowns = s.cwiseQuotient(newton.scale.columns);
    const bool is_solved = scaled.lpNorm<Eigen::Infinity>() <=
                           settings.tolerance * scaled_unknowns.lpNorm<Eigen::Infinity>();
    if (iteration >= settings.most_iterations && !is_solved) {
      throw Error(ErrorKind::numerical,
                  fmt::format("{}: no convergence in {} iterations, residual {:.3g}, rank {} of {}",
                              what, iteration, largest, newton.rank, s.size()));
    }
    const double norm = scaled.stableNorm();
    Eigen::VectorXd trial;
    Eigen::VectorXd trial_residual;
    bool is_lower = false;
    double damping = 1;
    for (int halvings = 0; halvings <= (is_solved ? 0 : most_halvings) && !is_lower; ++halvings) {
      trial = s + damping * newton.change;
      const double gain = is_solved ? least_gain : 1 - least_descent * damping;
      try {
        trial_residual = residual(trial);
        is_lower = newton.scale.rows.cwiseProduct(trial_residual).stableNorm() < gain * norm;
      } catch (const Error& error) {
        if (error.kind() != ErrorKind::numerical) throw;
      }
      damping /= 2;
    }
    if (!is_lower && is_solved) return {iteration, largest};
    if (!is_lower) {
      throw Error(ErrorKind::numerical,
                  fmt::format("{}: stopped after {} iterations at a residual of {:.3g} that no "
                              "Newton step lowers, rank {} of {}",
                              what, iteration, largest, newton.rank, s.size()));
    }
    s = trial;
    r = trial_residual;
  }
}

}  // namespace hamjet
