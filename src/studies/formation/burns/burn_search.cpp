#include "burn_search.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// A share of the sum of all changes below which an impulse is nothing that a burn could begin
/// from.
constexpr double nothing = 1e-9;

double sum_of(const std::vector<Eigen::Vector3d>& changes) {
  double sum = 0;
  for (const Eigen::Vector3d& change : changes) sum += change.norm();
  return sum;
}

}  // namespace

BurnSearch::BurnSearch(const Scene& scene, const ComputedProblem& problem,
                       const SharedSystem& burning, const std::vector<Impulse>& impulses,
                       double duration)
    : scene_(scene),
      impulses_(impulses),
      duration_(duration),
      flight_(scene, problem, burning, duration),
      thruster_(*scene.thruster, flight_.units()),
      from_(flight_.changes_of(impulses)) {
  const double sum = sum_of(from_);
  for (Eigen::Vector3d& change : from_) {
    if (change.norm() < nothing * sum) change = nothing * sum * Eigen::Vector3d::UnitY();
  }
}

/// The thruster whose acceleration is one over a share times as large; the speed of the exhaust is
/// the same.
CanonicalThruster BurnSearch::stronger(double share) const {
  CanonicalThruster thruster = thruster_;
  thruster.acceleration /= share;
  return thruster;
}

/// Why burns of these lengths are in each other's way, or longer than the thruster may burn.
std::string BurnSearch::misplaced(const CanonicalThruster& thruster, const Changes& changes) const {
  const std::vector<BurnSpan> spans = flight_.spans(thruster, impulses_, changes);
  for (std::size_t k = 0; k < spans.size(); ++k) {
    if (k + 1 < spans.size() && spans[k].end > spans[k + 1].start) {
      return fmt::format(
          "burns {} and {} overlap: half of both takes {:.4g} s, {:.3g} times the {:.6g} s from "
          "impulse to impulse",
          k + 1, k + 2, seconds((spans[k].length() + spans[k + 1].length()) / 2),
          (spans[k].length() + spans[k + 1].length()) / 2 /
              (impulses_[k + 1].time - impulses_[k].time),
          seconds(impulses_[k + 1].time - impulses_[k].time));
    }
    const auto& longest = scene_.thruster->longest_burn_s;
    if (longest && seconds(spans[k].length()) > *longest) {
      return fmt::format("burn {} takes {:.4g} s, above longest_burn_s = {:.6g}", k + 1,
                         seconds(spans[k].length()), *longest);
    }
  }
  return "";
}

/// Newton's step, at most half of all changes. Of more burns than the six conditions need, it is
/// the least in parts of the burns' own sizes.
BurnSearch::Changes BurnSearch::step(const CanonicalThruster& thruster, const Changes& changes,
                                     const BurnFlight::Vector6& missing) {
  const double sum = sum_of(changes);
  Eigen::Matrix<double, 6, Eigen::Dynamic> rates =
      flight_.derivatives(thruster, impulses_, changes);
  Eigen::VectorXd weights(rates.cols());
  for (std::size_t k = 0; k < changes.size(); ++k) {
    weights.segment<3>(static_cast<Eigen::Index>(3 * k))
        .setConstant(std::max(changes[k].norm(), sum * 1e-3));
  }
  rates = (rates * weights.asDiagonal()).eval();
  Eigen::VectorXd parts;
  if (rates.cols() == 6) {
    parts = Eigen::Matrix<double, 6, 6>(rates).partialPivLu().solve(missing);
  } else {
    const Eigen::Matrix<double, 6, 6> normal = rates * rates.transpose();
    parts = rates.transpose() * normal.partialPivLu().solve(missing);
  }
  Eigen::VectorXd whole = weights.cwiseProduct(parts);
  if (const double most = sum / 2; whole.norm() > most) whole *= most / whole.norm();
  Changes result;
  for (std::size_t k = 0; k < changes.size(); ++k) {
    result.emplace_back(whole.segment<3>(static_cast<Eigen::Index>(3 * k)));
  }
  return result;
}

/// A miss in velocity counts as the place that it makes in the canonical unit of time.
BurnSearch::Attempt BurnSearch::attempt(const CanonicalThruster& thruster, Changes changes) {
  constexpr int most_flights = 16;
  const double most = scene_.transfer->refined_miss_m / flight_.units().length_m;
  Attempt result;
  try {
    for (int flights = 0; flights < most_flights; ++flights) {
      for (const BurnSpan& span : flight_.spans(thruster, impulses_, changes)) {
        if (span.length() <= 2 * duration_) continue;
        result.failure = fmt::format("a burn of {:.4g} s does not fit into {:.6g} s",
                                     seconds(span.length()), seconds(duration_));
        return result;
      }
      if (thruster.mass_after(sum_of(changes), 1) < least_share_of_mass) {
        result.failure = fmt::format(
            "burns of {:.4g} m/s would leave less than {} of the mass behind an exhaust of {:.4g} "
            "m/s",
            sum_of(changes) * flight_.units().velocity_m_s(), least_share_of_mass,
            *scene_.thruster->exhaust_m_s);
        return result;
      }
      ++flights_;
      result.missing = flight_.missing(thruster, impulses_, changes);
      const double miss =
          std::max(result.missing.head<3>().norm(), result.missing.tail<3>().norm());
      if (miss <= most) {
        result.failure = misplaced(thruster, changes);
        result.changes = std::move(changes);
        return result;
      }
      const Changes further = step(thruster, changes, result.missing);
      for (std::size_t k = 0; k < changes.size(); ++k) changes[k] += further[k];
      if (!std::isfinite(sum_of(changes))) {
        result.failure = "burns about these times do not command the end";
        return result;
      }
    }
    result.failure =
        fmt::format("no burns were found: the last of {} flights misses by {:.3g} m", most_flights,
                    result.missing.head<3>().norm() * flight_.units().length_m);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    result.failure = error.what();
  }
  return result;
}

std::string BurnSearch::forbidden(const BurnPlan& plan) const {
  const ThrusterSettings& thruster = *scene_.thruster;
  const std::optional<double> taken = plan.propellant_kg();
  if (taken && thruster.propellant_kg && *taken > *thruster.propellant_kg) {
    return fmt::format("the burns take {:.6g} kg, above propellant_kg = {:.6g}", *taken,
                       *thruster.propellant_kg);
  }
  for (std::size_t k = 0; k < plan.burns.size() && thruster.shortest_burn_s; ++k) {
    const double length_s = seconds(plan.burns[k].end - plan.burns[k].start);
    if (length_s >= *thruster.shortest_burn_s) continue;
    return fmt::format("burn {} takes {:.3g} s, below shortest_burn_s = {:.6g}", k + 1, length_s,
                       *thruster.shortest_burn_s);
  }
  return "";
}

BurnPlan BurnSearch::plan() {
  BurnPlan plan;
  const Attempt found = attempt(thruster_, from_);
  plan.flights = flights_;
  plan.failure = found.failure;
  is_too_weak_ = !found.failure.empty();
  if (found.changes.empty()) return plan;
  const MetricUnits& units = flight_.units();
  plan.miss_m = found.missing.head<3>().norm() * units.length_m;
  plan.velocity_miss_m_s = found.missing.tail<3>().norm() * units.velocity_m_s();
  const std::vector<BurnSpan> spans = flight_.spans(thruster_, impulses_, found.changes);
  for (std::size_t k = 0; k < spans.size(); ++k) {
    const double size = found.changes[k].norm();
    FiniteBurn burn;
    burn.time = impulses_[k].time;
    burn.start = spans[k].start;
    burn.end = spans[k].end;
    burn.direction = found.changes[k] / size;
    burn.change_m_s = size * units.velocity_m_s();
    burn.impulse_m_s = impulses_[k].change_m_s.norm();
    if (thruster_.mass_falls()) {
      const double full = scene_.thruster->mass_kg;
      burn.mass_after_kg = full * thruster_.mass_after(size, spans[k].mass);
      burn.propellant_kg = -full * spans[k].mass * std::expm1(-size / thruster_.exhaust);
    }
    plan.burns.push_back(burn);
  }
  if (plan.failure.empty()) plan.failure = forbidden(plan);
  return plan;
}

void BurnSearch::look_along(const BurnPlan& plan, double pace, const BurnFlight::Look& look) const {
  Changes changes;
  for (const FiniteBurn& burn : plan.burns) {
    changes.emplace_back(burn.direction * burn.change_m_s / flight_.units().velocity_m_s());
  }
  flight_.flown(thruster_, impulses_, changes, pace, look);
}

// Burns are followed from the impulses, which infinite acceleration makes, to ever weaker thrust.
std::optional<double> BurnSearch::least_acceleration_m_s2() {
  constexpr int most_attempts = 40;
  constexpr double resolution = 5e-3;
  double longest = 0;
  double narrowest = duration_;
  for (const BurnSpan& span : flight_.spans(thruster_, impulses_, from_)) {
    longest = std::max(longest, span.length());
  }
  for (std::size_t k = 1; k < impulses_.size(); ++k) {
    narrowest = std::min(narrowest, impulses_[k].time - impulses_[k - 1].time);
  }
  const auto& most = scene_.thruster->longest_burn_s;
  if (most) narrowest = std::min(narrowest, *most / scene_.units.time_s);
  double share = 0;
  double step = std::min(1.0, narrowest / longest) / 4;
  Changes changes = from_;
  for (int i = 0; i < most_attempts && share < 1 && step > resolution * share; ++i) {
    const double next = std::min(1.0, share + step);
    Attempt found = attempt(stronger(next), changes);
    if (found.failure.empty()) {
      changes = std::move(found.changes);
      share = next;
      step *= 1.5;
    } else {
      step /= 2;
    }
  }
  if (share == 0) return std::nullopt;
  return scene_.thruster->acceleration_m_s2 / share;
}

}  // namespace hamjet
