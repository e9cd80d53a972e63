#include "hamjet/studies/validity.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "exact_flow.hpp"
#include "formation_problem.hpp"
#include "formation_scale.hpp"
#include "hamjet/algebra/monomial_values.hpp"
#include "hamjet/error.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "jets_along_time.hpp"
#include "random_direction.hpp"
#include "single_transfer.hpp"
#include "stopwatch.hpp"

namespace hamjet {
namespace {

/// Separations tried, in canonical units of length: beyond the first no orbit is near.
constexpr double largest_separation = 0.5;
constexpr double smallest_separation = 1e-12;

/// One study at work.
class ValidityStudy {
 public:
  ValidityStudy(const Scene& scene, const ProgressCallback& progress)
      : scene_(scene),
        settings_(*scene.validity),
        progress_(progress),
        problem_(make_problem(scene, available_memory())),
        metres_(metric_units(scene).length_m),
        tolerance_(settings_.tolerance_m / metres_),
        values_(problem_.space) {
    result_.scene = scene;
    make_samples();
  }

  ValidityResult run() {
    const IntegratorSettings& integrator = symplectic_integrator(scene_);
    result_.integrator = integrator.label;
    const auto statistics =
        visit_jets(problem_, integrator, settings_.times,
                   [&](std::size_t index, const FlowJet<double>& jet) { visit(index, jet); });
    result_.propagation_seconds = statistics.wall_seconds;
    return std::move(result_);
  }

 private:
  /// Deviations of separation 1: on the surface of the ellipsoid in position, and of its like in
  /// velocity.
  void make_samples() {
    // Unit vectors along R, T, N, for a ChiefFrame without units.
    const ChiefFrame frame(problem_.nominal, MetricUnits{}, RelativeFrame::rtn_inertial);
    const double velocity = momentum_per_length(scene_);
    std::mt19937_64 generator(1);
    for (int k = 0; k < settings_.samples; ++k) {
      RelativeState state;
      const auto position = random_direction(generator, 3);
      const auto rate = random_direction(generator, 3);
      for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = static_cast<Eigen::Index>(i);
        state.position_m[axis] = settings_.semi_axes[i] * position[i];
        state.velocity_m_s[axis] = settings_.semi_axes[i] * velocity * rate[i];
      }
      samples_.push_back(frame.deviation(state));
    }
  }

  void visit(std::size_t index, const FlowJet<double>& jet) {
    time_ = settings_.times[index];
    ValidityPoint point;
    point.time = time_;
    const std::vector<double> sizes = slice_sizes(jet);
    for (int order = 1; order <= scene_.order; ++order) {
      if (progress_) {
        const double share = static_cast<double>(order - 1) / scene_.order;
        progress_("validity", (static_cast<double>(index) + share) /
                                  static_cast<double>(settings_.times.size()));
      }
      ValidityEntry entry;
      entry.order = order;
      const double next = sizes[static_cast<std::size_t>(order + 1)];
      const double predicted =
          next > 0 ? std::pow(tolerance_ / next, 1.0 / (order + 1)) : largest_separation;
      entry.predicted_m = std::min(predicted, largest_separation) * metres_;
      const Stopwatch watch(result_.proof_seconds);
      prove(jet, std::min(predicted, largest_separation), entry);
      point.entries.push_back(entry);
    }
    if (index + 1 == settings_.times.size()) {
      const std::vector<double> flown = exact_flow(problem_.system, problem_.nominal, time_);
      result_.flight_floor_m =
          std::hypot(flown[0] - jet[0][0], flown[1] - jet[1][0], flown[2] - jet[2][0]) * metres_;
    }
    result_.points.push_back(std::move(point));
  }

  /// The largest position of each degree's part over the samples, degree N + 1 extrapolated.
  std::vector<double> slice_sizes(const FlowJet<double>& jet) {
    std::vector<double> sizes(static_cast<std::size_t>(scene_.order) + 2, 0);
    for (const auto& sample : samples_) {
      values_.set_point(sample);
      for (int d = 1; d <= scene_.order; ++d) {
        const double size = std::hypot(values_.slice(jet[0], d), values_.slice(jet[1], d),
                                       values_.slice(jet[2], d));
        sizes[static_cast<std::size_t>(d)] = std::max(sizes[static_cast<std::size_t>(d)], size);
      }
    }
    const std::size_t last = sizes.size() - 2;
    // With the one degree of order 1 there is no ratio: a size per unit of length of 1.
    const double ratio = last >= 2 && sizes[last - 1] > 0 ? sizes[last] / sizes[last - 1] : 1;
    sizes[last + 1] = sizes[last] * ratio;
    return sizes;
  }

  /// The largest miss over the samples at a separation; infinite if a deputy cannot be flown.
  double miss(const FlowJet<double>& jet, int order, double separation) {
    double largest = 0;
    for (const auto& sample : samples_) {
      if (progress_)
        progress_("validity", static_cast<double>(result_.points.size()) /
                                  static_cast<double>(settings_.times.size()));
      std::vector<double> deviation = sample;
      std::vector<double> deputy = problem_.nominal;
      for (std::size_t i = 0; i < deviation.size(); ++i) {
        deviation[i] *= separation;
        deputy[i] += deviation[i];
      }
      ++result_.flights;
      std::vector<double> flown;
      try {
        flown = exact_flow(problem_.system, deputy, time_);
      } catch (const Error& error) {
        if (error.kind() != ErrorKind::numerical) throw;
        return std::numeric_limits<double>::infinity();
      }
      values_.set_point(deviation);
      double square = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const double difference = values_.value(jet[i], order) - flown[i];
        square += difference * difference;
      }
      largest = std::max(largest, std::sqrt(square));
      if (largest > hopeless * tolerance_) return largest;
    }
    return largest;
  }

  /// The miss grows as the separation to the power order + 1: from the prediction on, the next
  /// separation tried is the one at which that law meets the tolerance, until the largest that
  /// holds is known to a few percent.
  void prove(const FlowJet<double>& jet, double predicted, ValidityEntry& entry) {
    constexpr int most_trials = 12;
    constexpr double close = 1.03;
    double good = 0;
    double bad = 0;
    double trial = predicted;
    for (int k = 0; k < most_trials; ++k) {
      const double found = miss(jet, entry.order, trial);
      if (found <= tolerance_) {
        good = trial;
        entry.miss_m = found * metres_;
        if (trial >= largest_separation) {
          entry.is_at_limit = true;
          break;
        }
      } else {
        bad = trial;
      }
      if (bad > 0 && good > 0 && bad < close * good) break;
      double factor = found > 0 ? std::pow(tolerance_ / found, 1.0 / (entry.order + 1)) : 2;
      factor = std::clamp(factor, 0.1, 2.0);
      // A little to the other side, so that the two come together.
      trial *= factor * (found <= tolerance_ ? 1.01 : 0.99);
      if (good > 0 && bad > 0 && !(trial > good && trial < bad)) trial = std::sqrt(good * bad);
      trial = std::min(trial, largest_separation);
      if (trial < smallest_separation) break;
    }
    entry.proved_m = good * metres_;
  }

  /// A miss this many times the tolerance needs no more samples.
  static constexpr double hopeless = 1e3;

  const Scene& scene_;
  const ValiditySettings& settings_;
  const ProgressCallback& progress_;
  ComputedProblem problem_;
  double metres_;
  double tolerance_;  ///< canonical
  MonomialValues values_;
  std::vector<std::vector<double>> samples_;
  double time_ = 0;
  ValidityResult result_;
};

}  // namespace

ValidityResult study_validity(const Scene& scene, const ProgressCallback& progress) {
  require_formation_problem(scene, scene.validity.has_value(), "validity");
  return ValidityStudy(scene, progress).run();
}

}  // namespace hamjet
