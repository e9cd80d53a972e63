#include "domain_evaluation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "../studies/formation/charts/deputy_flows.hpp"
#include "../studies/formation/validity/deputy_domains.hpp"
#include "../studies/formation_scale.hpp"
#include "../studies/stopwatch.hpp"
#include "hamjet/error.hpp"
#include "hamjet/maps/domain_splitting.hpp"

namespace hamjet::cli {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The estimate of a deputy of which nothing is known.
MissEstimate unknown_estimate() { return {TruncationEstimate::Support::unknown, infinite, 0, 0}; }

SixNumbers<double> difference(const SixNumbers<double>& a, const SixNumbers<double>& b) {
  SixNumbers<double> result = a;
  for (std::size_t i = 0; i < result.size(); ++i) result[i] -= b[i];
  return result;
}

}  // namespace

/// The splitting of one list of deputies.
class DomainEvaluation::Split {
 public:
  explicit Split(DomainEvaluation& owner)
      : owner_(owner),
        chief_(owner.scene_),
        tolerance_m_(chief_.split_scene->eval->tolerance_m),
        rate_(momentum_per_length(*chief_.split_scene)),
        axes_(ellipsoid_axes(chief_.chief.nominal_initial, RelativeFrame::rtn_rotating,
                             std::array<double, 3>{1, 1, 1}, rate_)),
        results_(owner.pending_.size()) {
    const Eigen::PartialPivLU<Matrix6> inverse(axes_);
    for (const SixNumbers<double>& deviation : owner.pending_) {
      const Vector6 told = inverse.solve(Eigen::Map<const Vector6>(deviation.data()));
      points_.emplace_back(told.begin(), told.end());
    }
  }

  std::vector<Result> run() {
    EvalDomains& told = owner_.domains_;
    told.tolerance_m = tolerance_m_;
    told.most = static_cast<std::size_t>(chief_.split_scene->eval->most_domains);
    const PointSplit split = split_points([&](const PointDomain& domain) { return assess(domain); },
                                          points_, std::vector<double>(6, 0.0),
                                          {.tolerance = tolerance_m_, .most_domains = told.most});
    told.count += split.domains.size();
    told.maps += split.maps_made;
    for (std::size_t i = 0; i < 6; ++i) told.splits[i] += split.splits[i];
    told.is_limited |= !split.is_right && split.domains.size() >= told.most;
    for (const PointDomain& domain : split.domains) {
      told.largest_miss_m = std::max(told.largest_miss_m, domain.error);
      if (told.domains.size() < EvalDomains::most_listed) told.domains.push_back(metric(domain));
    }
    for (Result& result : results_) {
      if (is_right(result.estimate)) continue;
      ++told.not_right;
      // Of a split nothing but the tolerance says what is inside.
      if (result.estimate.is_inside()) {
        result.estimate.support = TruncationEstimate::Support::outside;
      }
    }
    return std::move(results_);
  }

 private:
  bool is_right(const MissEstimate& estimate) const {
    return estimate.is_inside() && estimate.miss_m() <= tolerance_m_;
  }

  EvalDomain metric(const PointDomain& domain) const {
    const CanonicalUnits& units = chief_.chief.units;
    const double length_m = units.length_km * 1000;
    EvalDomain result;
    for (std::size_t i = 0; i < 6; ++i) {
      const double unit = i < 3 ? length_m : rate_ * length_m / units.time_s;
      result.centre[i] = domain.centre[i] * unit;
      result.half_widths[i] = domain.half_widths[i] * unit;
    }
    result.deputies = domain.points.size();
    result.miss_m = domain.error;
    return result;
  }

  /// Evaluates the points of a domain by polynomials about its centre; the first one's is the
  /// chief.
  PointAssessment assess(const PointDomain& domain) {
    if (owner_.pause_) owner_.pause_();
    const bool is_first = std::exchange(is_first_, false);
    if (is_first) return evaluate(domain, {}, chief_, owner_.about_chief_);
    const SixNumbers<double> centre = deviation_along(axes_, domain.centre);
    try {
      EvaluatedScene about;
      {
        const Stopwatch watch(owner_.domains_.seconds);
        about = evaluated_about(chief_, centre);
      }
      DeputyEvaluation evaluation(about, owner_.degree_, owner_.threads_);
      return evaluate(domain, centre, about, evaluation);
    } catch (const Error& error) {
      // An orbit through the centre that cannot be flown, or has no such coordinates.
      if (error.kind() != ErrorKind::numerical) throw;
      for (const std::size_t k : domain.points) {
        results_[k] = {std::vector<double>(6, std::numeric_limits<double>::quiet_NaN()),
                       unknown_estimate()};
      }
      return {infinite, domain.half_widths};
    }
  }

  PointAssessment evaluate(const PointDomain& domain, const SixNumbers<double>& centre,
                           const EvaluatedScene& about, DeputyEvaluation& evaluation) {
    const bool is_chief = &about == &chief_;
    const double length_m = chief_.chief.units.length_km * 1000;
    PointAssessment found;
    std::vector<std::size_t> improvable;
    std::size_t done = 0;
    const double before = evaluation.seconds();
    const double charts_before = evaluation.chart_seconds();
    const double work_before = evaluation.multiply_adds();
    const auto take = [&](const std::vector<double>& deviation, MissEstimate estimate) {
      const std::size_t k = domain.points[done++];
      if (!is_chief) {
        // What the two orbits are wrong by is not of both.
        estimate.rounding_m = std::hypot(estimate.rounding_m, chief_.rounding_m);
        estimate.integration_m += (about.error.of_chief() + chief_.error.of_chief()) * length_m;
      }
      results_[k] = {deviation, estimate};
      found.error = std::max(found.error, estimate.is_inside() ? estimate.miss_m() : infinite);
      const double least = estimate.rounding_m + (is_chief ? 0 : estimate.integration_m);
      if (!is_right(estimate) && least <= tolerance_m_) improvable.push_back(k);
    };
    for (const std::size_t k : domain.points) {
      const SixNumbers<double> deviation = difference(owner_.pending_[k], centre);
      evaluation.add({deviation.begin(), deviation.end()});
      if (evaluation.pending() == DeputyEvaluation::most_points) evaluation.run(take);
    }
    if (evaluation.pending() > 0) evaluation.run(take);
    owner_.seconds_ += evaluation.seconds() - before;
    owner_.chart_seconds_ += evaluation.chart_seconds() - charts_before;
    owner_.multiply_adds_ += evaluation.multiply_adds() - work_before;
    found.weights = domain_weights(*about.flow, owner_.degree_, axes_, domain, points_, improvable);
    return found;
  }

  DomainEvaluation& owner_;
  const EvaluatedScene& chief_;
  double tolerance_m_;
  double rate_;  ///< velocities are told as lengths times this
  Matrix6 axes_;
  std::vector<std::vector<double>> points_;  ///< along the axes, canonical lengths
  std::vector<Result> results_;              ///< of the last domain that a point was in
  bool is_first_ = true;
};

DomainEvaluation::DomainEvaluation(const EvaluatedScene& scene, int degree, std::size_t threads,
                                   std::function<void()> pause)
    : scene_(scene),
      degree_(degree),
      threads_(threads),
      pause_(std::move(pause)),
      about_chief_(scene, degree, threads) {
  if (degree < 2) {
    throw Error(ErrorKind::usage,
                "degree 1: has no estimate by which deputies could be split into domains, must be "
                "2 or more beside [eval]");
  }
}

void DomainEvaluation::add(const std::vector<double>& deviation) {
  pending_.push_back(six_numbers(deviation));
}

void DomainEvaluation::run(
    const std::function<void(const std::vector<double>&, const MissEstimate&)>& take) {
  if (pending_.empty()) return;
  for (const Result& result : Split(*this).run()) take(result.deviation, result.estimate);
  pending_.clear();
}

}  // namespace hamjet::cli
