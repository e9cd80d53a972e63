#include "two_point_boundary_value.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>

#include "../algebra/singular_values.hpp"
#include "damped_newton.hpp"

namespace hamjet {
namespace {

/// The largest violation of the equations by a solution, in units of the typical sizes.
constexpr double largest_violation = 1e-8;

void require(bool is_right, const std::string& problem) {
  if (!is_right) throw Error(ErrorKind::usage, "shooting: " + problem);
}

void check(const AdvanceMap& map, const OptimalControlProblem& problem,
           const ShootingSettings& settings) {
  const auto n = static_cast<Eigen::Index>(problem.states);
  const auto m = static_cast<Eigen::Index>(problem.controls);
  require(map.states() == problem.states && map.controls() == problem.controls,
          "the advance map is that of another problem");
  require(settings.intervals >= 1 && settings.intervals <= settings.steps,
          fmt::format("wrong number of intervals, got {}, must be from 1 to the {} steps",
                      settings.intervals, settings.steps));
  require(settings.state_guess.size() == n && settings.costate_guess.size() == n,
          fmt::format("wrong size of the first state or costate, must be {}", n));
  require(settings.control_guess.size() == m,
          fmt::format("wrong size of the first control, must be {}", m));
  for (const Eigen::VectorXd* sizes : {&settings.typical_state, &settings.typical_costate}) {
    require(sizes->size() == 0 || (sizes->size() == n && sizes->minCoeff() > 0),
            fmt::format("wrong typical sizes, must be {} positive numbers", n));
  }
  if (settings.conditions) {
    require(settings.conditions->directions.rows() == n &&
                settings.conditions->directions.cols() == settings.conditions->values.size(),
            fmt::format("wrong size of the conditions on the initial costate, must be {} rows and "
                        "a value for each column",
                        n));
  }
}

/// The equations of multiple shooting. The unknowns are the points at the starts of the intervals,
/// lambda_0 and lambda_n. The equations stand in the order in which the header names them, with the
/// extra conditions last.
class ShootingEquations {
 public:
  ShootingEquations(AdvanceMap& map, const OptimalControlProblem& problem,
                    const ShootingSettings& settings)
      : map_(&map),
        settings_(&settings),
        initial_(problem.initial_conditions),
        final_(problem.final_conditions),
        n_(static_cast<Eigen::Index>(problem.states)),
        intervals_(static_cast<Eigen::Index>(settings.intervals)),
        arcs_(settings.intervals) {}

  Eigen::Index unknowns() const { return 2 * n_ * intervals_ + initial_count() + final_count(); }
  Eigen::Index conditions() const {
    return settings_->conditions ? settings_->conditions->values.size() : 0;
  }

  /// The start of the iteration: points of the trajectory that the first state and costate lead to,
  /// and the best-fitting multipliers at its ends.
  Eigen::VectorXd start() {
    Eigen::VectorXd point(2 * n_);
    point << settings_->state_guess, settings_->costate_guess;
    const Arc arc = propagate_arc(*map_, point, settings_->control_guess, settings_->steps);
    Eigen::VectorXd s(unknowns());
    for (Eigen::Index j = 0; j < intervals_; ++j) {
      s.segment(2 * n_ * j, 2 * n_) = arc.points[first_step(j)];
      arcs_[static_cast<std::size_t>(j)].controls = {arc.controls[first_step(j)]};
    }
    s.segment(2 * n_ * intervals_, initial_count()) =
        initial_.nearest_multipliers(span(settings_->state_guess), -settings_->costate_guess);
    set_scale(span(settings_->state_guess), span(arc.points.back().head(n_).eval()));
    const Eigen::VectorXd end = arc.points.back();
    s.tail(final_count()) = final_.nearest_multipliers(span(end.head(n_).eval()), end.tail(n_));
    return s;
  }

  /// Scale factors of the equations and the unknowns, from the typical sizes; set by start().
  const Equilibration& scale() const { return scale_; }

  Eigen::VectorXd residual(const Eigen::VectorXd& s) {
    evaluate(s);
    Eigen::VectorXd r(unknowns() + conditions());
    r.head(initial_count()) = initial_.conditions();
    r.segment(initial_count(), n_) = s.segment(n_, n_) + initial_.covector();
    Eigen::Index row = initial_count() + n_;
    for (Eigen::Index j = 0; j + 1 < intervals_; ++j, row += 2 * n_) {
      r.segment(row, 2 * n_) = end_of(j) - s.segment(2 * n_ * (j + 1), 2 * n_);
    }
    r.segment(row, final_count()) = final_.conditions();
    r.segment(row + final_count(), n_) = end_of(intervals_ - 1).tail(n_) - final_.covector();
    if (settings_->conditions) {
      r.tail(conditions()) = settings_->conditions->directions.transpose() * s.segment(n_, n_) -
                             settings_->conditions->values;
    }
    return r;
  }

  /// The derivative of the residual at the place of its last evaluation.
  Eigen::MatrixXd matrix() const {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(unknowns() + conditions(), unknowns());
    const Eigen::Index first_multiplier = 2 * n_ * intervals_;
    const Eigen::Index last_point = 2 * n_ * (intervals_ - 1);
    a.block(0, 0, initial_count(), n_) = initial_.jacobian();
    a.block(initial_count(), 0, n_, n_) = initial_.covector_slope();
    a.block(initial_count(), n_, n_, n_).setIdentity();
    a.block(initial_count(), first_multiplier, n_, initial_count()) =
        initial_.jacobian().transpose();
    Eigen::Index row = initial_count() + n_;
    for (Eigen::Index j = 0; j + 1 < intervals_; ++j, row += 2 * n_) {
      a.block(row, 2 * n_ * j, 2 * n_, 2 * n_) = slope_of(j);
      a.block(row, 2 * n_ * (j + 1), 2 * n_, 2 * n_).diagonal().setConstant(-1);
    }
    const Eigen::MatrixXd last = slope_of(intervals_ - 1);
    a.block(row, last_point, final_count(), 2 * n_) = final_.jacobian() * last.topRows(n_);
    a.block(row + final_count(), last_point, n_, 2 * n_) =
        last.bottomRows(n_) - final_.covector_slope() * last.topRows(n_);
    a.block(row + final_count(), first_multiplier + initial_count(), n_, final_count()) =
        -final_.jacobian().transpose();
    if (settings_->conditions) {
      a.block(unknowns(), n_, conditions(), n_) = settings_->conditions->directions.transpose();
    }
    return a;
  }

  /// The solution: all arcs joined, and the multipliers in `s`.
  ShootingSolution solution(const Eigen::VectorXd& s) const {
    Arc whole;
    for (const Arc& arc : arcs_) {
      whole.points.insert(whole.points.end(), arc.points.begin(), arc.points.end() - 1);
      whole.controls.insert(whole.controls.end(), arc.controls.begin(), arc.controls.end());
      whole.jacobians.insert(whole.jacobians.end(), arc.jacobians.begin(), arc.jacobians.end());
    }
    whole.points.push_back(arcs_.back().points.back());
    ShootingSolution result;
    result.trajectory = trajectory_of(whole);
    result.trajectory.initial_multipliers = s.segment(2 * n_ * intervals_, initial_count());
    result.trajectory.final_multipliers = s.tail(final_count());
    result.jacobians = std::move(whole.jacobians);
    return result;
  }

 private:
  Eigen::Index initial_count() const { return static_cast<Eigen::Index>(initial_.count()); }
  Eigen::Index final_count() const { return static_cast<Eigen::Index>(final_.count()); }
  std::size_t first_step(Eigen::Index interval) const {
    return static_cast<std::size_t>(interval) * settings_->steps / settings_->intervals;
  }
  static std::span<const double> span(const Eigen::VectorXd& v) {
    return {v.data(), static_cast<std::size_t>(v.size())};
  }
  const Eigen::VectorXd& end_of(Eigen::Index j) const {
    return arcs_[static_cast<std::size_t>(j)].points.back();
  }
  const Eigen::MatrixXd& slope_of(Eigen::Index j) const {
    return arcs_[static_cast<std::size_t>(j)].jacobian;
  }

  /// The typical size of an end condition is the size that it has for typical states at the guess.
  /// The size of its multiplier is such that the product of both equals that of a state and its
  /// costate.
  void set_scale(std::span<const double> first, std::span<const double> last) {
    const auto given = [&](const Eigen::VectorXd& sizes) {
      return sizes.size() > 0 ? sizes : Eigen::VectorXd::Ones(n_).eval();
    };
    const Eigen::VectorXd x = given(settings_->typical_state);
    const Eigen::VectorXd p = given(settings_->typical_costate);
    const auto condition_sizes = [&](EndConditions& end, std::span<const double> place) {
      end.evaluate(place, std::vector<double>(end.count(), 0));
      return (end.jacobian().cwiseAbs() * x)
          .unaryExpr([](double size) { return size > 0 ? size : 1; })
          .eval();
    };
    const Eigen::VectorXd phi_0 = condition_sizes(initial_, first);
    const Eigen::VectorXd phi_n = condition_sizes(final_, last);
    scale_.columns.resize(unknowns());
    scale_.rows.resize(unknowns() + conditions());
    Eigen::VectorXd point(2 * n_);
    point << x, p;
    const double product = x(0) * p(0);
    scale_.columns << point.replicate(intervals_, 1), product * phi_0.cwiseInverse(),
        product * phi_n.cwiseInverse();
    const Eigen::VectorXd sizes =
        settings_->conditions
            ? (settings_->conditions->directions.cwiseAbs().transpose() * p).eval()
            : Eigen::VectorXd();
    scale_.rows << phi_0, p, point.replicate(intervals_ - 1, 1), phi_n, p, sizes;
    scale_.rows = scale_.rows.cwiseInverse().eval();
  }

  void evaluate(const Eigen::VectorXd& s) {
    for (Eigen::Index j = 0; j < intervals_; ++j) {
      Arc& arc = arcs_[static_cast<std::size_t>(j)];
      const Eigen::VectorXd control_guess = arc.controls.front();
      arc = propagate_arc(*map_, s.segment(2 * n_ * j, 2 * n_), control_guess,
                          first_step(j + 1) - first_step(j));
    }
    const Eigen::VectorXd first = s.head(n_);
    const Eigen::VectorXd last = end_of(intervals_ - 1).head(n_);
    const Eigen::VectorXd lambda_0 = s.segment(2 * n_ * intervals_, initial_count());
    const Eigen::VectorXd lambda_n = s.tail(final_count());
    initial_.evaluate(span(first), span(lambda_0));
    final_.evaluate(span(last), span(lambda_n));
  }

  AdvanceMap* map_;
  const ShootingSettings* settings_;
  EndConditions initial_;
  EndConditions final_;
  Eigen::Index n_;
  Eigen::Index intervals_;
  std::vector<Arc> arcs_;
  Equilibration scale_;
};

}  // namespace

ShootingSolution solve_by_shooting(AdvanceMap& map, const OptimalControlProblem& problem,
                                   const ShootingSettings& settings) {
  check(map, problem, settings);
  ShootingEquations equations(map, problem, settings);
  Eigen::VectorXd s = equations.start();
  const NewtonOutcome outcome = damped_newton(
      s, "shooting", settings.newton,
      [&](const Eigen::VectorXd& place) { return equations.residual(place); },
      [&](const Eigen::VectorXd& place) {
        // After a step that was tried and refused, the equations were last evaluated elsewhere.
        const Eigen::VectorXd r = equations.residual(place);
        const Eigen::MatrixXd matrix = equations.matrix();
        const Equilibration& scale = equations.scale();
        Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
        decomposition.setThreshold(settings.newton.rank_threshold);
        // Of values, not expressions, each of which would be compiled anew.
        const Eigen::MatrixXd scaled =
            scale.rows.asDiagonal() * matrix * scale.columns.asDiagonal();
        const Eigen::VectorXd residual = scale.rows.cwiseProduct(r);
        decomposition.compute(scaled);
        const Eigen::VectorXd change = decomposition.solve(residual);
        return NewtonStep{-scale.columns.cwiseProduct(change), decomposition.rank(), scale};
      });
  // Newton's tolerance is relative to the unknowns, which may have grown without bound; the
  // equations must therefore also hold relative to the typical sizes.
  const double violation =
      equations.scale().rows.cwiseProduct(equations.residual(s)).lpNorm<Eigen::Infinity>();
  if (!(violation <= largest_violation)) {
    throw Error(
        ErrorKind::numerical,
        fmt::format("shooting: the iteration ended after {} steps at unknowns of {:.3g} times "
                    "their typical sizes, where the equations are missed by {:.3g} typical "
                    "sizes; a start nearer to the solution, or other scales, may do",
                    outcome.iterations,
                    s.cwiseQuotient(equations.scale().columns).lpNorm<Eigen::Infinity>(),
                    violation));
  }
  ShootingSolution solution = equations.solution(s);
  solution.iterations = outcome.iterations;
  solution.residual = outcome.residual;
  solution.unknowns = equations.unknowns();
  const auto n = static_cast<Eigen::Index>(problem.states);
  const Eigen::MatrixXd matrix = equations.matrix().topRows(solution.unknowns);
  const Equilibration& scale = equations.scale();
  const auto singular = decompose_by_singular_values(
      scale.rows.head(solution.unknowns).asDiagonal() * matrix * scale.columns.asDiagonal());
  solution.rank =
      (singular.values.array() > settings.newton.rank_threshold * singular.values(0)).count();
  const Eigen::MatrixXd null_space =
      scale.columns.asDiagonal() * singular.right.rightCols(solution.unknowns - solution.rank);
  const Eigen::MatrixXd family = null_space.middleRows(n, n);
  if (family.cols() == 0) return solution;
  const auto directions = decompose_by_singular_values(family);
  solution.family = directions.left.leftCols(
      (directions.values.array() > settings.newton.rank_threshold * null_space.norm()).count());
  return solution;
}

}  // namespace hamjet
