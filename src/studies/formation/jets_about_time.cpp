#include "jets_about_time.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace hamjet {
namespace {

/// Nodes to each side of the one in the middle.
constexpr Eigen::Index side = 10;
constexpr Eigen::Index nodes = 2 * side + 1;
/// Half of the span of the nodes, in units of the distance over the speed, or of the time of a fall
/// where that is shorter, as it is near the apogee of an eccentric orbit.
constexpr double half_span = 0.35;

double half_span_at(double distance, double speed) {
  return half_span * std::min(distance / speed, std::sqrt(distance * distance * distance));
}

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// Node j, from -1 to 1.
long double node(Eigen::Index j) {
  if (j == side) return 0;
  return -std::cos(std::numbers::pi_v<long double> * (static_cast<long double>(j) + 0.5L) / nodes);
}

/// The numbers by which values at the nodes become coefficients of powers: row k is of power k, and
/// column j has Lagrange's polynomial that is 1 at node j and 0 at the others. These are large and
/// cancel, for which they are made with more digits than they are used.
LongMatrix weights_of_powers() {
  LongMatrix weights = LongMatrix::Zero(nodes, nodes);
  for (Eigen::Index j = 0; j < nodes; ++j) {
    weights(0, j) = 1;
    Eigen::Index degree = 0;
    for (Eigen::Index i = 0; i < nodes; ++i) {
      if (i == j) continue;
      // Times (x - node i) / (node j - node i).
      const long double distance = node(j) - node(i);
      for (Eigen::Index k = ++degree; k >= 0; --k) {
        const long double below = k > 0 ? weights(k - 1, j) : 0;
        weights(k, j) = (below - node(i) * weights(k, j)) / distance;
      }
    }
  }
  return weights;
}

}  // namespace

std::vector<FlowJet<double>> jets_about_time(const JetPropagation& at_time,
                                             const FlowJet<double>& jet, int order) {
  static const LongMatrix weights = weights_of_powers();
  const double distance = std::hypot(jet[0][0], jet[1][0], jet[2][0]);
  const double span = half_span_at(distance, std::hypot(jet[3][0], jet[4][0], jet[5][0]));
  std::vector<FlowJet<double>> at_nodes(static_cast<std::size_t>(nodes));
  at_nodes[side] = jet;
  for (const int sign : {-1, 1}) {
    JetPropagation onward = at_time;
    for (Eigen::Index j = side + sign; j >= 0 && j < nodes; j += sign) {
      at_nodes[static_cast<std::size_t>(j)] =
          onward.advance_to(at_time.time() + span * static_cast<double>(node(j)));
    }
  }
  std::vector<FlowJet<double>> result = {jet};
  for (int k = 1; k <= order; ++k) {
    FlowJet<double>& power = result.emplace_back();
    const LongMatrix of_nodes = weights.row(k) / std::pow(static_cast<long double>(span), k);
    for (std::size_t c = 0; c < jet.size(); ++c) {
      Series<double> sum(jet[c].space_pointer());
      for (Eigen::Index j = 0; j < nodes; ++j) {
        sum += at_nodes[static_cast<std::size_t>(j)][c] * static_cast<double>(of_nodes(0, j));
      }
      power.push_back(std::move(sum));
    }
  }
  return result;
}

double longest_time_about(std::span<const double> state) {
  constexpr double changes = 1.1;  // of the apogee, by what perturbs the orbit
  const Eigen::Map<const Eigen::Vector3d> position(state.data());
  const Eigen::Map<const Eigen::Vector3d> velocity(state.data() + 3);
  const double energy = velocity.squaredNorm() / 2 - 1 / position.norm();
  if (!(energy < 0)) return 0;
  const double shape = 1 + 2 * energy * position.cross(velocity).squaredNorm();
  const double apogee = (1 + std::sqrt(std::max(shape, 0.0))) / (-2 * energy);
  return half_span * std::pow(changes * apogee, 1.5);
}

}  // namespace hamjet
