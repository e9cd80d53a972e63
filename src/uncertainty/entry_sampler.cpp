#include "entry_sampler.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <unordered_map>

#include "cubic_arc.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr double whole_turn = 2 * std::numbers::pi;
/// Below this fraction of the radius, standard deviations make the set of entries too thin a sheet
/// for boxes.
constexpr double narrowest = 0.01;
/// Conditions whose rows depend on each other to this fraction count as one condition.
constexpr double dependent = 1e-6;

/// A number x > 0 with a density proportional to x exp(-(x - a)^2 / 2), by rejection.
double draw_entry_speed(double a, RandomStream& random) {
  while (true) {
    if (a > -1) {
      // log x lies below its tangent at the mode m, so that a normal density is an envelope.
      const double mode = (a + std::sqrt(a * a + 4)) / 2;
      const double x = mode + random.normal();
      if (x > 0 && random.uniform() < x / mode * std::exp(1 - x / mode)) return x;
    } else {
      // The proposal is the sum of two exponential numbers of rate -a.
      const double x = std::log((1 - random.uniform()) * (1 - random.uniform())) / a;
      if (random.uniform() < std::exp(-x * x / 2)) return x;
    }
  }
}

std::array<double, 3> direction(double latitude, double longitude) {
  const double r = std::cos(latitude);
  return {r * std::cos(longitude), r * std::sin(longitude), std::sin(latitude)};
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::uint64_t stream) {
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
                         static_cast<std::uint32_t>(stream),
                         static_cast<std::uint32_t>(stream >> 32U)};
  engine_.seed(sequence);
}

/// The relative state at one time: mean and covariance, with the covariance of the position
/// factorised.
struct EntrySampler::AtTime {
  Eigen::Matrix<double, 6, 1> mean;
  Eigen::Matrix3d lower;     ///< Cholesky factor of the position's covariance
  Eigen::Matrix3d share;     ///< lower^-1 times the covariance of position with velocity
  Eigen::Matrix3d velocity;  ///< covariance of the velocity
  double log_amplitude = 0;
};

/// All that belongs to an entry at one time in one direction.
struct EntrySampler::Entry {
  Eigen::Vector3d normal;
  double mean_speed = 0;  ///< mean speed of entry, given the position
  double deviation_of_speed = 0;
  NormalFactor density;  ///< f
};

EntrySampler::AtTime EntrySampler::at_time(double time) const {
  const LinearRelativeState state = paths_->linear_at(time);
  const auto position = state.by_deviation.topRows(3);
  const auto velocity = state.by_deviation.bottomRows(3);
  AtTime result;
  result.mean = state.mean;
  result.lower = Eigen::LLT<Eigen::Matrix3d>(position * position.transpose()).matrixL();
  result.share = result.lower.triangularView<Eigen::Lower>().solve(
      Eigen::Matrix3d(position * velocity.transpose()));
  result.velocity = velocity * velocity.transpose();
  const Eigen::Matrix3d& l = result.lower;
  result.log_amplitude =
      2 * std::log(radius_) - 1.5 * std::log(whole_turn) - std::log(l(0, 0) * l(1, 1) * l(2, 2));
  return result;
}

EntrySampler::Entry EntrySampler::entry(const AtTime& state, double latitude,
                                        double longitude) const {
  Entry e;
  const auto n = direction(latitude, longitude);
  e.normal = {n[0], n[1], n[2]};
  const Eigen::Vector3d white = state.lower.triangularView<Eigen::Lower>().solve(
      Eigen::Vector3d(radius_ * e.normal - state.mean.head<3>()));
  const Eigen::Vector3d share = state.share * e.normal;
  const double variance = e.normal.dot(state.velocity * e.normal);
  e.mean_speed = -(e.normal.dot(state.mean.tail<3>()) + share.dot(white));
  e.deviation_of_speed = std::sqrt(std::max(variance - share.squaredNorm(), 1e-14 * variance));
  e.density = {state.log_amplitude + std::log(e.deviation_of_speed) + std::log(std::cos(latitude)),
               {white[0], white[1], white[2]},
               e.mean_speed / e.deviation_of_speed};
  return e;
}

BoxDensity::Density EntrySampler::entering() const {
  // Most boxes are halved across directions, so that the same times come again and again.
  const auto known = std::make_shared<std::unordered_map<double, AtTime>>();
  return [this, known](const std::array<double, 3>& point) {
    auto place = known->find(point[0]);
    if (place == known->end()) place = known->emplace(point[0], at_time(point[0])).first;
    return entry(place->second, point[1], point[2]).density;
  };
}

NormalFactor EntrySampler::inside(const std::array<double, 3>& point) const {
  const LinearRelativeState& state = paths_->linear(0);
  const auto n = direction(point[1], point[2]);
  const double distance = radius_ * point[0];
  const Eigen::Vector3d wanted =
      distance * Eigen::Vector3d(n[0], n[1], n[2]) - state.mean.head<3>();
  const Eigen::Matrix3d covariance =
      state.by_deviation.topRows(3) * state.by_deviation.topRows(3).transpose();
  const Eigen::Matrix3d lower = Eigen::LLT<Eigen::Matrix3d>(covariance).matrixL();
  const Eigen::Vector3d white = lower.triangularView<Eigen::Lower>().solve(wanted);
  return {3 * std::log(radius_) + 2 * std::log(point[0]) + std::log(std::cos(point[1])) -
              1.5 * std::log(whole_turn) - std::log(lower(0, 0) * lower(1, 1) * lower(2, 2)),
          {white[0], white[1], white[2]}};
}

std::vector<Box> EntrySampler::first_boxes() const {
  // The first boxes: in the interval between two times the mean moves by no more than the width of
  // sphere and uncertainty together. Intervals that stay far from the sphere are left out.
  std::vector<Box> boxes;
  const std::vector<double>& times = paths_->times();
  for (const std::size_t node : paths_->arcs()) {
    const double length = times[node + 1] - times[node];
    const LinearRelativeState& start = paths_->linear(node);
    const double speed =
        std::max(start.mean.tail(3).norm(), paths_->linear(node + 1).mean.tail(3).norm());
    const double width = radius_ + start.by_deviation.topRows(3).norm() / std::sqrt(3.0);
    const int parts = static_cast<int>(std::clamp(speed * length / width, 1.0, 1e4));
    for (int part = 0; part < parts; ++part) {
      const double low = times[node] + length * part / parts;
      const double high =
          part + 1 == parts ? times[node + 1] : times[node] + length * (part + 1) / parts;
      const LinearRelativeState middle = paths_->linear_at((low + high) / 2);
      const double spread = middle.by_deviation.topRows(3).norm() +
                            middle.by_deviation.bottomRows(3).norm() * (high - low) / 2;
      if (middle.mean.head(3).norm() - radius_ - speed * (high - low) > farthest_deviation * spread)
        continue;
      boxes.push_back({{low, -whole_turn / 4, 0}, {high, whole_turn / 4, whole_turn}});
    }
  }
  return boxes;
}

EntrySampler::EntrySampler(const RelativePaths& paths, double radius, bool begin_counts_late,
                           std::size_t boxes)
    : paths_(&paths),
      radius_(radius),
      entering_(first_boxes(), entering(), boxes),
      inside_(
          paths.has_begin()
              ? std::vector<Box>{{{0, -whole_turn / 4, 0}, {1, whole_turn / 4, whole_turn}}}
              : std::vector<Box>{},
          [this](const std::array<double, 3>& point) { return inside(point); }, boxes) {
  for (std::size_t node = 0; node < paths.times().size(); ++node) {
    const auto axes = paths.linear(node).by_deviation.topRows(3);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(axes * axes.transpose(),
                                                                Eigen::EigenvaluesOnly);
    if (solver.info() != Eigen::Success ||
        !(std::sqrt(std::max(0.0, solver.eigenvalues()[0])) > narrowest * radius)) {
      throw Error(ErrorKind::numerical,
                  "collision: the relative position is nearly certain in a direction, by the "
                  "radius, so that entries have no density that boxes could follow; plain "
                  "sampling needs none");
    }
  }
  const double largest = std::max(entering_.log_mass(), inside_.log_mass());
  if (!is_empty()) {
    const double entering = std::exp(entering_.log_mass() - largest);
    share_entering_ = entering / (entering + std::exp(inside_.log_mass() - largest));
    // The share of draws for paths that begin inside. Few of these come back; the weight of each
    // one that does is divided by this share.
    constexpr double share_of_late = 0.05;
    if (begin_counts_late && !entering_.is_empty()) {
      share_entering_ = std::max(share_entering_, 1 - share_of_late);
    }
  }
}

double EntrySampler::log_mass() const {
  const double largest = std::max(entering_.log_mass(), inside_.log_mass());
  return largest + std::log(std::exp(entering_.log_mass() - largest) +
                            std::exp(inside_.log_mass() - largest));
}

EncounterDeviation EntrySampler::draw(RandomStream& random) const {
  const bool enters = random.uniform() < share_entering_;
  std::array<double, 5> uniform{};
  for (double& u : uniform) u = random.uniform();
  const auto point = (enters ? entering_ : inside_).point(uniform);
  Eigen::Matrix<double, 4, 12> conditions = Eigen::Matrix<double, 4, 12>::Zero();
  Eigen::Matrix<double, 4, 1> wanted = Eigen::Matrix<double, 4, 1>::Zero();
  if (enters) {
    const LinearRelativeState state = paths_->linear_at(point[0]);
    const Entry e = entry(at_time(point[0]), point[1], point[2]);
    const double ratio = e.mean_speed / e.deviation_of_speed;
    const double speed = e.deviation_of_speed * draw_entry_speed(ratio, random);
    conditions.topRows(3) = state.by_deviation.topRows(3);
    conditions.row(3) = e.normal.transpose() * state.by_deviation.bottomRows(3);
    wanted.head(3) = radius_ * e.normal - state.mean.head(3);
    wanted[3] = -speed - e.normal.dot(state.mean.tail(3));
  } else {
    const auto n = direction(point[1], point[2]);
    const LinearRelativeState& state = paths_->linear(0);
    conditions.topRows(3) = state.by_deviation.topRows(3);
    wanted.head(3) = radius_ * point[0] * Eigen::Vector3d(n[0], n[1], n[2]) - state.mean.head(3);
  }
  EncounterDeviation deviation;
  for (Eigen::Index i = 0; i < deviation.size(); ++i) deviation[i] = random.normal();
  // The normal density on linear conditions is that of the nearest deviation that meets them. The
  // conditions have different units, so that each is scaled.
  const Eigen::Index count = enters ? 4 : 3;
  Eigen::Matrix<double, 4, 1> scale = conditions.rowwise().norm();
  for (Eigen::Index i = 0; i < count; ++i) {
    conditions.row(i) /= scale[i];
    wanted[i] /= scale[i];
  }
  const auto b = conditions.topRows(count);
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1> missing =
      wanted.head(count) - b * deviation;
  // Where the position determines the velocity, as for states whose velocity is known exactly, the
  // fourth condition follows from the others, and dividing by it must be avoided.
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix<double, Eigen::Dynamic, 12, 0, 4, 12>>
      solver;
  solver.setThreshold(dependent);
  solver.compute(b);
  deviation += solver.solve(missing);
  return deviation;
}

std::optional<double> EntrySampler::log_density_ratio(
    std::span<const std::array<double, 6>> states) const {
  const std::vector<double>& times = paths_->times();
  const double square = radius_ * radius_;
  double sum = 0, largest = 0;  // sum of the terms exp(log - largest)
  bool any = false;
  const auto add = [&](double log_term) {
    if (!any || log_term > largest) {
      sum = any ? sum * std::exp(largest - log_term) + 1 : 1;
      largest = log_term;
      any = true;
    } else {
      sum += std::exp(log_term - largest);
    }
  };
  const auto& first = states.front();
  const double distance =
      std::sqrt(first[0] * first[0] + first[1] * first[1] + first[2] * first[2]);
  const auto sphere_point = [](const Eigen::Vector3d& n) {
    const double longitude = std::atan2(n[1], n[0]);
    return std::array<double, 2>{std::asin(std::clamp(n[2], -1.0, 1.0)),
                                 longitude < 0 ? longitude + whole_turn : longitude};
  };
  if (distance < radius_ && !inside_.is_empty()) {
    const auto [latitude, longitude] =
        sphere_point(Eigen::Vector3d(first[0], first[1], first[2]) / std::max(distance, 1e-300));
    const std::array<double, 3> point = {distance / radius_, latitude, longitude};
    if (const auto density = inside_.log_density(point)) {
      add(*density + std::log1p(-share_entering_) - inside(point).log_value());
    }
  }
  std::vector<double> parts;
  for (const std::size_t node : paths_->arcs()) {
    const double length = times[node + 1] - times[node];
    const SquaredDistance arc(states[node], states[node + 1], length);
    if (arc.lower_bound() >= square) continue;
    parts.clear();
    arc.entries(square, parts);
    for (const double part : parts) {
      const HermiteWeights w = hermite_weights(length, part);
      Eigen::Vector3d position;
      for (std::size_t i = 0; i < 3; ++i) {
        position[static_cast<Eigen::Index>(i)] =
            w.position[0] * states[node][i] + w.position[1] * states[node][i + 3] +
            w.position[2] * states[node + 1][i] + w.position[3] * states[node + 1][i + 3];
      }
      const auto [latitude, longitude] = sphere_point(position / position.norm());
      const double time = times[node] + part * length;
      if (const auto density = entering_.log_density({time, latitude, longitude})) {
        add(*density + std::log(share_entering_) -
            entry(at_time(time), latitude, longitude).density.log_value());
      }
    }
  }
  if (!any) return {};
  return largest + std::log(sum);
}

}  // namespace hamjet
