#include "rounding_sample.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "../../dynamics/autonomy.hpp"
#include "../descriptions/method_description.hpp"
#include "../integration.hpp"
#include "../thinned_list.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/dynamics/relative_hamiltonian.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Half the distance from 1 to the next number.
template <class Real>
double half_ulp() {
  return std::ldexp(1.0, -std::numeric_limits<Real>::digits);
}

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

VectorXd state_vector(const std::vector<double>& numbers) {
  return Eigen::Map<const VectorXd>(numbers.data(), index(numbers.size()));
}

/// The state of a run after some number of steps.
struct RunPoint {
  double time = 0;
  long steps = 0;
  VectorXd state;
  MatrixXd matrix;  ///< first derivatives, with a column for each variable
};

template <class Real>
std::vector<RunPoint> points_of_run(const Scene& scene, const ComputedProblem& problem) {
  const auto point_at = [&](double time, long steps, const FlowJet<Real>& jet) {
    RunPoint point{time, steps, VectorXd(index(jet.size())),
                   MatrixXd(index(jet.size()), index(problem.variables.size()))};
    for (std::size_t i = 0; i < jet.size(); ++i) {
      point.state(index(i)) = static_cast<double>(jet[i][0]);
      for (std::size_t l = 0; l < problem.variables.size(); ++l) {
        point.matrix(index(i), index(l)) =
            static_cast<double>(jet[i][problem.space->linear_index(l)]);
      }
    }
    return point;
  };
  const FlowProblem<Real> flow = flow_problem<Real>(problem, scene.duration);
  ThinnedList<RunPoint, 80001> points;
  points.add(point_at(0, 0, starting_jet(flow)));
  long steps = 0;
  IntegrationStatistics statistics;
  integrate<Real>(flow, scene.integrators.front(), statistics,
                  [&](const Real& time, const FlowJet<Real>& jet) {
                    points.add(point_at(static_cast<double>(time), ++steps, jet));
                  });
  return points.take();
}

/// One or several steps, as a map of all components to second order.
struct StepMap {
  MatrixXd linear;
  std::vector<MatrixXd> second;  ///< second derivatives of each component
};

/// The vector field at one point.
struct FieldValue {
  VectorXd slope;
  MatrixXd gradient;
};

/// The settings of a single step: the method with steps of one length; or Gauss with a tolerance,
/// instead of CVODE, whose steps depend on earlier steps, and instead of very many steps.
IntegratorSettings settings_of_step(IntegratorSettings settings, const RunPoint& from,
                                    const RunPoint& to) {
  if (description_of(settings.method).is_multistep || to.steps - from.steps > 1) {
    settings = IntegratorSettings{};
    settings.tolerance = 1e-12;
    return settings;
  }
  settings.tolerance.reset();
  settings.step_canonical = std::abs(to.time - from.time);
  return settings;
}

/// Whether a map ends where the run does. The implicit equations of a step that is far too long
/// have several solutions, and which one is found depends on earlier steps.
bool meets(const VectorXd& end, const RunPoint& from, const RunPoint& to) {
  const Eigen::Index n = end.size() / 2;
  const auto is_near = [](const auto& a, const auto& b, const auto& other) {
    const double size = std::max(b.cwiseAbs().maxCoeff(), other.cwiseAbs().maxCoeff());
    return (a - b).cwiseAbs().maxCoeff() <= 1e-3 * size;
  };
  return is_near(end.head(n), to.state.head(n), from.state.head(n)) &&
         is_near(end.tail(n), to.state.tail(n), from.state.tail(n));
}

/// Jets of a system in all its components.
class LocalJets {
 public:
  LocalJets(const SharedSystem& system, const ClockTime& start_time)
      : system_(system),
        start_time_(start_time),
        space_(SeriesSpace::create(system->dimension(), 2)),
        linear_space_(SeriesSpace::create(system->dimension(), 1)),
        variables_(system->dimension()) {
    std::iota(variables_.begin(), variables_.end(), std::size_t{0});
  }

  /// The map of a step to second order, or to first order if the run's own step must be derived
  /// from its matrices; no value if neither is possible.
  std::optional<StepMap> step_map(const IntegratorSettings& settings, const RunPoint& from,
                                  const RunPoint& to, const ComputedProblem& problem) const {
    IntegrationStatistics statistics;
    const auto jet =
        integrate<double>(problem_at(from.state, from.time, space_, to.time - from.time),
                          settings_of_step(settings, from, to), statistics, {});
    StepMap map;
    VectorXd end(index(jet.size()));
    for (std::size_t i = 0; i < jet.size(); ++i) {
      end(index(i)) = jet[i][0];
      map.second.push_back(second_derivatives(jet[i]));
    }
    map.linear = linear_part(jet);
    if (meets(end, from, to)) return map;
    if (!problem.is_full_jet) return std::nullopt;
    map.linear = to.matrix * from.matrix.inverse();
    for (MatrixXd& component : map.second) component.setZero();
    return map;
  }

  FieldValue field(const VectorXd& point, double time) const {
    const auto identity = starting_jet(problem_at(point, time, linear_space_, 0));
    const auto jet =
        evaluate_on_series<double>(frozen_at(system_->vector_field, start_time_ + time), identity);
    FieldValue value{VectorXd(index(jet.size())), linear_part(jet)};
    for (std::size_t i = 0; i < jet.size(); ++i) value.slope(index(i)) = jet[i][0];
    return value;
  }

 private:
  /// The times are since the run's start.
  FlowProblem<double> problem_at(const VectorXd& point, double time, const SpacePointer& space,
                                 double duration) const {
    FlowProblem<double> problem{system_, space, variables_, {}, start_time_ + time, duration};
    problem.initial_state.assign(point.begin(), point.end());
    return problem;
  }

  MatrixXd second_derivatives(const Series<double>& series) const {
    MatrixXd result = MatrixXd::Zero(index(variables_.size()), index(variables_.size()));
    for (std::size_t k = space_->first(2); k < space_->size(); ++k) {
      const auto exponents = space_->exponents(k);
      const auto first = std::find_if(exponents.begin(), exponents.end(), [](int e) { return e; });
      const auto i = std::distance(exponents.begin(), first);
      if (*first == 2) {
        result(i, i) = 2 * series[k];
        continue;
      }
      const auto second = std::find_if(first + 1, exponents.end(), [](int e) { return e; });
      const auto j = std::distance(exponents.begin(), second);
      result(i, j) = result(j, i) = series[k];
    }
    return result;
  }

  SharedSystem system_;
  ClockTime start_time_;
  SpacePointer space_;
  SpacePointer linear_space_;
  std::vector<std::size_t> variables_;
};

/// The sizes to which rounding is relative: the magnitudes, or for denormal numbers the distance
/// between two of them.
template <class Magnitudes>
auto rounding_of(const Magnitudes& magnitudes, double unit) {
  return magnitudes
      .unaryExpr([unit](double x) {
        return x == 0 ? 0 : unit * x + std::numeric_limits<double>::denorm_min();
      })
      .eval();
}

}  // namespace

/// One member of the sample: its deviation from the run so far.
class RoundingSample::Deviations {
 public:
  Deviations(VectorXd state, Eigen::Index columns, std::mt19937_64& generator)
      : generator_(generator),
        state_(std::move(state)),
        matrix_(MatrixXd::Zero(state_.size(), columns)),
        coefficients_(random(VectorXd::Ones(state_.size()).eval())) {}

  const VectorXd& state() const { return state_; }
  const MatrixXd& matrix() const { return matrix_; }

  /// Adds a random part, uniform between plus and minus these sizes.
  void disturb(const VectorXd& state, const MatrixXd& matrix) {
    state_ += random(state);
    matrix_ += random(matrix);
  }

  /// A step from M to `next`, which adds `change` to the state.
  void advance(const StepMap& map, const MatrixXd& matrix, const MatrixXd& next,
               const VectorXd& change, double unit) {
    MatrixXd bent(state_.size(), state_.size());  // change of the step's matrix by the deviation
    for (Eigen::Index i = 0; i < state_.size(); ++i) {
      bent.row(i) = (map.second[static_cast<std::size_t>(i)] * state_).transpose();
    }
    const auto rounded = (unit * coefficients_).asDiagonal();
    matrix_ = (map.linear + bent) * matrix_ + bent * matrix + rounded * (next - matrix);
    state_ = map.linear * state_ + bent * state_ / 2 + rounded * change;
  }

 private:
  template <class Sizes>
  Sizes random(const Sizes& sizes) {
    return sizes.unaryExpr([this](double size) {
      const auto bits = static_cast<double>(static_cast<std::int64_t>(generator_()) >> 11);
      return size * (bits * 0x1p-52);
    });
  }

  std::mt19937_64& generator_;
  VectorXd state_;
  MatrixXd matrix_;
  VectorXd coefficients_;
};

template <class Real>
void RoundingSample::follow_as(const Scene& scene, const ComputedProblem& problem,
                               const std::function<void(double)>& progress) {
  const double unit = half_ulp<Real>();
  const std::size_t dimension = scene.nominal.size();
  const Eigen::Index components = index(problem.components.size());
  const Eigen::Index columns = index(problem.variables.size());
  const std::vector<RunPoint> points = points_of_run<Real>(scene, problem);
  floor_ = {std::vector<double>(dimension, 0), std::vector<double>(dimension * dimension, 0)};
  if (points.size() < 2) return;

  const bool is_start = states_.empty();
  std::vector<Deviations> members;
  for (std::size_t k = 0; k < size; ++k) {
    const VectorXd state = is_start ? VectorXd::Zero(components).eval() : state_vector(states_[k]);
    members.emplace_back(state, columns, generator_);
    members.back().disturb(
        is_start ? rounding_of(points.front().state.cwiseAbs(), unit) : VectorXd::Zero(components),
        rounding_of(points.front().matrix, unit));
  }

  const LocalJets jets(problem.system, problem.start_time);
  const MatrixXd identity = MatrixXd::Identity(components, components);
  for (std::size_t step = 0; step + 1 < points.size(); ++step) {
    const RunPoint& from = points[step];
    const RunPoint& to = points[step + 1];
    const double h = to.time - from.time;
    const auto map = jets.step_map(scene.integrators.front(), from, to, problem);
    if (!map) {
      throw Error(ErrorKind::numerical,
                  "what rounding does to steps as long as these is known only if the scene expands "
                  "in all variables");
    }
    const FieldValue field = jets.field(from.state, from.time);
    const MatrixXd moved = (map->linear - identity).cwiseAbs();
    const MatrixXd& matrix = from.matrix;
    // The roundings of a group's steps are independent, so that their squares add up.
    const double unit_of_group = unit * std::sqrt(static_cast<double>(to.steps - from.steps));
    const VectorXd state_rounding =
        rounding_of(from.state.cwiseAbs() + moved * from.state.cwiseAbs() +
                        std::abs(h) * field.slope.cwiseAbs(),
                    unit_of_group);
    const MatrixXd matrix_rounding = rounding_of(
        matrix.cwiseAbs() + (moved + std::abs(h) * field.gradient.cwiseAbs()) * matrix.cwiseAbs(),
        unit_of_group);
    for (Deviations& member : members) {
      member.advance(*map, matrix, to.matrix, to.state - from.state, unit);
      member.disturb(state_rounding, matrix_rounding);
    }
    if (progress) progress(to.time / scene.duration);
  }

  const FieldValue end = jets.field(points.back().state, points.back().time);
  const VectorXd late = rounding_of(std::abs(scene.duration) * end.slope.cwiseAbs(), unit);
  const MatrixXd late_matrix = rounding_of(
      std::abs(scene.duration) * (end.gradient * points.back().matrix).cwiseAbs(), unit);
  states_.clear();
  for (Deviations& member : members) {
    member.disturb(late, late_matrix);
    if (!member.state().allFinite() || !member.matrix().allFinite()) {
      throw Error(ErrorKind::numerical,
                  "rounding grows beyond all numbers: no floor can be stated");
    }
    states_.emplace_back(member.state().begin(), member.state().end());
    for (std::size_t i = 0; i < problem.components.size(); ++i) {
      double& state = floor_.state[problem.components[i]];
      state = std::max(state, std::abs(member.state()(index(i))));
      for (std::size_t l = 0; l < problem.variables.size(); ++l) {
        double& entry = floor_.matrix[problem.components[i] * dimension + scene.variables[l]];
        entry = std::max(entry, std::abs(member.matrix()(index(i), index(l))));
      }
    }
  }
}

void RoundingSample::follow(const Scene& scene, const ComputedProblem& problem,
                            const std::function<void(double)>& progress) {
  if (scene.precision == Precision::extended) {
    follow_as<Extended>(scene, problem, progress);
  } else {
    follow_as<double>(scene, problem, progress);
  }
}

}  // namespace hamjet
