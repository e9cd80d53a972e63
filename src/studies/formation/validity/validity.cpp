#include "hamjet/studies/validity.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>

#include "../../../dynamics/frozen_system.hpp"
#include "../../../integrators/momentum_unit.hpp"
#include "../../checks/flight_checks.hpp"
#include "../../formation_scale.hpp"
#include "../../stopwatch.hpp"
#include "../charts/deputy_flows.hpp"
#include "../charts/free_coordinates.hpp"
#include "../formation_problem.hpp"
#include "../single_transfer.hpp"
#include "deputy_domains.hpp"
#include "deputy_rounding.hpp"
#include "flown_deputies.hpp"
#include "hamjet/error.hpp"
#include "limiting_coordinates.hpp"
#include "reach_search.hpp"
#include "slice_maxima.hpp"

namespace hamjet {
namespace {

/// The separations that are tried, relative to the chief's distance at the start; beyond the
/// largest no orbit counts as near.
constexpr double largest_separation = 0.5;
constexpr double smallest_separation = 1e-12;

/// The scene with the degrees that foretell what each of its orders neglects, and where most. The
/// orders that take longer to expand than to fly deputies do without.
Scene with_further_degrees(Scene scene) {
  constexpr int further = 2;
  constexpr int highest = 8;
  scene.order = std::max(scene.order, std::min(scene.order + further, highest));
  return scene;
}

/// One study in progress.
class ValidityStudy {
 public:
  ValidityStudy(const Scene& scene, const ProgressCallback& progress)
      : scene_(scene),
        settings_(*scene.validity),
        progress_(progress),
        deeper_(with_further_degrees(scene)),
        problem_(make_problem(deeper_)),
        own_problem_(make_problem(scene)),
        metres_(metric_units(scene).length_m),
        distance_(size_of_nominal(scene)),
        largest_separation_(largest_separation * distance_),
        tolerance_(settings_.tolerance_m / metres_) {
    result_.scene = scene;
    make_samples();
  }

  ValidityResult run(const CoordinatesAtEnds& coordinates) {
    const IntegratorSettings& integrator = symplectic_integrator(scene_);
    result_.integrator = integrator.label;
    result_.coordinates = coordinates;
    const auto of_own_order = [&] {
      return DeputyFlowPropagation(scene_, own_problem_, integrator, coordinates);
    };
    DeputyFlowPropagation propagation(deeper_, problem_, integrator, coordinates);
    DeputyFlowPropagation on_the_way = of_own_order();
    for (std::size_t index = 0; index < settings_.times.size(); ++index) {
      time_ = settings_.times[index];
      std::unique_ptr<DeputyFlow> flow;
      std::unique_ptr<DeputyFlow> own;
      {
        const Stopwatch watch(result_.propagation_seconds);
        flow = propagation.advance_to(time_);
        // At the last time the polynomials are those that a run makes, in one integration.
        const bool is_last = index + 1 == settings_.times.size();
        own = is_last ? of_own_order().advance_to(time_) : on_the_way.advance_to(time_);
      }
      visit(index, propagation, *flow, *own);
    }
    return std::move(result_);
  }

 private:
  /// Makes deviations of separation 1. Their positions lie on the surface of the ellipsoid, and
  /// their velocities on that of the same ellipsoid in velocity.
  void make_samples() {
    axes_ = ellipsoid_axes(problem_.nominal, settings_.frame, settings_.semi_axes,
                           momentum_per_length(scene_), metric_units(scene_).velocities);
    std::mt19937_64 generator(1);
    for (int k = 0; k < settings_.samples; ++k) {
      samples_.push_back(told(random_coordinates(generator)));
    }
    // Polynomials in elements may be exact for every bound orbit. They fail only where a deputy
    // escapes or falls, which is found along the energy alone.
    const Vector6 energy = direction_of_energy(*frozen_at(problem_.system, problem_.start_time),
                                               problem_.nominal, axes_);
    samples_.push_back(energy);
    samples_.push_back(-energy);
  }

  /// The direction without coordinates that move freely, which the ellipsoid does not have.
  Vector6 told(const Vector6& direction) const {
    return in_told_directions(direction, told_coordinates(scene_.system));
  }

  void visit(std::size_t index, const DeputyFlowPropagation& propagation, const DeputyFlow& flow,
             const DeputyFlow& own) {
    ValidityPoint point;
    point.time = time_;
    SliceMaxima slices(flow, axes_);
    const int known =
        std::min(scene_.order + 1, flow.order());  // the highest degree that is looked at
    std::vector<std::vector<Vector6>> worst_of_degrees(static_cast<std::size_t>(known) + 1);
    for (int d = 1; d <= known; ++d) {
      worst_of_degrees[static_cast<std::size_t>(d)] = slices.maxima_and(samples_, d);
    }
    const DeputyRounding rounding(problem_, time_, largest_separation_);
    result_.flight_floor_m = rounding.at(0) * metres_;
    const LimitCoordinates names =
        limit_coordinates(propagation, flow, settings_.frame, scene_.system);
    const std::vector<double> sizes = slice_sizes(slices, worst_of_degrees);
    double share = 0;  // fraction of the time's orders that are done
    FlownDeputies deputies(problem_, axes_, time_, flow, &own, [&] {
      ++result_.flights;
      if (!progress_) return;
      progress_("validity",
                (static_cast<double>(index) + share) / static_cast<double>(settings_.times.size()));
    });
    for (int order = 1; order <= scene_.order; ++order) {
      share = static_cast<double>(order - 1) / scene_.order;
      ValidityEntry entry;
      entry.order = order;
      const double next = sizes[static_cast<std::size_t>(order + 1)];
      const double predicted =
          std::min(next > 0 ? std::pow(tolerance_ / next, 1.0 / (order + 1)) : largest_separation_,
                   largest_separation_);
      entry.predicted_m = predicted * metres_;
      const Stopwatch watch(result_.proof_seconds);
      // At first the worst deviations for an order's error are taken to be those of the next
      // degree, or of the last degree known.
      flown_samples_ = worst_of_degrees[static_cast<std::size_t>(std::min(order + 1, known))];
      prove(deputies, predicted, entry);
      constexpr double clear = 30;  // multiple of the rounding that differences of misses need
      const double floor_m = rounding.at(entry.proved_m / metres_) * metres_;
      result_.flight_floor_m = std::max(result_.flight_floor_m, floor_m);
      if (!entry.is_at_limit && !entry.is_at_wall && entry.miss_m > clear * floor_m) {
        entry.limit = reach_limit(deputies, order, entry.proved_m / metres_ * worst_.direction,
                                  result_.coordinates, names);
      }
      point.entries.push_back(entry);
    }
    result_.points.push_back(std::move(point));
  }

  /// The largest size of each degree's contribution to the position; one more is extrapolated.
  std::vector<double> slice_sizes(SliceMaxima& slices,
                                  const std::vector<std::vector<Vector6>>& worst_of_degrees) const {
    std::vector<double> sizes(worst_of_degrees.size() + 1, 0);
    for (std::size_t d = 1; d < worst_of_degrees.size(); ++d) {
      for (const Vector6& sample : worst_of_degrees[d]) {
        sizes[d] = std::max(sizes[d], slices.size(sample, static_cast<int>(d)));
      }
    }
    const std::size_t last = sizes.size() - 2;
    // Order 1 has one degree and hence no ratio; 1 over the chief's distance is taken instead.
    const double ratio =
        last >= 2 && sizes[last - 1] > 0 ? sizes[last] / sizes[last - 1] : 1 / distance_;
    sizes[last + 1] = sizes[last] * ratio;
    return sizes;
  }

  /// The misses of the first samples at a separation, the largest first, up to one that misses by
  /// far too much; infinite if a deputy cannot be flown.
  std::vector<FlownDeputies::Worst> flown(FlownDeputies& deputies, int order, double separation,
                                          std::size_t count) const {
    std::vector<FlownDeputies::Worst> misses;
    count = std::min(count, flown_samples_.size());
    for (const Vector6& sample : std::span(flown_samples_).first(count)) {
      misses.push_back({sample, deputies.miss(separation * sample, order)});
      if (misses.back().miss > hopeless * tolerance_) break;
    }
    FlownDeputies::sort_by_miss(misses);
    return misses;
  }

  /// The same, which also puts the first samples in the order of their misses, so that the next
  /// trial flies the worst ones first.
  std::vector<FlownDeputies::Worst> fly_and_sort(FlownDeputies& deputies, int order,
                                                 double separation, std::size_t count) {
    std::vector<FlownDeputies::Worst> misses = flown(deputies, order, separation, count);
    std::transform(misses.begin(), misses.end(), flown_samples_.begin(),
                   [](const auto& one) { return one.direction; });
    return misses;
  }

  /// Replaces samples by the deputies at which the miss that the flow's higher degrees foretell for
  /// a separation is largest, and puts the samples first that are foretold to miss most.
  void foretell(FlownDeputies& deputies, int order, double separation) {
    deputies.sort_by_foretold_miss(flown_samples_, order, separation);
    for (const Vector6& start : far_apart(flown_samples_)) {
      const Vector6 found = deputies.foretold_worst_from(start, order, separation);
      constexpr double same = 0.1;
      std::erase_if(flown_samples_,
                    [&](const Vector6& sample) { return (sample - found).norm() < same; });
      flown_samples_.push_back(found);
    }
    deputies.sort_by_foretold_miss(flown_samples_, order, separation);
  }

  /// The worst deputy at a separation that is found by flying all samples and by ascents of the
  /// flown miss from the worst of them. If the flow foretells the misses, ascents of the foretold
  /// ones come first, and flown ascents start from the three worst alone. Ends as soon as a deputy
  /// is beyond the tolerance; the deputies that are found are added to the samples.
  FlownDeputies::Worst worst_at(FlownDeputies& deputies, int order, double separation) {
    FlownDeputies::Worst worst;
    const auto ascend = [&](const FlownDeputies::Worst& start) {
      const FlownDeputies::Worst found = deputies.worst_from(start, order, separation);
      if (found.miss > worst.miss) worst = found;
      if (found.miss > start.miss) flown_samples_.insert(flown_samples_.begin(), found.direction);
    };
    const bool is_foretold = deputies.foretells(order);
    if (is_foretold) {
      foretell(deputies, order, separation);
      const auto foretold = fly_and_sort(deputies, order, separation, worst_samples);
      for (const auto& start : std::span(foretold).first(std::min(most_ascents, foretold.size()))) {
        ascend(start);
      }
      if (worst.miss > tolerance_) return worst;
    }
    const auto misses = fly_and_sort(deputies, order, separation, flown_samples_.size());
    if (misses.front().miss > worst.miss) worst = misses.front();
    if (is_foretold || worst.miss > tolerance_) return worst;
    for (const Vector6& start : far_apart(flown_samples_)) {
      ascend(*std::find_if(misses.begin(), misses.end(),
                           [&](const auto& deputy) { return deputy.direction == start; }));
    }
    return worst;
  }

  /// Whether the miss jumps between a separation that holds and one that does not. There a few
  /// deputies escape, fall or leave the chart, and the others do not show this by a power of the
  /// separation.
  static bool is_wall(double good, double good_miss, double bad, double bad_miss) {
    constexpr double steepest_law = 30;  // in degrees; orders end at about 10
    return !(bad_miss <= good_miss * std::pow(bad / good, steepest_law));
  }

  /// Finds the largest separation that holds (`search_reach`). The trials fly the samples that are
  /// foretold to miss most, or missed most, and order them anew; where worse deputies are sought,
  /// those that are found join them. The few deputies at a wall are not found by a search, so that
  /// the result keeps clear of a wall.
  void prove(FlownDeputies& deputies, double predicted, ValidityEntry& entry) {
    constexpr double clear_of_wall = 0.95;
    const bool is_foretold = deputies.foretells(entry.order);
    if (is_foretold) foretell(deputies, entry.order, predicted);
    bool needs_all = !is_foretold;
    ReachProblem problem{entry.order, tolerance_, smallest_separation * distance_,
                         largest_separation_};
    problem.miss = [&](double separation) {
      const std::size_t count = needs_all ? flown_samples_.size() : worst_samples;
      needs_all = false;
      return fly_and_sort(deputies, entry.order, separation, count).front().miss;
    };
    problem.worst_miss = [&](double separation) {
      worst_ = worst_at(deputies, entry.order, separation);
      return worst_.miss;
    };
    const FoundReach found = search_reach(problem, predicted);
    entry.is_unsettled = found.is_out_of_trials;
    if (found.separation == 0) return;
    entry.is_at_limit = found.is_at_limit;
    entry.is_at_wall =
        !found.is_at_limit && is_wall(found.separation, found.miss, found.next, found.next_miss);
    entry.proved_m = (entry.is_at_wall ? clear_of_wall : 1) * found.separation * metres_;
    entry.miss_m = found.miss * metres_;
  }

  /// The samples that trials fly once it is known which miss most.
  static constexpr std::size_t worst_samples = 6;
  /// The flown ascents from deputies that were foretold to miss most.
  static constexpr std::size_t most_ascents = 3;
  /// After a miss that exceeds the tolerance by this factor, no further samples are needed.
  static constexpr double hopeless = 1e3;

  const Scene& scene_;
  const ValiditySettings& settings_;
  const ProgressCallback& progress_;
  Scene deeper_;  ///< with the degrees above the order that foretell what it neglects
  ComputedProblem problem_;
  ComputedProblem own_problem_;  ///< of the scene's order
  double metres_;
  double distance_;                     ///< distance of the chief at the start, in canonical units
  double largest_separation_;           ///< in canonical units
  double tolerance_;                    ///< in canonical units
  Matrix6 axes_;                        ///< see make_samples
  std::vector<Vector6> samples_;        ///< deviations of separation 1
  std::vector<Vector6> flown_samples_;  ///< samples with which one order is proved
  FlownDeputies::Worst worst_;          ///< at the separation that is being proved
  double time_ = 0;
  ValidityResult result_;
};

std::vector<SelfCheck> checks_of_chief(const Scene& scene) {
  return flight_checks(scene, flights_of(scene, scene.validity->times.back(), false));
}

}  // namespace

ValidityResult study_validity(const Scene& asked, const ProgressCallback& progress) {
  require_deviation_problem(asked, asked.validity.has_value(), "validity");
  require_one_spacecraft(asked, "validity");
  const Scene scene = with_free_coordinates(asked);
  if (scene.coordinates != JetCoordinates::automatic) {
    ValidityResult result = ValidityStudy(scene, progress).run(scene.coordinates);
    result.checks = checks_of_chief(scene);
    set_validity_domains(result, progress);
    return result;
  }
  Scene measured = scene;
  measured.validity->separation_m.reset();
  const ValidityInCoordinates all = study_validity_in_all(measured, progress);
  ValidityResult result = all.furthest();
  result.scene.validity = scene.validity;
  set_validity_domains(result, progress);
  result.coordinates = all.chosen();
  result.checks = all.checks;
  return result;
}

ValidityInCoordinates study_validity_in_all(const Scene& asked, const ProgressCallback& progress) {
  require_deviation_problem(asked, asked.validity.has_value(), "validity");
  require_one_spacecraft(asked, "validity");
  const Scene scene = with_free_coordinates(asked);
  ValidityInCoordinates all;
  for (const JetCoordinates coordinates : measured_coordinates) {
    const bool is_of_orbits = coordinates != JetCoordinates::cartesian;
    if (is_of_orbits && !is_orbit(scene.system.model)) continue;
    try {
      all.results.push_back(ValidityStudy(scene, progress).run(coordinates));
      set_validity_domains(all.results.back(), progress);
    } catch (const Error& error) {
      // An orbit may lack some coordinates, and a method may not support some; the coordinates in
      // which the orbit was given always exist.
      const bool is_lack = error.kind() == ErrorKind::numerical || error.kind() == ErrorKind::scene;
      if (!is_lack || coordinates == JetCoordinates::cartesian) throw;
      all.refused.push_back({coordinates, error.what()});
    }
  }
  all.checks = checks_of_chief(scene);
  return all;
}

ChosenCoordinates measured_coordinates_of(const Scene& scene) {
  if (scene.coordinates != JetCoordinates::automatic) return scene.coordinates;
  constexpr int few_samples = 10;
  // How far deputies are that are like the chief.
  Scene measured = scene;
  measured.deputy.reset();
  measured = with_deputy_parameters(std::move(measured));
  measured.validity = scene.validity.value_or(ValiditySettings{});
  measured.validity->times = {scene.duration};
  measured.validity->samples = few_samples;
  measured.validity->separation_m.reset();
  ValidityInCoordinates all = study_validity_in_all(measured, nullptr);
  if (measured.nominal.size() != scene.nominal.size()) {
    std::erase_if(all.results, [](const ValidityResult& result) {
      return !serve_parameters(result.coordinates);
    });
  }
  return all.chosen();
}

const ValidityResult& ValidityInCoordinates::furthest() const {
  return *std::max_element(results.begin(), results.end(), [](const auto& a, const auto& b) {
    return a.points.back().entries.back().proved_m < b.points.back().entries.back().proved_m;
  });
}

ChosenCoordinates ValidityInCoordinates::chosen() const {
  ChosenCoordinates chosen = furthest().coordinates;
  for (const ValidityResult& result : results) {
    chosen.reaches.push_back(
        {result.coordinates.start, result.points.back().entries.back().proved_m});
  }
  return chosen;
}

}  // namespace hamjet
