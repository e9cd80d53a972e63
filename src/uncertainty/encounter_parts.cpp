#include "encounter_parts.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "../algebra/singular_values.hpp"
#include "../integrators/concurrent_tasks.hpp"
#include "cubic_arc.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/maps/domain_splitting.hpp"
#include "hamjet/uncertainty/polynomial_moments.hpp"
#include "relative_paths.hpp"
#include "track_axes.hpp"

namespace hamjet {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Row6 = Eigen::Matrix<double, 1, 6>;

/// A distribution is left whole if its parts would be wider than this.
constexpr double widest_part = 0.8;
/// There are some 3000 parts of a spacecraft at most.
constexpr double narrowest_part = 0.005;
/// The spacing of the parts over k sqrt(1 - k^2).
constexpr double spacing = 1.2;
/// Pairs of parts that contribute less than exp of this, beside the largest one, are left out.
constexpr double least_logarithm = -12;
constexpr double looks_per_period = 64;
constexpr double fewest_looks = 16;
/// Below this fraction of the speed on the circle, others may meet at other times than the means.
constexpr double slow_part = 0.1;
/// How often the time between two looks at a slow pair is narrowed to two thirds.
constexpr int narrowings = 12;

/// One spacecraft's share of a part.
struct Component {
  double log_weight = 0;
  UncertainSpacecraft craft;
  WindowJets low = nullptr;
  WindowJets full = nullptr;
  std::vector<Eigen::Matrix<double, 6, 1>> means = {};  ///< states at the looks
  std::vector<Matrix6> spreads = {};                    ///< their derivatives by the normal numbers
};

/// The gradient, by the standard normal numbers, of the position along the track.
Row6 along_track(const UncertainSpacecraft& craft) {
  return TrackAxes(craft.state.data()).along.transpose() * craft.factor.topRows(3);
}

/// The part of a spacecraft's distribution about a standard normal number along a unit vector of
/// the six, in which that number is narrower by a factor.
UncertainSpacecraft narrowed(const UncertainSpacecraft& whole, const Row6& direction, double centre,
                             double narrow) {
  const auto moved = whole.deviated(centre * direction.transpose());
  const Matrix6 narrowing = Matrix6::Identity() + (narrow - 1) * direction.transpose() * direction;
  UncertainSpacecraft part;
  part.state.assign(moved.begin(), moved.end());
  part.own_system = whole.own_system;
  if (!whole.straight) {
    part.factor = whole.factor * narrowing;
    return part;
  }
  const StraightDeviations& straight = *whole.straight;
  part.straight.emplace(straight.chart(), moved);
  const Matrix6 of_coordinates = straight.slope() * whole.factor * narrowing;
  part.factor = Eigen::PartialPivLU<Matrix6>(part.straight->slope()).solve(of_coordinates);
  return part;
}

/// A direction of the standard normal numbers, a unit vector, and how narrow parts along it are.
struct Narrowing {
  Row6 direction;
  double narrow = 1;
};

constexpr double right_within = 3;  // standard deviations of a part

/// Within three standard deviations of a part the path bends by `bend` at most.
Narrowing by_bend(const UncertainSpacecraft& craft, double bend) {
  const Row6 along = along_track(craft);
  const double deviation = along.norm();
  if (!craft.straight || !(deviation > 0)) return {Row6::UnitX(), 1};
  const double distance = Eigen::Map<const Eigen::Vector3d>(craft.state.data()).norm();
  return {along / deviation,
          std::max(std::sqrt(2 * distance * bend) / (right_within * deviation), narrowest_part)};
}

/// Within three standard deviations of a part the polynomials are right to the problem's tolerance,
/// as far as those about the whole's mean foretell; the direction is that which the flow stretches
/// most by the end of the window that is farther from the epoch.
Narrowing by_tolerance(const EncounterProblem& problem, std::size_t craft,
                       const std::vector<double>& looks) {
  const UncertainSpacecraft& whole = problem.spacecraft[craft];
  const WindowJets jets = window_jets(problem, craft);
  const auto jet_at = [&](double time) {
    return jets->at(std::clamp(time - problem.from, 0.0, problem.to - problem.from));
  };
  const double last = std::abs(problem.to) >= std::abs(problem.from) ? problem.to : problem.from;
  const Matrix<double> turn =
      decompose_by_singular_values(Matrix<double>(linear_part(jet_at(last)) * whole.factor)).right;
  std::vector<FlowMap<double>> maps;
  const Covariance turned = Covariance::of_factor(Matrix<double>(whole.factor * turn));
  for (const double time : looks) {
    maps.emplace_back(in_standard_normals(jet_at(time), turned));
  }
  const double narrowest = std::max(
      narrowest_part, 2 * farthest_deviation / (spacing * static_cast<double>(problem.most_parts)));
  constexpr double factor = 0.85;  // from one trial to the next
  Narrowing result{turn.col(0).transpose(), 1};
  std::vector<double> widths(6, right_within);
  const auto is_right = [&](const FlowMap<double>& map) {
    return truncation_in_box(map, widths, 3) <= *problem.tolerance;
  };
  while (result.narrow > narrowest && !std::all_of(maps.begin(), maps.end(), is_right)) {
    result.narrow = std::max(result.narrow * factor, narrowest);
    widths[0] = right_within * result.narrow;
  }
  return result;
}

/// The parts of one spacecraft.
std::vector<Component> components_of(const UncertainSpacecraft& craft, const Narrowing& narrowing) {
  const double narrow = narrowing.narrow;
  if (!(narrow < widest_part)) return {{0, craft}};
  const double variance = 1 - narrow * narrow;
  const double step = spacing * narrow * std::sqrt(variance);
  std::vector<Component> components;
  const int most = static_cast<int>(farthest_deviation / step);
  for (int k = -most; k <= most; ++k) {
    const double centre = k * step;
    Component component{-centre * centre / (2 * variance) +
                            std::log(step / std::sqrt(2 * std::numbers::pi * variance)),
                        narrowed(craft, narrowing.direction, centre, narrow)};
    // Far out the coordinates may belong to no orbit.
    if (component.craft.factor.allFinite()) components.push_back(std::move(component));
  }
  return components;
}

/// Half of the square of the shortest vector of normal numbers that makes the position across the
/// relative velocity vanish.
double half_square_across(const LinearRelativeState& state) {
  const Eigen::Matrix<double, 2, 3> plane = plane_across(state);
  const Eigen::Vector2d miss = plane * state.mean.head<3>();
  const Eigen::Matrix<double, 2, 12> spread = plane * state.by_deviation.topRows(3);
  const Eigen::Matrix2d covariance = spread * spread.transpose();
  const double square = miss.dot(covariance.inverse() * miss);
  return std::isfinite(square) ? square / 2 : 0;
}

/// The same for the whole position at one time.
double half_square_at(const LinearRelativeState& state) {
  const auto spread = state.by_deviation.topRows(3);
  const Eigen::Vector3d miss = state.mean.head<3>();
  const Eigen::Matrix3d covariance = spread * spread.transpose();
  const double square = miss.dot(Eigen::FullPivLU<Eigen::Matrix3d>(covariance).solve(miss));
  return std::isfinite(square) ? square / 2 : 0;
}

/// Compares the parts of both spacecraft.
class Pairing {
 public:
  Pairing(const EncounterProblem& problem, std::vector<double> looks)
      : problem_(&problem), looks_(std::move(looks)) {}

  LinearRelativeState at(const Component& first, const Component& second, std::size_t look) const {
    LinearRelativeState state;
    state.mean = second.means[look] - first.means[look];
    state.by_deviation.leftCols(6) = -first.spreads[look];
    state.by_deviation.rightCols(6) = second.spreads[look];
    return state;
  }

  /// The logarithm of about what a pair contributes, up to a factor that all have.
  double log_contribution(const Component& first, const Component& second) const {
    double least = std::min(half_square_across(at(first, second, 0)),
                            half_square_across(at(first, second, looks_.size() - 1)));
    double before = 0;
    bool is_slow = false;
    for (std::size_t k = 0; k < looks_.size(); ++k) {
      const Eigen::Matrix<double, 6, 1> mean = second.means[k] - first.means[k];
      const double rate = mean.head<3>().dot(mean.tail<3>());
      const double circle = 1 / std::sqrt(first.means[k].head<3>().norm());
      is_slow = is_slow || mean.tail<3>().norm() < slow_part * circle;
      if (k > 0 && before < 0 && rate >= 0) {
        const double length = looks_[k] - looks_[k - 1];
        const LinearRelativeState start = at(first, second, k - 1), end = at(first, second, k);
        double part = before / (before - rate);
        const LinearRelativeState near = between(start, end, length, part);
        part -= near.mean.head<3>().dot(near.mean.tail<3>()) /
                (near.mean.tail<3>().squaredNorm() * length);
        const LinearRelativeState state = between(start, end, length, std::clamp(part, 0.0, 1.0));
        least = std::min(least, half_square_across(state));
      }
      before = rate;
    }
    if (is_slow) least = std::min(least, least_half_square(first, second));
    return first.log_weight + second.log_weight - least;
  }

  /// The least over the window of half_square_at, near the look at which it is least.
  double least_half_square(const Component& first, const Component& second) const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < looks_.size(); ++k) {
      const double value = half_square_at(at(first, second, k));
      if (value < least) {
        least = value;
        best = k;
      }
    }
    for (const std::size_t k : {best, best + 1}) {
      if (k == 0 || k >= looks_.size()) continue;
      const LinearRelativeState start = at(first, second, k - 1), end = at(first, second, k);
      const auto value_at = [&](double part) {
        return half_square_at(between(start, end, looks_[k] - looks_[k - 1], part));
      };
      double low = 0, high = 1;
      for (int n = 0; n < narrowings; ++n) {
        const double one = (2 * low + high) / 3, other = (low + 2 * high) / 3;
        if (value_at(one) < value_at(other)) {
          high = other;
        } else {
          low = one;
        }
      }
      least = std::min(least, value_at((low + high) / 2));
    }
    return least;
  }

  void look(Component& component, std::size_t craft) const {
    EncounterProblem problem = of(component, craft);
    problem.order = std::min(problem.order, order_of_looks);
    component.low = window_jets(problem, craft);
    for (const double time : looks_) {
      const FlowJet<double> jet =
          component.low->at(std::clamp(time - problem.from, 0.0, problem.to - problem.from));
      Eigen::Matrix<double, 6, 1> mean;
      for (std::size_t i = 0; i < 6; ++i) mean[static_cast<Eigen::Index>(i)] = jet[i][0];
      component.means.push_back(mean);
      component.spreads.emplace_back(linear_part(jet) * component.craft.factor);
    }
  }
  void complete(Component& component, std::size_t craft) const {
    if (component.full) return;
    component.full =
        problem_->order > order_of_looks ? window_jets(of(component, craft), craft) : component.low;
  }

 private:
  EncounterProblem of(const Component& component, std::size_t craft) const {
    EncounterProblem problem = *problem_;
    problem.spacecraft[craft] = component.craft;
    return problem;
  }

  const EncounterProblem* problem_;
  std::vector<double> looks_;
};

}  // namespace

std::vector<EncounterPart> encounter_parts(const EncounterProblem& problem, double bend,
                                           std::size_t threads) {
  EncounterProblem of_means = problem;
  of_means.order = 0;
  std::vector<double> looks;
  const auto look = [&] {
    if (looks.empty()) {
      looks = EncounterTrajectories(of_means).times_of_looks(looks_per_period, fewest_looks);
    }
    return looks;
  };
  std::array<std::vector<Component>, 2> components;
  std::vector<std::pair<std::size_t, std::size_t>> all;  // spacecraft and component
  for (std::size_t craft = 0; craft < 2; ++craft) {
    const UncertainSpacecraft& whole = problem.spacecraft[craft];
    Narrowing narrowing = by_bend(whole, bend);
    if (problem.tolerance && problem.order > 1 && whole.factor.norm() > 0) {
      const Narrowing right = by_tolerance(problem, craft, look());
      // Of two reasons the one that asks for more decides; the other is looked at again in parts.
      if (right.narrow < narrowing.narrow) narrowing = right;
    }
    components[craft] = components_of(whole, narrowing);
    for (std::size_t k = 0; k < components[craft].size(); ++k) all.emplace_back(craft, k);
  }
  if (all.size() <= 2) return {{1, problem}};
  const Pairing pairing(problem, look());
  const auto on_threads = [&](std::size_t count, const auto& task) {
    run_concurrently(
        count, threads,
        [&](std::size_t k, TaskControl& control) {
          task(k);
          control.advance();
        },
        [](long) {});
  };
  on_threads(all.size(), [&](std::size_t k) {
    pairing.look(components[all[k].first][all[k].second], all[k].first);
  });
  struct Pair {
    std::size_t first;
    std::size_t second;
    double log_contribution;
  };
  std::vector<Pair> pairs;
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < components[0].size(); ++i) {
    for (std::size_t j = 0; j < components[1].size(); ++j) {
      pairs.push_back({i, j, pairing.log_contribution(components[0][i], components[1][j])});
      largest = std::max(largest, pairs.back().log_contribution);
    }
  }
  std::erase_if(pairs, [&](const Pair& pair) {
    return !(pair.log_contribution > largest + least_logarithm);
  });
  std::array<std::vector<char>, 2> is_wanted;
  for (std::size_t craft = 0; craft < 2; ++craft) is_wanted[craft].resize(components[craft].size());
  for (const Pair& pair : pairs) is_wanted[0][pair.first] = is_wanted[1][pair.second] = 1;
  on_threads(all.size(), [&](std::size_t k) {
    const auto [craft, place] = all[k];
    if (is_wanted[craft][place]) pairing.complete(components[craft][place], craft);
  });
  std::vector<EncounterPart> parts;
  for (const Pair& pair : pairs) {
    const Component& first = components[0][pair.first];
    const Component& second = components[1][pair.second];
    EncounterPart part{std::exp(first.log_weight + second.log_weight), problem};
    part.problem.spacecraft = {first.craft, second.craft};
    part.trajectories.emplace(part.problem, std::array{first.full, second.full});
    part.low.emplace(part.problem, std::array{first.low, second.low});
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace hamjet
