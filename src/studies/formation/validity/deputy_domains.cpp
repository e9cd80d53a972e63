#include "deputy_domains.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "../../exact_flow.hpp"
#include "../../formation_scale.hpp"
#include "../charts/deputy_flows.hpp"
#include "../formation_problem.hpp"
#include "../single_transfer.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// The splitting of one set.
class SplitValidity {
 public:
  SplitValidity(const Scene& scene, const CoordinatesAtEnds& coordinates,
                const ProgressCallback& progress)
      : scene_(scene),
        coordinates_(coordinates),
        progress_(progress),
        problem_(make_problem(scene)),
        time_(scene.validity->times.back()),
        metres_(metric_units(scene).length_m),
        axes_(ellipsoid_axes(problem_.nominal, scene.validity->frame, scene.validity->semi_axes,
                             momentum_per_length(scene), metric_units(scene).velocities)) {
    const double separation = *scene.validity->separation_m / metres_;
    const int count = points_per_sample * scene.validity->samples;
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int k = 0; k < count; ++k) {
      Vector6 point = separation * random_coordinates(generator);
      const double place = uniform(generator);
      const double speed = uniform(generator);
      if (k % 2 == 1) {
        // Uniform in the volumes.
        point.head<3>() *= std::cbrt(place);
        point.tail<3>() *= std::cbrt(speed);
      }
      points_.emplace_back(point.begin(), point.end());
    }
  }

  ValidityDomains run() {
    fly();
    misses_.resize(points_.size());
    const PointSplit split =
        split_points([&](const PointDomain& domain) { return assess(domain); }, points_,
                     std::vector<double>(6, 0.0),
                     {.tolerance = scene_.validity->tolerance_m,
                      .most_domains = static_cast<std::size_t>(scene_.validity->most_domains)});
    ValidityDomains result;
    result.separation_m = *scene_.validity->separation_m;
    result.deputies = points_.size();
    result.maps = split.maps_made;
    const auto most = std::max_element(split.splits.begin(), split.splits.end());
    if (*most > 0) {
      result.split_across = component_names(
          scene_.validity->frame)[static_cast<std::size_t>(most - split.splits.begin())];
    }
    const ChiefFrame frame(problem_.nominal, metric_units(scene_), scene_.validity->frame);
    for (const PointDomain& domain : split.domains) {
      const SixNumbers<double> centre = deviation_along(axes_, domain.centre);
      result.parts.push_back(
          {frame.relative({centre.begin(), centre.end()}), domain.points.size(), domain.error});
    }
    for (const double miss : misses_) {
      result.miss_m = std::max(result.miss_m, miss);
      if (!(miss <= scene_.validity->tolerance_m)) ++result.not_right;
    }
    return result;
  }

 private:
  static constexpr int points_per_sample = 25;

  void fly() {
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (progress_) {
        progress_("domains", static_cast<double>(k) / static_cast<double>(points_.size()));
      }
      std::vector<double> deputy = problem_.nominal;
      const SixNumbers<double> start = deviation_along(axes_, points_[k]);
      for (std::size_t i = 0; i < 6; ++i) deputy[i] += start[i];
      try {
        ends_.push_back(exact_flow(problem_.system, deputy, problem_.start_time, time_));
      } catch (const Error& error) {
        if (error.kind() != ErrorKind::numerical) throw;
        ends_.emplace_back(6, std::numeric_limits<double>::quiet_NaN());
      }
    }
  }

  PointAssessment assess(const PointDomain& domain) {
    if (progress_) progress_("domains", 1);
    Scene about = scene_;
    const SixNumbers<double> moved = deviation_along(axes_, domain.centre);
    for (std::size_t i = 0; i < 6; ++i) about.nominal[i] += moved[i];
    std::unique_ptr<DeputyFlow> flow;
    try {
      const ComputedProblem problem = make_problem(about);
      flow = DeputyFlowPropagation(about, problem, symplectic_integrator(about), coordinates_)
                 .advance_to(time_);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      for (const std::size_t k : domain.points) misses_[k] = unbounded;
      return {unbounded, domain.half_widths};
    }
    PointAssessment found;
    std::vector<std::size_t> wrong;
    DeputyPredictor predictor(*flow);
    for (const std::size_t k : domain.points) {
      const SixNumbers<double> end =
          predictor.predict(deviation_along(axes_, points_[k], domain.centre), scene_.order)
              .deviation;
      double squares = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        squares += std::pow(flow->chief_end()[i] + end[i] - ends_[k][i], 2);
      }
      const double miss = std::sqrt(squares) * metres_;
      misses_[k] = std::isfinite(miss) ? miss : unbounded;
      found.error = std::max(found.error, misses_[k]);
      if (!(misses_[k] <= scene_.validity->tolerance_m)) wrong.push_back(k);
    }
    found.weights = domain_weights(*flow, scene_.order, axes_, domain, points_, wrong);
    return found;
  }

  const Scene& scene_;
  const CoordinatesAtEnds& coordinates_;
  const ProgressCallback& progress_;
  ComputedProblem problem_;
  double time_;
  double metres_;
  Matrix6 axes_;
  std::vector<std::vector<double>> points_;  ///< along the axes
  std::vector<std::vector<double>> ends_;    ///< flown
  std::vector<double> misses_;               ///< by the last domain that a deputy was in
};

}  // namespace

SixNumbers<double> deviation_along(const Matrix6& axes, const std::vector<double>& point,
                                   const std::vector<double>& centre) {
  const Vector6 z =
      axes * (Eigen::Map<const Vector6>(point.data()) - Eigen::Map<const Vector6>(centre.data()));
  return {z[0], z[1], z[2], z[3], z[4], z[5]};
}

std::vector<double> domain_weights(const DeputyFlow& flow, int degree, const Matrix6& axes,
                                   const PointDomain& domain,
                                   std::span<const std::vector<double>> points,
                                   std::span<const std::size_t> chosen) {
  constexpr std::size_t most = 64;  // points that are looked at
  constexpr double step = 1.0 / 64;
  std::vector<double> result(6, 0.0);
  if (chosen.empty()) return result;
  DeputyPredictor predictor(flow);
  const auto added = [&](const std::vector<double>& point) {
    const auto highest =
        predictor.predict(deviation_along(axes, point, domain.centre), degree).highest[0];
    return std::hypot(highest[0], highest[1], highest[2]);
  };
  const std::size_t stride = (chosen.size() + most - 1) / most;
  for (std::size_t j = 0; j < chosen.size(); j += stride) {
    const std::vector<double>& point = points[chosen[j]];
    const double whole = added(point);
    for (std::size_t i = 0; i < 6; ++i) {
      std::vector<double> nearer = point;
      nearer[i] -= step * (point[i] - domain.centre[i]);
      result[i] += (whole - added(nearer)) / step;
    }
  }
  const bool is_known = std::all_of(result.begin(), result.end(),
                                    [](double weight) { return std::isfinite(weight); });
  if (!is_known || *std::max_element(result.begin(), result.end()) <= 0) return domain.half_widths;
  return result;
}

void set_validity_domains(ValidityResult& result, const ProgressCallback& progress) {
  if (!result.scene.validity->separation_m) return;
  result.domains = SplitValidity(result.scene, result.coordinates, progress).run();
  result.flights += static_cast<long>(result.domains->deputies);
}

}  // namespace hamjet
