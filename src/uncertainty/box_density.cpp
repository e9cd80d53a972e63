#include "box_density.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

namespace hamjet {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

/// The fraction of the bound of a box's mass that is added to the mass seen in it, so that no point
/// has a weight of more than a hundred.
constexpr double share_of_bound = 0.01;
/// The same fraction for a box in which no point has a positive density. Grazing entries may lie at
/// the edge of boxes in which all other paths leave.
constexpr double share_of_unseen = 0.25;
/// Quantities are assumed to spread in a box by this factor more than is seen. With 1,
/// probabilities of slow encounters come out too low by up to 1e-2, with 2 and 4 by no more than
/// their standard errors.
constexpr double spread_factor = 2;
/// Boxes are fine enough if at most this fraction of the whole mass may be missed; the weights then
/// differ by some hundredths.
constexpr double fine_enough = 0.03;
/// Slopes of a logarithm across a box are limited to this number, at which the exponential is
/// already negligible at the other end.
constexpr double steepest_slope = 20;
constexpr double level_slope = 1e-6;

/// A number in [0, 1) with a density proportional to exp(slope u), made from a uniform number.
double tilted(double uniform, double slope) {
  if (std::abs(slope) < level_slope) return uniform;
  return std::clamp(std::log1p(uniform * std::expm1(slope)) / slope, 0.0, 1.0);
}
/// The logarithm of that density.
double log_tilt(double u, double slope) {
  if (std::abs(slope) < level_slope) return 0;
  return slope * u + std::log(slope / std::expm1(slope));
}

double log_sum(double a, double b) {
  const double largest = std::max(a, b);
  if (largest == nothing) return nothing;
  return largest + std::log(std::exp(a - largest) + std::exp(b - largest));
}

double norm(const std::array<double, 3>& a) {
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

}  // namespace

double log_mean_positive(double a) {
  const double log_density = -a * a / 2 - std::log(2 * std::numbers::pi) / 2;
  if (a > -6) {
    return std::log(std::exp(log_density) + a * std::erfc(-a / std::numbers::sqrt2) / 2);
  }
  // The asymptotic series, where the sum above cancels.
  const double s = 1 / (a * a);
  return log_density + std::log(s * (1 - s * (3 - s * (15 - s * 105))));
}

BoxDensity::Node BoxDensity::made(const Box& box, const Density& density) {
  // Gauss's quadrature points, two in each dimension, and the centre.
  std::array<NormalFactor, 9> factors{};
  std::array<double, 9> of_speed{};    // logarithms of the factors of the speeds
  std::array<double, 9> log_values{};  // logarithms of the density
  for (std::size_t k = 0; k < 9; ++k) {
    std::array<double, 3> point{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double side = k == 8 ? 0 : (((k >> i) & 1U) != 0 ? 1 : -1) / std::numbers::sqrt3;
      point[i] = (box.low[i] + box.high[i]) / 2 + side * (box.high[i] - box.low[i]) / 2;
    }
    factors[k] = density(point);
    if (factors[k].speed) of_speed[k] = log_mean_positive(*factors[k].speed);
    log_values[k] = factors[k].log_value(of_speed[k]);
  }
  Node node;
  node.box = box;
  node.log_even = node.log_mean = node.log_mass = node.priority = nothing;
  const NormalFactor& centre = factors[8];
  double largest = nothing;
  double amplitude = nothing;
  double spread = 0;
  double speeds = 0;
  for (std::size_t k = 0; k < factors.size(); ++k) {
    if (!std::isfinite(log_values[k])) continue;
    largest = std::max(largest, log_values[k]);
    amplitude = std::max(amplitude, factors[k].log_amplitude);
  }
  if (largest == nothing) return node;
  // The largest change along a diagonal. Gauss's points are at 1 / sqrt(3) of the way from the
  // centre to the corners. A quadratic function that differs by d between the points, and by dd
  // between these and the centre, changes by sqrt(3) d + 3 dd.
  const auto at_corner = [](double d, double dd) {
    return spread_factor * (std::numbers::sqrt3 * d + 3 * dd);
  };
  for (std::size_t k = 0; k < 4; ++k) {
    const NormalFactor& one = factors[k];
    const NormalFactor& opposite = factors[7 - k];
    std::array<double, 3> d{};
    std::array<double, 3> dd{};
    for (std::size_t i = 0; i < 3; ++i) {
      d[i] = (one.white[i] - opposite.white[i]) / 2;
      dd[i] = (one.white[i] + opposite.white[i]) / 2 - centre.white[i];
    }
    spread = std::max(spread, at_corner(norm(d), norm(dd)));
    if (centre.speed) {
      speeds =
          std::max(speeds, at_corner(std::abs(*one.speed - *opposite.speed) / 2,
                                     std::abs((*one.speed + *opposite.speed) / 2 - *centre.speed)));
    }
  }
  const double nearest = std::max(0.0, norm(centre.white) - spread);
  const double of_highest_speed = centre.speed ? log_mean_positive(*centre.speed + speeds) : 0;
  amplitude += of_highest_speed;
  const double bound = std::max(largest, amplitude - nearest * nearest / 2);
  // For a fast entry the factor is the speed itself, whose logarithm changes little.
  const double change_of_factor =
      centre.speed ? of_highest_speed - log_mean_positive(*centre.speed - std::min(speeds, 10.0))
                   : 0;
  double mean = 0;
  for (const double value : log_values) mean += std::exp(value - bound) / 9;
  node.log_mean = bound + std::log(mean);
  node.log_even = bound + std::log(mean > 0 ? share_of_bound : share_of_unseen);
  const double log_volume = std::log(box.volume());
  node.log_mass = log_sum(node.log_even, node.log_mean) + log_volume;
  // The box is halved across the direction in which the density changes most.
  double steepest = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<double, 3> difference{};
    double factor = 0;
    double value = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      const double sign = ((k >> i) & 1U) != 0 ? 0.25 : -0.25;
      for (std::size_t c = 0; c < 3; ++c) difference[c] += sign * factors[k].white[c];
      factor += sign * of_speed[k];
      value += sign * log_values[k];
    }
    // Gauss's points are 1 / sqrt(3) of the box apart.
    value *= std::numbers::sqrt3;
    node.slope[i] = std::isfinite(value) ? std::clamp(value, -steepest_slope, steepest_slope) : 0;
    const double change = norm(difference) + (std::isfinite(factor) ? std::abs(factor) : 0);
    if (change > steepest) {
      steepest = change;
      node.dimension = static_cast<int>(i);
    }
  }
  // Taking the logarithm as linear misses the terms of second order.
  const double second = std::pow(spread + change_of_factor, 2);
  node.priority = bound + log_volume + std::log(std::min(1.0, second) + 1e-9);
  return node;
}

bool BoxDensity::is_fine() const {
  double most = nothing;
  for (const Node& node : nodes_) {
    if (node.first_child == 0) most = std::max(most, node.log_mass);
  }
  double missed = 0;
  double whole = 0;
  for (const Node& node : nodes_) {
    if (node.first_child != 0 || node.log_even == nothing) continue;
    missed += std::exp(node.priority - most);
    whole += std::exp(node.log_mass - most);
  }
  return missed < fine_enough * whole;
}

BoxDensity::BoxDensity(const std::vector<Box>& boxes, const Density& density, std::size_t most) {
  struct Entry {
    double priority;
    std::size_t node;
    bool operator<(const Entry& other) const { return priority < other.priority; }
  };
  std::priority_queue<Entry> queue;
  for (const Box& box : boxes) {
    nodes_.push_back(made(box, density));
    queue.push({nodes_.back().priority, nodes_.size() - 1});
  }
  roots_ = nodes_.size();
  std::size_t look = 2 * roots_;
  for (std::size_t count = roots_; count < std::max(most, 2 * roots_) && !queue.empty(); ++count) {
    if (count >= look) {
      if (is_fine()) break;
      look = count + count / 4;
    }
    const Entry entry = queue.top();
    queue.pop();
    if (entry.priority == nothing) break;
    const auto dimension = static_cast<std::size_t>(nodes_[entry.node].dimension);
    Box lower = nodes_[entry.node].box;
    Box upper = lower;
    lower.high[dimension] = upper.low[dimension] =
        (lower.low[dimension] + lower.high[dimension]) / 2;
    nodes_[entry.node].first_child = nodes_.size();
    for (const Box& half : {lower, upper}) {
      nodes_.push_back(made(half, density));
      queue.push({nodes_.back().priority, nodes_.size() - 1});
    }
  }
  branches_.reserve(nodes_.size());
  for (const Node& node : nodes_) {
    const auto dimension = static_cast<std::size_t>(node.dimension);
    const double middle = node.first_child == 0 ? 0 : nodes_[node.first_child].box.high[dimension];
    branches_.push_back({middle, static_cast<std::uint32_t>(node.first_child),
                         static_cast<std::uint32_t>(dimension)});
  }
  log_mass_ = nothing;
  double largest = nothing;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (nodes_[k].first_child != 0 || nodes_[k].log_even == nothing) continue;
    leaves_.push_back(k);
    largest = std::max(largest, nodes_[k].log_mass);
  }
  if (leaves_.empty()) return;
  double sum = 0;
  for (const std::size_t leaf : leaves_) {
    sum += std::exp(nodes_[leaf].log_mass - largest);
    cumulative_.push_back(sum);
  }
  log_mass_ = largest + std::log(sum);
}

std::array<double, 3> BoxDensity::point(const std::array<double, 5>& uniform) const {
  const auto place =
      std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, uniform[0] * cumulative_.back());
  const Node& node = nodes_[leaves_[static_cast<std::size_t>(place - cumulative_.begin())]];
  const double even = std::exp(node.log_even - log_sum(node.log_even, node.log_mean));
  std::array<double, 3> point{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = uniform[1] < even ? uniform[i + 2] : tilted(uniform[i + 2], node.slope[i]);
    point[i] = node.box.low[i] + part * (node.box.high[i] - node.box.low[i]);
  }
  return point;
}

std::optional<double> BoxDensity::log_density(const std::array<double, 3>& point) const {
  const auto end = nodes_.begin() + static_cast<std::ptrdiff_t>(roots_);
  const auto after =
      std::upper_bound(nodes_.begin(), end, point[0],
                       [](double x, const Node& node) { return x < node.box.low[0]; });
  if (after == nodes_.begin()) return {};
  auto place = static_cast<std::size_t>(after - nodes_.begin()) - 1;
  if (point[0] > nodes_[place].box.high[0]) return {};
  while (branches_[place].first_child != 0) {
    const Branch& branch = branches_[place];
    place = branch.first_child + (point[branch.dimension] < branch.middle ? 0 : 1);
  }
  const Node& node = nodes_[place];
  if (node.log_even == nothing) return {};
  double tilt = node.log_mean;
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = node.box.high[i] - node.box.low[i];
    tilt += log_tilt((point[i] - node.box.low[i]) / length, node.slope[i]);
  }
  return log_sum(node.log_even, tilt) - log_mass_;
}

}  // namespace hamjet
