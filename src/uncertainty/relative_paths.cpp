#include "relative_paths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cubic_arc.hpp"
#include "encounter_trajectories.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// Deviations for which the cubics between nodes are to be right, in standard deviations.
constexpr double sigmas = 4;
/// More nodes than this would take gigabytes, and a sample a millisecond.
constexpr std::size_t most_nodes = 20000;

/// By how much the cubic misses a relative position at the middle of an interval.
double midpoint_miss(const LinearRelativeState& start, const LinearRelativeState& end,
                     const LinearRelativeState& middle, double length) {
  const LinearRelativeState cubic = between(start, end, length, 0.5);
  const auto spread = (cubic.by_deviation - middle.by_deviation).topRows(3).norm();
  return (cubic.mean - middle.mean).head(3).norm() + sigmas * spread;
}

/// Whether no path between two nodes comes near a sphere.
bool is_far(const LinearRelativeState& start, const LinearRelativeState& end, double length,
            double radius) {
  const auto nearest = [&](const LinearRelativeState& state) {
    const double speed =
        state.mean.tail(3).norm() + farthest_deviation * state.by_deviation.bottomRows(3).norm();
    return state.mean.head(3).norm() - farthest_deviation * state.by_deviation.topRows(3).norm() -
           speed * length;
  };
  return std::min(nearest(start), nearest(end)) > radius;
}

}  // namespace

std::array<double, 6> UncertainSpacecraft::deviated(const Eigen::Matrix<double, 6, 1>& xi) const {
  const Eigen::Matrix<double, 6, 1> deviation = factor * xi;
  std::array<double, 6> result{};
  for (std::size_t i = 0; i < 6; ++i)
    result[i] = state[i] + deviation[static_cast<Eigen::Index>(i)];
  return result;
}

void validate(const EncounterProblem& problem) {
  if (!problem.system || problem.system->dimension() != 6) {
    throw Error(ErrorKind::usage, "encounter: the system must be one of an orbit");
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
  if (!(problem.to > problem.from) || problem.from < 0) {
    throw Error(ErrorKind::usage,
                "encounter: the window must end after it begins, and not begin "
                "before the epoch");
  }
  if (!(problem.radius > 0)) {
    throw Error(ErrorKind::usage, "encounter: the radius must be positive");
  }
}

RelativePaths::RelativePaths(const EncounterProblem& problem, double accuracy, double sphere) {
  validate(problem);
  for (std::size_t i = 0; i < 2; ++i) factors_[i] = problem.spacecraft[i].factor;
  const EncounterTrajectories trajectories(problem);
  // Intervals are halved where the cubic is not good enough: near a perigee more than elsewhere.
  struct Node {
    double time;
    std::array<FlowJet<double>, 2> jets;
    LinearRelativeState linear;
  };
  const auto node_at = [&](double time) {
    std::array<FlowJet<double>, 2> jets = {trajectories.jet(0, time), trajectories.jet(1, time)};
    const LinearRelativeState linear = trajectories.linear(jets);
    return Node{time, std::move(jets), linear};
  };
  std::vector<Node> nodes;
  nodes.push_back(node_at(problem.from));
  std::vector<Node> ahead;  // the nearest last
  ahead.push_back(node_at(problem.to));
  std::vector<bool> is_arc;  // before each node but the first
  while (!ahead.empty()) {
    const Node& start = nodes.back();
    const Node& end = ahead.back();
    const double length = end.time - start.time;
    const bool far = is_far(start.linear, end.linear, length, sphere);
    std::optional<Node> middle;
    if (!far) middle = node_at((start.time + end.time) / 2);
    if (far || midpoint_miss(start.linear, end.linear, middle->linear, length) <= accuracy) {
      nodes.push_back(std::move(ahead.back()));
      ahead.pop_back();
      is_arc.push_back(!far);
      continue;
    }
    if (nodes.size() + ahead.size() >= most_nodes) {
      throw Error(ErrorKind::too_large,
                  fmt::format("encounter: the relative motion would be told at more than {} times; "
                              "a shorter window would do",
                              most_nodes));
    }
    ahead.push_back(*std::move(middle));
  }
  is_arc.push_back(false);
  has_begin_ = is_arc.front();
  std::array<std::vector<Series<double>>, 2> maps;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (!is_arc[k] && (k == 0 || !is_arc[k - 1])) continue;
    Node& node = nodes[k];
    if (is_arc[k]) arcs_.push_back(times_.size());
    times_.push_back(node.time);
    linear_.push_back(node.linear);
    for (std::size_t i = 0; i < 2; ++i) {
      for (Series<double>& component : node.jets[i]) {
        component[0] = 0;
        maps[i].push_back(std::move(component));
      }
    }
  }
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
