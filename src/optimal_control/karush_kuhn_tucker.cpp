#include "karush_kuhn_tucker.hpp"

#include <Eigen/Sparse>
#include <Eigen/SparseLU>

#include "damped_newton.hpp"
#include "end_conditions.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"

namespace hamjet {
namespace {

/// The contribution of one step to the augmented cost, as a function of (x_k, u_k, mu_k, x_(k+1)).
OperationList step_cost(const OptimalControlProblem& problem, Discretization discretization,
                        double step) {
  const std::size_t n = problem.states;
  const std::size_t m = problem.controls;
  return record(3 * n + m, [&](std::span<const Expression> w) {
    const auto x = w.subspan(0, n);
    const auto u = w.subspan(n, m);
    const auto mu = w.subspan(n + m, n);
    const auto next = w.subspan(2 * n + m, n);
    std::vector<Expression> place;
    for (std::size_t i = 0; i < n; ++i) {
      place.push_back(x[i] + state_weight(discretization) * (next[i] - x[i]));
    }
    place.insert(place.end(), u.begin(), u.end());
    Expression sum = step * recorded_outputs(problem.running_cost, place)[0];
    const std::vector<Expression> f = recorded_outputs(problem.dynamics, place);
    for (std::size_t i = 0; i < n; ++i) sum -= mu[i] * (next[i] - x[i] - step * f[i]);
    return std::vector<Expression>{sum};
  });
}

std::span<const double> span(const Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

/// Gradient and Hessian of the augmented cost. The unknowns are lambda_0, then (x_k, u_k, mu_k) of
/// each step, then x_N and lambda_n, so that the unknowns of one step stand together.
class AugmentedCost {
 public:
  AugmentedCost(const OptimalControlProblem& problem, Discretization discretization, double step,
                std::size_t steps, const std::optional<CostateConditions>& conditions)
      : slope_(gradient(step_cost(problem, discretization, step))),
        initial_(problem.initial_conditions),
        final_(problem.final_conditions),
        conditions_(&conditions),
        discretization_(discretization),
        n_(static_cast<Eigen::Index>(problem.states)),
        m_(static_cast<Eigen::Index>(problem.controls)),
        steps_(static_cast<Eigen::Index>(steps)) {}

  /// All unknowns; the last ones are the multipliers of the conditions, which are zero at a
  /// solution.
  Eigen::Index unknowns() const { return unconditioned() + conditions(); }
  Eigen::Index conditions() const { return *conditions_ ? (*conditions_)->values.size() : 0; }

  Eigen::VectorXd start(const DiscreteTrajectory& guess) {
    Eigen::VectorXd s = Eigen::VectorXd::Zero(unknowns());
    s.head(initial_count()) =
        initial_.nearest_multipliers(span(guess.states.front()), -guess.costates.front());
    const double weight = costate_weight(discretization_);
    if (*conditions_) border_ = initial_.jacobian() * (*conditions_)->directions;
    for (Eigen::Index k = 0; k < steps_; ++k) {
      const auto i = static_cast<std::size_t>(k);
      s.segment(place(k), stride()) << guess.states[i], guess.controls[i],
          guess.costates[i] + weight * (guess.costates[i + 1] - guess.costates[i]);
    }
    s.segment(place(steps_), n_) = guess.states.back();
    s.segment(place(steps_) + n_, final_count()) =
        final_.nearest_multipliers(span(guess.states.back()), guess.costates.back());
    return s;
  }

  /// The gradient, followed by the conditions on p_0 = -D phi_0^T lambda_0; if it is wanted, also
  /// the Hessian with the rows and columns of these conditions.
  Eigen::VectorXd gradient_at(const Eigen::VectorXd& s,
                              std::vector<Eigen::Triplet<double>>* hessian) {
    Eigen::VectorXd r = Eigen::VectorXd::Zero(unknowns());
    add_end(s, initial_, place(0), 0, r, hessian);
    add_end(s, final_, place(steps_), place(steps_) + n_, r, hessian);
    const Eigen::Index size = stride() + n_;
    for (Eigen::Index k = 0; k < steps_; ++k) {
      const Eigen::VectorXd arguments = s.segment(place(k), size);
      slope_.evaluate(span(arguments));
      for (Eigen::Index i = 0; i < size; ++i) {
        r(place(k) + i) += slope_.value(i);
        for (Eigen::Index j = 0; hessian != nullptr && j < size; ++j) {
          const double second = slope_.derivative(i, j);
          if (second != 0) hessian->emplace_back(place(k) + i, place(k) + j, second);
        }
      }
    }
    if (*conditions_) add_conditions(s, r, hessian);
    return r;
  }

  DiscreteTrajectory trajectory(const Eigen::VectorXd& s) {
    DiscreteTrajectory result;
    result.initial_multipliers = s.head(initial_count());
    result.final_multipliers = s.segment(place(steps_) + n_, final_count());
    const Eigen::VectorXd first = s.segment(place(0), n_);
    initial_.evaluate(span(first), span(result.initial_multipliers));
    result.costates.emplace_back(-initial_.covector());
    for (Eigen::Index k = 0; k < steps_; ++k) {
      result.states.emplace_back(s.segment(place(k), n_));
      result.controls.emplace_back(s.segment(place(k) + n_, m_));
      const Eigen::VectorXd before = result.costates.back();
      result.costates.emplace_back(before + (s.segment(place(k) + n_ + m_, n_) - before) /
                                                costate_weight(discretization_));
    }
    result.states.emplace_back(s.segment(place(steps_), n_));
    return result;
  }

 private:
  Eigen::Index initial_count() const { return static_cast<Eigen::Index>(initial_.count()); }
  Eigen::Index final_count() const { return static_cast<Eigen::Index>(final_.count()); }
  Eigen::Index unconditioned() const { return place(steps_) + n_ + final_count(); }
  Eigen::Index stride() const { return 2 * n_ + m_; }
  Eigen::Index place(Eigen::Index k) const { return initial_count() + k * stride(); }

  /// Adds <lambda, phi(x)>, where x and lambda are at these places of s.
  void add_end(const Eigen::VectorXd& s, EndConditions& end, Eigen::Index x, Eigen::Index lambda,
               Eigen::VectorXd& r, std::vector<Eigen::Triplet<double>>* hessian) const {
    const auto count = static_cast<Eigen::Index>(end.count());
    const Eigen::VectorXd state = s.segment(x, n_);
    const Eigen::VectorXd multipliers = s.segment(lambda, count);
    end.evaluate(span(state), span(multipliers));
    r.segment(lambda, count) += end.conditions();
    r.segment(x, n_) += end.covector();
    if (hessian == nullptr) return;
    const Eigen::MatrixXd jacobian = end.jacobian();
    const Eigen::MatrixXd slope = end.covector_slope();
    for (Eigen::Index i = 0; i < n_; ++i) {
      for (Eigen::Index j = 0; j < n_; ++j) hessian->emplace_back(x + i, x + j, slope(i, j));
      for (Eigen::Index j = 0; j < count; ++j) {
        hessian->emplace_back(x + i, lambda + j, jacobian(j, i));
        hessian->emplace_back(lambda + j, x + i, jacobian(j, i));
      }
    }
  }

  /// Adds the conditions <direction, -D phi_0^T lambda_0> - value = 0. For each condition a further
  /// multiplier, which enters the equations of phi_0, makes the system square.
  void add_conditions(const Eigen::VectorXd& s, Eigen::VectorXd& r,
                      std::vector<Eigen::Triplet<double>>* derivatives) {
    const CostateConditions& given = **conditions_;
    const Eigen::VectorXd first = s.segment(place(0), n_);
    const Eigen::VectorXd multipliers = s.head(initial_count());
    initial_.evaluate(span(first), span(multipliers));
    r.tail(conditions()) = -given.directions.transpose() * initial_.covector() - given.values;
    const Eigen::MatrixXd by_state = -given.directions.transpose() * initial_.covector_slope();
    const Eigen::MatrixXd by_multiplier =
        -given.directions.transpose() * initial_.jacobian().transpose();
    r.head(initial_count()) += border_ * s.tail(conditions());
    if (derivatives == nullptr) return;
    for (Eigen::Index i = 0; i < conditions(); ++i) {
      for (Eigen::Index j = 0; j < n_; ++j) {
        derivatives->emplace_back(unconditioned() + i, place(0) + j, by_state(i, j));
      }
      for (Eigen::Index j = 0; j < initial_count(); ++j) {
        derivatives->emplace_back(unconditioned() + i, j, by_multiplier(i, j));
        derivatives->emplace_back(j, unconditioned() + i, border_(j, i));
      }
    }
  }

  DifferentiableFunction<double> slope_;  ///< gradient of step_cost
  EndConditions initial_;
  EndConditions final_;
  const std::optional<CostateConditions>* conditions_;
  Eigen::MatrixXd border_;  ///< initial conditions x costate conditions; set by start()
  Discretization discretization_;
  Eigen::Index n_;
  Eigen::Index m_;
  Eigen::Index steps_;
};

NewtonStep sparse_step(AugmentedCost& cost, const Eigen::VectorXd& s) {
  std::vector<Eigen::Triplet<double>> entries;
  const Eigen::VectorXd r = cost.gradient_at(s, &entries);
  Eigen::SparseMatrix<double> matrix(r.size(), s.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Equilibration scale = equilibrate(matrix);
  matrix = scale.rows.asDiagonal() * matrix * scale.columns.asDiagonal();
  matrix.makeCompressed();
  Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> decomposition(matrix);
  if (decomposition.info() != Eigen::Success) {
    throw Error(ErrorKind::numerical,
                fmt::format("discretise then optimise: the {} equations are singular; if their "
                            "solutions form a family, conditions on the initial costate pick one",
                            s.size()));
  }
  const Eigen::VectorXd change = decomposition.solve(scale.rows.cwiseProduct(r));
  return {-scale.columns.cwiseProduct(change), s.size(), scale};
}

}  // namespace

KarushKuhnTuckerSolution solve_karush_kuhn_tucker(
    const OptimalControlProblem& problem, Discretization discretization, double step,
    const DiscreteTrajectory& guess, const NewtonSettings& settings,
    const std::optional<CostateConditions>& conditions) {
  const std::size_t steps = guess.steps();
  if (steps == 0 || guess.states.size() != steps + 1 || guess.costates.size() != steps + 1) {
    throw Error(ErrorKind::usage,
                "discretise then optimise: the guess must hold N + 1 states and costates and N "
                "controls, N >= 1");
  }
  AugmentedCost cost(problem, discretization, step, steps, conditions);
  Eigen::VectorXd s = cost.start(guess);
  const NewtonOutcome outcome = damped_newton(
      s, "discretise then optimise", settings,
      [&](const Eigen::VectorXd& place) { return cost.gradient_at(place, nullptr); },
      [&](const Eigen::VectorXd& place) { return sparse_step(cost, place); });
  return {cost.trajectory(s), outcome.iterations, outcome.residual};
}

}  // namespace hamjet
