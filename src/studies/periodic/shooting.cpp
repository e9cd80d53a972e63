#include "shooting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../../algebra/singular_values.hpp"
#include "../exact_flow.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/dynamics/relative_hamiltonian.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// Singular values below this part of the largest are 0: of orbits in families of more dimensions,
/// the nearest is found.
constexpr double least_singular_value = 1e-11;

/// Of a difference by the parameter, whose error is the square of it.
constexpr double parameter_part = 1e-5;

std::vector<double> numbers_of(const Vector<double>& state) { return {state.begin(), state.end()}; }

Vector<double> vector_of(const std::vector<double>& state) {
  return Eigen::Map<const Vector<double>>(state.data(), static_cast<Eigen::Index>(state.size()));
}

Vector<double> flown(const PeriodicProblem& problem, const SharedSystem& system,
                     const Vector<double>& start, double time) {
  IntegrationStatistics statistics;
  return vector_of(nominal_of(
      integrate_gauss(trajectory_problem(system, numbers_of(start), ClockTime::epoch(), time),
                      problem.gauss, statistics)));
}

Vector<double> least_solution(const Matrix<double>& rows, const Vector<double>& right) {
  const SingularValueDecomposition d = decompose_by_singular_values(rows);
  Vector<double> along = d.left.transpose() * right;
  Vector<double> result = Vector<double>::Zero(rows.cols());
  for (Eigen::Index i = 0; i < d.values.size(); ++i) {
    if (d.values[i] <= least_singular_value * d.values[0]) break;
    result += along[i] / d.values[i] * d.right.col(i);
  }
  return result;
}

double parameter_step(double parameter) {
  return parameter_part * (parameter != 0 ? std::abs(parameter) : 1);
}

}  // namespace

Vector<double> EnergyGradient::field() const { return symplectic_unit_times(gradient); }

EnergyGradient energy_gradient(const DynamicalSystem& system, const Vector<double>& state) {
  const SpacePointer space = SeriesSpace::create(system.dimension(), 1);
  std::vector<Series<double>> z;
  for (Eigen::Index i = 0; i < state.size(); ++i) {
    z.push_back(Series<double>::variable(space, static_cast<std::size_t>(i), state[i]));
  }
  const Series<double> value = evaluate_on_series(system.hamiltonian, z)[0];
  EnergyGradient result{value[0], Vector<double>(state.size())};
  for (Eigen::Index i = 0; i < state.size(); ++i) {
    result.gradient[i] = value[space->linear_index(static_cast<std::size_t>(i))];
  }
  return result;
}

OrbitNodes flown_nodes(const PeriodicProblem& problem, const Vector<double>& start, double period,
                       double parameter) {
  const SharedSystem system = problem.system(parameter);
  OrbitNodes nodes{{start}, period, parameter};
  while (nodes.states.size() < problem.arcs) {
    nodes.states.push_back(
        flown(problem, system, nodes.states.back(), period / static_cast<double>(problem.arcs)));
  }
  return nodes;
}

double quantity_of(const PeriodicProblem& problem, const OrbitQuantity& quantity,
                   const OrbitNodes& nodes) {
  switch (quantity.kind) {
    case OrbitQuantity::Kind::energy:
      return energy_gradient(*problem.system(nodes.parameter), nodes.states.front()).energy;
    case OrbitQuantity::Kind::period:
      return nodes.period;
    case OrbitQuantity::Kind::variable:
      return nodes.states.front()[static_cast<Eigen::Index>(quantity.variable)];
    case OrbitQuantity::Kind::parameter:
      break;
  }
  return nodes.parameter;
}

Shooting::Shooting(const PeriodicProblem& problem, const OrbitNodes& near) : problem_(&problem) {
  const Eigen::Index n = near.states.front().size() / 2;
  space_ = SeriesSpace::create(static_cast<std::size_t>(2 * n), 1);
  scale_.resize(2 * n + (problem.has_parameter ? 2 : 1));
  // Where arcs begin, all momenta may be 0, as after each half of a swing: sizes are those on the
  // way.
  double position = 0;
  double momentum = 0;
  constexpr long most = 20;
  constexpr long least = 200;
  const SharedSystem system = problem.system(near.parameter);
  for (const Vector<double>& start : near.states) {
    IntegrationStatistics statistics;
    integrate_gauss<double>(
        trajectory_problem(system, numbers_of(start), ClockTime::epoch(),
                           near.period / static_cast<double>(near.states.size())),
        problem.gauss, statistics, [&](const double&, const FlowJet<double>& jet) {
          const Vector<double> state = vector_of(nominal_of(jet));
          position = std::max(position, state.head(n).norm());
          momentum = std::max(momentum, state.tail(n).norm());
        });
    most_steps_ = std::max(most_steps_, least + most * statistics.steps);
  }
  scale_.head(n).setConstant(position > 0 ? position : 1);
  scale_.segment(n, n).setConstant(momentum > 0 ? momentum : 1);
  scale_[2 * n] = std::abs(near.period);
  if (problem.has_parameter) scale_[2 * n + 1] = near.parameter != 0 ? std::abs(near.parameter) : 1;
  set_phase(near);
}

void Shooting::require_few_steps(const SharedSystem& system, const Vector<double>& start,
                                 double time) const {
  long steps = 0;
  IntegrationStatistics statistics;
  integrate_gauss<double>(
      trajectory_problem(system, numbers_of(start), ClockTime::epoch(), time), problem_->gauss,
      statistics, [&](const double& at, const FlowJet<double>&) {
        if (++steps <= most_steps_) return;
        throw Error(ErrorKind::numerical, fmt::format("periodic: an arc takes more than {} steps "
                                                      "until {:.6g}",
                                                      most_steps_, at));
      });
}

void Shooting::set_phase(const OrbitNodes& nodes) {
  phase_state_ = nodes.states.front();
  const Eigen::Index dimension = phase_state_.size();
  phase_direction_ =
      energy_gradient(*problem_->system(nodes.parameter), phase_state_).field().array() /
      scale_.head(dimension).array();
  const double size = phase_direction_.norm();
  if (!(size * std::abs(nodes.period) > 1e-8)) {
    throw Error(ErrorKind::numerical,
                "periodic: the start is an equilibrium, which has no period; must be another one");
  }
  phase_direction_ /= size;
}

LinearShooting Shooting::linearize(const OrbitNodes& nodes) const {
  const SharedSystem system = problem_->system(nodes.parameter);
  const std::size_t arcs = nodes.states.size();
  const Eigen::Index dimension = nodes.states.front().size();
  const double time = nodes.period / static_cast<double>(arcs);
  const auto scale = scale_.head(dimension);
  LinearShooting result;
  Matrix<double> of_state = Matrix<double>::Zero(dimension, columns());
  of_state.leftCols(dimension).diagonal() = scale;
  Vector<double> offset = Vector<double>::Zero(dimension);
  for (std::size_t i = 0; i < arcs; ++i) {
    result.of_states.push_back(of_state);
    result.offsets.push_back(offset);
    require_few_steps(system, nodes.states[i], time);
    IntegrationStatistics statistics;
    const FlowJet<double> jet = integrate_gauss(
        linear_problem(system, space_, numbers_of(nodes.states[i]), ClockTime::epoch(), time),
        problem_->gauss, statistics);
    const Matrix<double> matrix = linear_part(jet);
    const Vector<double> end = vector_of(nominal_of(jet));
    const Vector<double> missed = end - nodes.states[(i + 1) % arcs];
    result.mismatch = std::max(
        result.mismatch, Vector<double>(missed.array() / scale.array()).cwiseAbs().maxCoeff());
    of_state = matrix * of_state;
    of_state.col(dimension) +=
        energy_gradient(*system, end).field() * (scale_[dimension] / static_cast<double>(arcs));
    if (problem_->has_parameter) {
      const double step = parameter_step(nodes.parameter);
      const auto beside = [&](double parameter) {
        return flown(*problem_, problem_->system(parameter), nodes.states[i], time);
      };
      of_state.col(dimension + 1) +=
          (beside(nodes.parameter + step) - beside(nodes.parameter - step)) *
          (scale_[dimension + 1] / (2 * step));
    }
    offset = matrix * offset + missed;
  }
  result.rows.resize(dimension + 1, columns());
  result.residuals.resize(dimension + 1);
  result.rows.topRows(dimension) = of_state - result.of_states.front();
  result.residuals.head(dimension) = offset;
  for (Eigen::Index i = 0; i < dimension; ++i) {
    result.rows.row(i) /= scale[i];
    result.residuals[i] /= scale[i];
  }
  result.rows.row(dimension).setZero();
  result.rows.row(dimension).head(dimension) = phase_direction_.transpose();
  result.residuals[dimension] = phase_direction_.dot(
      Vector<double>((nodes.states.front() - phase_state_).array() / scale.array()));
  return result;
}

OrbitNodes Shooting::moved(const OrbitNodes& nodes, const LinearShooting& linear,
                           const Vector<double>& step, double part) const {
  OrbitNodes result = nodes;
  const Eigen::Index dimension = nodes.states.front().size();
  for (std::size_t i = 0; i < nodes.states.size(); ++i) {
    result.states[i] += part * (linear.of_states[i] * step + linear.offsets[i]);
  }
  result.period += part * step[dimension] * scale_[dimension];
  if (problem_->has_parameter) {
    result.parameter += part * step[dimension + 1] * scale_[dimension + 1];
  }
  return result;
}

Vector<double> Shooting::unknowns(const OrbitNodes& nodes) const {
  Vector<double> result(columns());
  const Eigen::Index dimension = nodes.states.front().size();
  result.head(dimension) = nodes.states.front();
  result[dimension] = nodes.period;
  if (problem_->has_parameter) result[dimension + 1] = nodes.parameter;
  return result.array() / scale_.array();
}

Vector<double> Shooting::gradient(const OrbitQuantity& quantity, const OrbitNodes& nodes) const {
  const Eigen::Index dimension = nodes.states.front().size();
  Vector<double> result = Vector<double>::Zero(columns());
  switch (quantity.kind) {
    case OrbitQuantity::Kind::energy: {
      const Vector<double>& start = nodes.states.front();
      result.head(dimension) = energy_gradient(*problem_->system(nodes.parameter), start).gradient;
      if (problem_->has_parameter) {
        const double step = parameter_step(nodes.parameter);
        const auto beside = [&](double parameter) {
          return energy_gradient(*problem_->system(parameter), start).energy;
        };
        result[dimension + 1] =
            (beside(nodes.parameter + step) - beside(nodes.parameter - step)) / (2 * step);
      }
      break;
    }
    case OrbitQuantity::Kind::period:
      result[dimension] = 1;
      break;
    case OrbitQuantity::Kind::variable:
      result[static_cast<Eigen::Index>(quantity.variable)] = 1;
      break;
    case OrbitQuantity::Kind::parameter:
      result[dimension + 1] = 1;
      break;
  }
  return result.array() * scale_.array();
}

ShootingEquation Shooting::held(const OrbitQuantity& quantity, double value,
                                const OrbitNodes& nodes) const {
  Vector<double> direction = gradient(quantity, nodes);
  const double size = direction.norm();
  if (!(size > 0)) {
    throw Error(ErrorKind::numerical,
                "periodic: the search came to an equilibrium, about which no orbit turns that fits "
                "what is held");
  }
  return {direction / size, (quantity_of(*problem_, quantity, nodes) - value) / size};
}

Shooting::Solution Shooting::solve(const OrbitNodes& guess, const Equations& further,
                                   int most_iterations) const {
  Solution at{guess, linearize(guess)};
  std::vector<ShootingEquation> equations = further(at.nodes);
  const auto size_of = [](const LinearShooting& linear,
                          const std::vector<ShootingEquation>& others) {
    double square = linear.mismatch * linear.mismatch;
    for (const ShootingEquation& one : others) square += one.value * one.value;
    return std::sqrt(square);
  };
  double size = size_of(at.linear, equations);
  double previous = std::numeric_limits<double>::infinity();
  constexpr double longest_step = 0.5;
  // Below this a size is near what rounding leaves, and need not fall.
  constexpr double small = 1e-9;
  const Eigen::Index own = at.linear.rows.rows();
  while (at.iterations < most_iterations) {
    ++at.iterations;
    const auto count = static_cast<Eigen::Index>(equations.size());
    Matrix<double> rows(own + count, columns());
    Vector<double> right(own + count);
    rows.topRows(own) = at.linear.rows;
    right.head(own) = -at.linear.residuals;
    for (Eigen::Index i = 0; i < count; ++i) {
      const ShootingEquation& one = equations[static_cast<std::size_t>(i)];
      rows.row(own + i) = one.gradient.transpose();
      right[own + i] = -one.value;
    }
    const Vector<double> step = least_solution(rows, right);
    const double length = step.norm();
    double part = std::min(1.0, longest_step / length);
    const double least_part = part / 256;
    for (;; part /= 2) {
      if (part < least_part) {
        throw Error(ErrorKind::numerical,
                    fmt::format("periodic: no orbit found: after {} steps of Newton's method arcs "
                                "miss by {:.2g} of the orbit's size, and no step makes it less",
                                at.iterations, at.linear.mismatch));
      }
      OrbitNodes nodes = moved(at.nodes, at.linear, step, part);
      // A period that shrinks to nothing would close every arc.
      if (!(nodes.period / guess.period > 0.05)) continue;
      try {
        LinearShooting linear = linearize(nodes);
        std::vector<ShootingEquation> others = further(nodes);
        const double now = size_of(linear, others);
        if (!(now <= (1 - part / 4) * size) && !(now <= small)) continue;
        at.nodes = std::move(nodes);
        at.linear = std::move(linear);
        equations = std::move(others);
        size = now;
        break;
      } catch (const Error& error) {
        // A step too far may lead to where no flight is possible.
        if (error.kind() != ErrorKind::numerical) throw;
      }
    }
    // Convergence is quadratic. Steps that no longer shrink are rounding.
    const bool is_last =
        (length <= 3e-9 && size <= 1e-13) || (length <= 1e-7 && length > 0.5 * previous);
    if (size <= small && is_last) return at;
    previous = length;
  }
  throw Error(ErrorKind::numerical,
              fmt::format("periodic: no orbit found: after {} steps of Newton's method arcs miss "
                          "by {:.2g} of the orbit's size",
                          at.iterations, at.linear.mismatch));
}

PeriodicOrbit orbit_of_solution(const PeriodicProblem& problem, Shooting::Solution solution,
                                const Vector<double>& scale) {
  const SharedSystem system = problem.system(solution.nodes.parameter);
  PeriodicOrbit orbit;
  orbit.nodes = std::move(solution.nodes);
  orbit.iterations = solution.iterations;
  orbit.mismatch = solution.linear.mismatch;
  if (!(orbit.mismatch <= problem.tolerance)) {
    throw Error(ErrorKind::numerical,
                fmt::format("periodic: arcs miss by {:.2g} of the orbit's size, must be at most "
                            "{:.2g} (periodic.tolerance)",
                            orbit.mismatch, problem.tolerance));
  }
  const EnergyGradient at = energy_gradient(*system, orbit.start());
  const Eigen::Index dimension = orbit.start().size();
  const auto sizes = scale.head(dimension).array();
  orbit.energy = at.energy;
  if (!(Vector<double>(at.field().array() / sizes).norm() * std::abs(orbit.nodes.period) > 1e-6)) {
    throw Error(ErrorKind::numerical,
                "periodic: the search ended at an equilibrium, which is no orbit; must be a start "
                "nearer to the orbit");
  }
  const Vector<double> end = vector_of(
      exact_flow(system, numbers_of(orbit.start()), ClockTime::epoch(), orbit.nodes.period));
  orbit.closing = Vector<double>((end - orbit.start()).array() / sizes).cwiseAbs().maxCoeff();
  Matrix<double> turn = solution.linear.rows.topLeftCorner(dimension, dimension);
  // Of the closing's rows, in parts of the sizes, the identity was taken off.
  turn.diagonal().array() += 1;
  for (Eigen::Index i = 0; i < dimension; ++i) {
    turn.row(i) *= scale[i];
    turn.col(i) /= scale[i];
  }
  orbit.monodromy = monodromy_of(*system, orbit.start(), std::move(turn), scale.head(dimension));
  return orbit;
}

PeriodicOrbit find_periodic_orbit(const PeriodicProblem& problem, const OrbitNodes& guess) {
  constexpr int most_iterations = 50;
  constexpr int most_turns = 6;
  constexpr double same = 1e-7;
  const auto found = [&](const OrbitNodes& from) {
    const Shooting shooting(problem, from);
    return orbit_of_solution(
        problem,
        shooting.solve(
            from,
            [&](const OrbitNodes& nodes) {
              return std::vector{shooting.held(problem.held, problem.value, nodes)};
            },
            most_iterations),
        shooting.scale());
  };
  PeriodicOrbit orbit = found(guess);
  // A held period is not to be divided.
  if (problem.held.kind == OrbitQuantity::Kind::period) return orbit;
  const SharedSystem system = problem.system(orbit.nodes.parameter);
  const Shooting shooting(problem, orbit.nodes);
  for (int turns = most_turns; turns > 1; --turns) {
    const double part = orbit.nodes.period / turns;
    const Vector<double> end = flown(problem, system, orbit.start(), part);
    const Eigen::Index dimension = end.size();
    const double miss =
        Vector<double>((end - orbit.start()).array() / shooting.scale().head(dimension).array())
            .norm();
    if (miss > same) continue;
    return found(flown_nodes(problem, orbit.start(), part, orbit.nodes.parameter));
  }
  return orbit;
}

}  // namespace hamjet
