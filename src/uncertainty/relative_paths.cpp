#include "relative_paths.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "cubic_arc.hpp"
#include "encounter_trajectories.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// The cubics between nodes must be right for deviations of this many standard deviations.
constexpr double sigmas = 4;
/// More nodes would take gigabytes, and a millisecond per sample.
constexpr std::size_t most_nodes = 20000;

/// The first nodes are a sixteenth of a revolution apart: within this time no path returns to its
/// place.
constexpr double first_looks_per_period = 16;
/// The fractions of an interval at which cubics are checked; the first is where the interval would
/// be halved.
constexpr std::array<double, 3> checked_parts = {0.5, 0.21, 0.77};
/// Relative to the distance from the centre, flows with a tolerance of 1e-12 cannot be
/// distinguished below this.
constexpr double rounding_of_flow = 1e-12;

}  // namespace

Eigen::Matrix<double, 2, 3> plane_across(const LinearRelativeState& state) {
  const Eigen::Vector3d along = state.mean.tail<3>().normalized();
  Eigen::Matrix<double, 2, 3> plane;
  plane.row(0) = along.unitOrthogonal().transpose();
  plane.row(1) = along.cross(plane.row(0).transpose()).transpose();
  return plane;
}

std::array<double, 6> UncertainSpacecraft::deviated(const Eigen::Matrix<double, 6, 1>& xi) const {
  Eigen::Matrix<double, 6, 1> deviation = factor * xi;
  if (straight) deviation = (*straight)(deviation);
  std::array<double, 6> result{};
  for (std::size_t i = 0; i < 6; ++i)
    result[i] = state[i] + deviation[static_cast<Eigen::Index>(i)];
  return result;
}

void validate(const EncounterProblem& problem) {
  for (std::size_t craft = 0; craft < 2; ++craft) {
    const SharedSystem& system = problem.system_of(craft);
    if (!system || system->dimension() != 6) {
      throw Error(ErrorKind::usage, "encounter: the system must be one of an orbit");
    }
  }
  bool finite =
      std::isfinite(problem.from) && std::isfinite(problem.to) && std::isfinite(problem.radius);
  for (const UncertainSpacecraft& spacecraft : problem.spacecraft) {
    if (spacecraft.state.size() != 6) {
      throw Error(ErrorKind::usage, "encounter: a state must be six numbers");
    }
    finite = finite && spacecraft.factor.allFinite() &&
             std::all_of(spacecraft.state.begin(), spacecraft.state.end(),
                         [](double x) { return std::isfinite(x); });
  }
  if (!finite) throw Error(ErrorKind::numerical, "encounter: a number is not finite");
  if (!(problem.to > problem.from)) {
    throw Error(ErrorKind::usage, "encounter: the window must end after it begins");
  }
  if (!(problem.radius > 0)) {
    throw Error(ErrorKind::usage, "encounter: the radius must be positive");
  }
}

/// The motion at a time, as far as the choice of nodes needs it.
struct RelativePaths::Look {
  double time = 0;
  LinearRelativeState linear;
  double second_order = 0;  ///< second-order term for deviations of farthest_deviation

  /// A lower bound for how near a path seen here may come within a time.
  double nearest(double length) const {
    const double speed =
        linear.mean.tail(3).norm() + farthest_deviation * linear.by_deviation.bottomRows(3).norm();
    return linear.mean.head(3).norm() - farthest_deviation * linear.by_deviation.topRows(3).norm() -
           second_order - speed * length;
  }
  /// The error of the cubic from this look to another one, judged by a third look between them, at
  /// the fraction of the interval where a cubic errs most.
  double miss(const Look& end, const Look& between_both) const {
    const double length = end.time - time;
    const double s = (between_both.time - time) / length;
    const LinearRelativeState cubic = between(linear, end.linear, length, s);
    const LinearRelativeState& right = between_both.linear;
    const double spread = (cubic.by_deviation - right.by_deviation).topRows(3).norm();
    const double share = 16 * s * s * (1 - s) * (1 - s);
    return ((cubic.mean - right.mean).head(3).norm() + sigmas * spread) / share;
  }
};

RelativePaths::RelativePaths(const EncounterProblem& problem, double accuracy, double sphere) {
  validate(problem);
  const EncounterTrajectories trajectories(problem);
  // The choice of nodes uses low orders, which are faster.
  EncounterProblem of_low_order = problem;
  of_low_order.order = std::min(problem.order, order_of_looks);
  std::optional<EncounterTrajectories> of_its_own;
  if (of_low_order.order < problem.order) of_its_own.emplace(of_low_order);
  lay_nodes(problem, accuracy, sphere, trajectories, of_its_own ? *of_its_own : trajectories);
}

RelativePaths::RelativePaths(const EncounterProblem& problem, double accuracy, double sphere,
                             const EncounterTrajectories& trajectories,
                             const EncounterTrajectories& low) {
  validate(problem);
  lay_nodes(problem, accuracy, sphere, trajectories, low);
}

void RelativePaths::lay_nodes(const EncounterProblem& problem, double accuracy, double sphere,
                              const EncounterTrajectories& trajectories,
                              const EncounterTrajectories& low) {
  for (std::size_t i = 0; i < 2; ++i) factors_[i] = problem.spacecraft[i].factor;
  const auto look_at = [&](double time) {
    const std::array<FlowJet<double>, 2> jets = {low.jet(0, time), low.jet(1, time)};
    return Look{time, low.linear(jets), low.second_order(jets, farthest_deviation)};
  };
  std::array<std::vector<Series<double>>, 2> maps;
  const auto add_node = [&](double time) {
    std::array<FlowJet<double>, 2> jets = {trajectories.jet(0, time), trajectories.jet(1, time)};
    times_.push_back(time);
    linear_.push_back(trajectories.linear(jets));
    for (std::size_t i = 0; i < 2; ++i) {
      for (Series<double>& component : jets[i]) {
        component[0] = 0;
        maps[i].push_back(std::move(component));
      }
    }
  };
  for (const UncertainSpacecraft& craft : problem.spacecraft) {
    const Eigen::Map<const Eigen::Vector3d> position(craft.state.data());
    accuracy = std::max(accuracy, rounding_of_flow * position.norm());
  }
  const std::vector<double> first_times = low.times_of_looks(first_looks_per_period, 1);
  Look start = look_at(first_times.front());
  std::vector<Look> ahead;  // the nearest comes last
  for (std::size_t k = 1; k < first_times.size(); ++k) {
    ahead.push_back(look_at(first_times[k]));
    while (!ahead.empty()) {
      const Look& end = ahead.back();
      const double length = end.time - start.time;
      const bool is_far = std::min(start.nearest(length), end.nearest(length)) > sphere;
      double miss = 0;
      std::optional<Look> middle;
      for (const double part : checked_parts) {
        if (is_far || miss > accuracy) break;
        const Look between_both = look_at(start.time + part * length);
        miss = std::max(miss, start.miss(end, between_both));
        if (!middle) middle = between_both;
      }
      if (miss > accuracy) {
        // Intervals are halved where the cubic is not accurate enough, which happens more near a
        // perigee than elsewhere.
        if (times_.size() + ahead.size() >= most_nodes) {
          throw Error(
              ErrorKind::too_large,
              fmt::format("encounter: the relative motion would be told at more than {} times; "
                          "a shorter window would do",
                          most_nodes));
        }
        ahead.push_back(*std::move(middle));
        continue;
      }
      if (!is_far) {
        if (times_.empty() || times_.back() != start.time) add_node(start.time);
        arcs_.push_back(times_.size() - 1);
        add_node(end.time);
        interpolation_error_ = std::max(interpolation_error_, miss);
      }
      start = std::move(ahead.back());
      ahead.pop_back();
    }
  }
  has_begin_ = !times_.empty() && times_.front() == problem.from;
  for (std::size_t i = 0; i < 2 && !times_.empty(); ++i) {
    for (int degree = 1; degree <= problem.order; ++degree) {
      evaluators_[i].emplace_back(maps[i], degree);
    }
  }
}

LinearRelativeState RelativePaths::linear_at(double time) const {
  const auto after = std::upper_bound(times_.begin() + 1, times_.end() - 1, time);
  const auto node = static_cast<std::size_t>(after - times_.begin()) - 1;
  const double length = times_[node + 1] - times_[node];
  return between(linear_[node], linear_[node + 1], length, (time - times_[node]) / length);
}

void RelativePaths::evaluate(std::span<const double> points, int degree,
                             std::span<double> states) const {
  const std::size_t count = points.size() / encounter_variables;
  std::vector<double> deviations(6 * count);
  std::vector<double> values(states.size());
  for (std::size_t craft = 0; craft < 2; ++craft) {
    std::fill(deviations.begin(), deviations.end(), 0.0);
    for (std::size_t row = 0; row < 6; ++row) {
      for (std::size_t column = 0; column < 6; ++column) {
        const double entry =
            factors_[craft](static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
        if (entry == 0) continue;
        const double* x = &points[(6 * craft + column) * count];
        for (std::size_t j = 0; j < count; ++j) deviations[row * count + j] += entry * x[j];
      }
    }
    const MapEvaluator& evaluator = evaluators_[craft][static_cast<std::size_t>(degree - 1)];
    if (craft == 0) {
      evaluator.evaluate(deviations, {.values = states, .last = {}, .last_but_one = {}});
    } else {
      evaluator.evaluate(deviations, {.values = values, .last = {}, .last_but_one = {}});
    }
  }
  for (std::size_t node = 0; node < times_.size(); ++node) {
    for (std::size_t c = 0; c < 6; ++c) {
      const double mean = linear_[node].mean[static_cast<Eigen::Index>(c)];
      const std::size_t first = (6 * node + c) * count;
      for (std::size_t j = first; j < first + count; ++j)
        states[j] = mean + (values[j] - states[j]);
    }
  }
}

}  // namespace hamjet
