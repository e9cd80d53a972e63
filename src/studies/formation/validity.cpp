#include "hamjet/studies/validity.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "../../integrators/momentum_unit.hpp"
#include "../exact_flow.hpp"
#include "../formation_scale.hpp"
#include "../random_direction.hpp"
#include "../stopwatch.hpp"
#include "deputy_flows.hpp"
#include "formation_problem.hpp"
#include "hamjet/detail/algebra/monomial_values.hpp"
#include "hamjet/error.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "single_transfer.hpp"

namespace hamjet {
namespace {

/// The separations tried, relative to the chief's distance at the start; beyond the largest no
/// orbit is near.
constexpr double largest_separation = 0.5;
constexpr double smallest_separation = 1e-12;

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// One study at work.
class ValidityStudy {
 public:
  ValidityStudy(const Scene& scene, const ProgressCallback& progress)
      : scene_(scene),
        settings_(*scene.validity),
        progress_(progress),
        problem_(make_problem(scene, available_memory())),
        metres_(metric_units(scene).length_m),
        distance_(initial_distance(problem_.nominal)),
        largest_separation_(largest_separation * distance_),
        tolerance_(settings_.tolerance_m / metres_) {
    result_.scene = scene;
    make_samples();
  }

  ValidityResult run(const CoordinatesAtEnds& coordinates) {
    const IntegratorSettings& integrator = symplectic_integrator(scene_);
    result_.integrator = integrator.label;
    result_.coordinates = coordinates;
    DeputyFlowPropagation propagation(scene_, problem_, integrator, coordinates);
    for (std::size_t index = 0; index < settings_.times.size(); ++index) {
      time_ = settings_.times[index];
      std::unique_ptr<DeputyFlow> flow;
      {
        const Stopwatch watch(result_.propagation_seconds);
        flow = propagation.advance_to(time_);
      }
      visit(index, *flow);
    }
    return std::move(result_);
  }

 private:
  /// Makes deviations of separation 1: on the surface of the ellipsoid in position, and on that of
  /// the same ellipsoid in velocity.
  void make_samples() {
    // Columns: the canonical deviations of unit coordinates, three of position and three of
    // velocity, each triple of length 1 on the surface of the ellipsoid. In a rotating frame the
    // deviations of position have a velocity too.
    const ChiefFrame frame(problem_.nominal, MetricUnits{}, settings_.frame);
    const double velocity = momentum_per_length(scene_);
    for (std::size_t i = 0; i < 6; ++i) {
      RelativeState state;
      const auto axis = static_cast<Eigen::Index>(i % 3);
      (i < 3 ? state.position_m : state.velocity_m_s)[axis] =
          settings_.semi_axes[i % 3] * (i < 3 ? 1 : velocity);
      const std::vector<double> deviation = frame.deviation(state);
      for (std::size_t k = 0; k < 6; ++k) {
        axes_(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) = deviation[k];
      }
    }
    std::mt19937_64 generator(1);
    for (int k = 0; k < settings_.samples; ++k) {
      Vector6 coordinates;
      for (Eigen::Index first : {Eigen::Index{0}, Eigen::Index{3}}) {
        const auto direction = random_direction(generator, 3);
        for (Eigen::Index i = 0; i < 3; ++i) {
          coordinates[first + i] = direction[static_cast<std::size_t>(i)];
        }
      }
      samples_.push_back(coordinates);
    }
  }

  SixNumbers<double> deviation(const Vector6& coordinates) const {
    const Vector6 z = axes_ * coordinates;
    return {z[0], z[1], z[2], z[3], z[4], z[5]};
  }

  /// What the degrees of the polynomials add to the final position, to first order in the
  /// coordinates at both ends: three series, and the variables of a sample.
  void linearise_ends(const DeputyFlow& flow) {
    const Matrix<double> exit = flow.exit_derivative();
    positions_.clear();
    for (Eigen::Index i = 0; i < 3; ++i) {
      Series<double> position(flow.polynomials()[0].space_pointer());
      for (std::size_t c = 0; c < flow.polynomials().size(); ++c) {
        position += exit(i, static_cast<Eigen::Index>(c)) * flow.polynomials()[c];
      }
      positions_.push_back(std::move(position));
    }
    variables_ = flow.entry_derivative() * axes_;
    values_.emplace(flow.polynomials()[0].space_pointer());
  }

  void set_point(const Vector6& coordinates) {
    const Matrix<double> point = variables_ * coordinates;
    values_->set_point({point.data(), static_cast<std::size_t>(point.size())});
  }

  /// Size of one degree's part of the position at a sample.
  double slice_size(const Vector6& coordinates, int degree) {
    set_point(coordinates);
    return std::hypot(values_->slice(positions_[0], degree), values_->slice(positions_[1], degree),
                      values_->slice(positions_[2], degree));
  }

  /// Ascent from a sample to a deviation at which the part of one degree is largest: the next point
  /// is the gradient's direction, in position and in velocity apart. Random samples alone come out
  /// at half of the worst.
  Vector6 worst_from(Vector6 point, int degree) {
    constexpr int most_iterations = 30;
    double size = slice_size(point, degree);
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      set_point(point);
      Matrix<double> by_variable = Matrix<double>::Zero(variables_.rows(), 1);
      for (const Series<double>& position : positions_) {
        const double value = values_->slice(position, degree);
        for (Eigen::Index v = 0; v < variables_.rows(); ++v) {
          const auto variable = static_cast<std::size_t>(v);
          by_variable(v, 0) += value * (values_->derivative(position, variable, degree) -
                                        values_->derivative(position, variable, degree - 1));
        }
      }
      const Vector6 gradient = variables_.transpose() * by_variable;
      Vector6 next = point;
      for (Eigen::Index first : {Eigen::Index{0}, Eigen::Index{3}}) {
        const double length = gradient.segment<3>(first).norm();
        if (length > 0) next.segment<3>(first) = gradient.segment<3>(first) / length;
      }
      const double found = slice_size(next, degree);
      if (!(found > size * (1 + 1e-6))) break;
      size = found;
      point = next;
    }
    return point;
  }

  /// The samples, and the worst deviations of one degree that are reached from the largest of them.
  std::vector<Vector6> samples_with_worst(int degree) {
    constexpr std::size_t starts = 6;
    std::vector<Vector6> samples = samples_;
    std::vector<std::pair<double, std::size_t>> sizes;
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      sizes.emplace_back(slice_size(samples_[k], degree), k);
    }
    std::sort(sizes.rbegin(), sizes.rend());
    for (std::size_t k = 0; k < std::min(starts, sizes.size()); ++k) {
      samples.push_back(worst_from(samples_[sizes[k].second], degree));
    }
    // The worst samples come first: a deputy that misses by far ends the trial.
    std::rotate(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(samples_.size()),
                samples.end());
    return samples;
  }

  void visit(std::size_t index, const DeputyFlow& flow) {
    ValidityPoint point;
    point.time = time_;
    linearise_ends(flow);
    const std::vector<double> sizes = slice_sizes();
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
          next > 0 ? std::pow(tolerance_ / next, 1.0 / (order + 1)) : largest_separation_;
      entry.predicted_m = std::min(predicted, largest_separation_) * metres_;
      const Stopwatch watch(result_.proof_seconds);
      // The worst deviations for an order's error are those of the next degree, or of the last one
      // known.
      flown_samples_ = samples_with_worst(std::min(order + 1, scene_.order));
      prove(flow, std::min(predicted, largest_separation_), entry);
      point.entries.push_back(entry);
    }
    if (index + 1 == settings_.times.size()) {
      result_.flight_floor_m = rounding_of_flights(problem_, time_) * metres_;
    }
    result_.points.push_back(std::move(point));
  }

  /// The largest size of each degree's part of the position; degree N + 1 is extrapolated.
  std::vector<double> slice_sizes() {
    std::vector<double> sizes(static_cast<std::size_t>(scene_.order) + 2, 0);
    for (int d = 1; d <= scene_.order; ++d) {
      for (const Vector6& sample : samples_with_worst(d)) {
        double& size = sizes[static_cast<std::size_t>(d)];
        size = std::max(size, slice_size(sample, d));
      }
    }
    const std::size_t last = sizes.size() - 2;
    // Order 1 has one degree and no ratio; 1 over the chief's distance is taken for it.
    const double ratio =
        last >= 2 && sizes[last - 1] > 0 ? sizes[last] / sizes[last - 1] : 1 / distance_;
    sizes[last + 1] = sizes[last] * ratio;
    return sizes;
  }

  /// The largest miss over the samples at a separation; infinite if a deputy cannot be flown.
  double miss(const DeputyFlow& flow, int order, double separation) {
    double largest = 0;
    for (const Vector6& sample : flown_samples_) {
      if (progress_) {
        progress_("validity", static_cast<double>(result_.points.size()) /
                                  static_cast<double>(settings_.times.size()));
      }
      const SixNumbers<double> start = deviation(separation * sample);
      std::vector<double> deputy = problem_.nominal;
      for (std::size_t k = 0; k < start.size(); ++k) deputy[k] += start[k];
      ++result_.flights;
      std::vector<double> flown;
      try {
        flown = exact_flow(problem_.system, deputy, time_);
      } catch (const Error& error) {
        if (error.kind() != ErrorKind::numerical) throw;
        return std::numeric_limits<double>::infinity();
      }
      const SixNumbers<double> predicted = flow.predict(start, order).deviation;
      double square = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const double difference = flow.chief_end()[i] + predicted[i] - flown[i];
        square += difference * difference;
      }
      if (!std::isfinite(square)) return std::numeric_limits<double>::infinity();
      largest = std::max(largest, std::sqrt(square));
      if (largest > hopeless * tolerance_) return largest;
    }
    return largest;
  }

  /// The miss grows as the separation to the power order + 1: from the prediction on, the next
  /// separation tried is the one at which that law meets the tolerance, until the largest that
  /// holds is known to a few percent.
  void prove(const DeputyFlow& flow, double predicted, ValidityEntry& entry) {
    constexpr int most_trials = 12;
    constexpr double close = 1.03;
    double good = 0;
    double bad = 0;
    double trial = predicted;
    for (int k = 0; k < most_trials; ++k) {
      const double found = miss(flow, entry.order, trial);
      if (found <= tolerance_) {
        good = trial;
        entry.miss_m = found * metres_;
        if (trial >= largest_separation_) {
          entry.is_at_limit = true;
          break;
        }
      } else {
        bad = trial;
      }
      if (bad > 0 && good > 0 && bad < close * good) break;
      double factor = found > 0 ? std::pow(tolerance_ / found, 1.0 / (entry.order + 1)) : 2;
      factor = std::clamp(factor, 0.1, 2.0);
      // The next trial is a little to the other side, so that the two bounds come together.
      trial *= factor * (found <= tolerance_ ? 1.01 : 0.99);
      if (good > 0 && bad > 0 && !(trial > good && trial < bad)) trial = std::sqrt(good * bad);
      trial = std::min(trial, largest_separation_);
      if (trial < smallest_separation * distance_) break;
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
  double distance_;                        ///< of the chief at the start, canonical
  double largest_separation_;              ///< canonical
  double tolerance_;                       ///< canonical
  Matrix6 axes_;                           ///< see make_samples
  std::vector<Series<double>> positions_;  ///< see linearise_ends
  Matrix<double> variables_;
  std::optional<MonomialValues> values_;
  std::vector<Vector6> samples_;        ///< of separation 1
  std::vector<Vector6> flown_samples_;  ///< those that one order is proved on
  double time_ = 0;
  ValidityResult result_;
};

}  // namespace

ValidityResult study_validity(const Scene& scene, const ProgressCallback& progress) {
  require_formation_problem(scene, scene.validity.has_value(), "validity");
  if (scene.coordinates != JetCoordinates::automatic) {
    return ValidityStudy(scene, progress).run(scene.coordinates);
  }
  return study_validity_in_all(scene, progress).furthest();
}

ValidityInCoordinates study_validity_in_all(const Scene& scene, const ProgressCallback& progress) {
  require_formation_problem(scene, scene.validity.has_value(), "validity");
  ValidityInCoordinates all;
  for (const JetCoordinates coordinates : measured_coordinates) {
    try {
      all.results.push_back(ValidityStudy(scene, progress).run(coordinates));
    } catch (const Error& error) {
      // An orbit may lack some coordinates, and a method may not serve for some; those in which the
      // orbit was given, it has.
      const bool is_lack = error.kind() == ErrorKind::numerical || error.kind() == ErrorKind::scene;
      if (!is_lack || coordinates == JetCoordinates::cartesian) throw;
      all.refused.push_back({coordinates, error.what()});
    }
  }
  return all;
}

CoordinatesAtEnds measured_coordinates_of(const Scene& scene) {
  if (scene.coordinates != JetCoordinates::automatic) return scene.coordinates;
  constexpr int few_samples = 10;
  Scene measured = scene;
  measured.validity = scene.validity.value_or(ValiditySettings{});
  measured.validity->times = {scene.duration};
  measured.validity->samples = few_samples;
  return study_validity(measured).coordinates;
}

const ValidityResult& ValidityInCoordinates::furthest() const {
  return *std::max_element(results.begin(), results.end(), [](const auto& a, const auto& b) {
    return a.points.back().entries.back().proved_m < b.points.back().entries.back().proved_m;
  });
}

}  // namespace hamjet
