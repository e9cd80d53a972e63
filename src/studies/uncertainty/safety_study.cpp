#include "safety_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "../../uncertainty/flown_separations.hpp"
#include "../flights/manoeuvred_flight.hpp"
#include "../formation/formation_problem.hpp"
#include "../formation/single_transfer.hpp"
#include "../stopwatch.hpp"
#include "along_track_bend.hpp"
#include "hamjet/error.hpp"
#include "initial_states.hpp"
#include "uncertain_parameters.hpp"

namespace hamjet {
namespace {

/// The number of samples of each pair that are flown with the full equations; as many of those
/// nearest to the reported separation are flown too.
constexpr long flown_samples = 16;
/// The number of quantiles of the distribution of least separations that are kept beside the
/// reported one.
constexpr int quantiles = 50;

/// Chief, deputy and further deputies, with a fraction of the burn completed.
std::vector<InitialState> formation(const Scene& scene, double burn_share) {
  std::vector<InitialState> all = initial_states(scene, burn_share);
  if (all[0].name != "chief") {
    all.insert(all.begin(), InitialState{"chief", Vector<double>::Zero(6), {}});
  }
  for (const RelativeState& start : scene.uncertainty->safety->deputies) {
    all.push_back(initial_deputy(scene, start));
    all.back().name = fmt::format("deputy {}", all.size() - 1);
  }
  return all;
}

SafetyPair safety_of(const Scene& scene, const EncounterSystems& systems,
                     const std::array<const InitialState*, 2>& states,
                     const CollisionSettings& settings, const MetricUnits& units) {
  const SafetyWatch& watch = *scene.uncertainty->safety;
  EncounterProblem problem = empty_encounter(scene, systems.chief, watch.from, watch.to,
                                             watch.keep_apart_m / units.length_m);
  for (std::size_t craft = 0; craft < 2; ++craft) {
    problem.spacecraft[craft] = uncertain_spacecraft(scene, systems, *states[craft]);
  }
  SafetyPair pair;
  pair.first = states[0]->name;
  pair.second = states[1]->name;
  std::vector<double> shares = {1 - watch.share};
  for (int k = 0; k < quantiles; ++k) shares.push_back((k + 0.5) / quantiles);
  pair.separations = least_separations(problem, settings, shares, flown_samples);
  pair.separations.scale(units.length_m);
  pair.mean_separation_m = flown_separation_of_means(problem) * units.length_m;
  // The rarest cases that are reported lie some three standard deviations along the track.
  constexpr double rare = 3;
  AlongTrackBend bend = along_track_bend(problem, EncounterDeviation::Zero());
  bend.bend *= rare * rare;
  pair.warning = along_track_warning(bend, pair.separations.separations[0] / units.length_m,
                                     {pair.first, pair.second}, "its least separation", units);
  if (watch.keep_out_m && pair.first == "chief") {
    try {
      pair.margin = keep_out_margin(problem, *watch.keep_out_m / units.length_m);
      pair.margin->time *= units.time_s;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      pair.refusal = error.what();
    }
  }
  return pair;
}

}  // namespace

const SafetyPair& least_safe_pair(const SafetyResult& result) {
  return *std::min_element(
      result.pairs.begin(), result.pairs.end(), [](const SafetyPair& one, const SafetyPair& other) {
        return one.separations.separations[0] < other.separations.separations[0];
      });
}

SafetyResult study_safety(const Scene& scene, std::size_t threads,
                          const ProgressCallback& progress) {
  require_coasting(scene);
  const bool is_asked_for = scene.uncertainty && scene.uncertainty->safety;
  require_formation_problem(scene, is_asked_for, "uncertainty.safety");
  require_known_parameters(scene, "uncertainty.safety");
  SafetyResult result;
  {
    const Stopwatch watch(result.seconds);
    const MetricUnits units = metric_units(scene);
    const EncounterSystems systems(scene);
    result.watch = *scene.uncertainty->safety;
    result.order = scene.order;
    result.from_s = result.watch.from * units.time_s;
    result.to_s = result.watch.to * units.time_s;
    CollisionSettings settings;
    settings.samples = result.watch.samples;
    settings.confidence = result.watch.confidence;
    settings.seed = scene.uncertainty->seed;
    settings.threads = threads;
    if (progress) {
      settings.progress = [&](double fraction) { progress("safety", fraction); };
    }
    const bool has_burn = scene.uncertainty->burn.has_value();
    bool is_first = true;
    for (const double share : result.watch.burn_shares) {
      const std::vector<InitialState> all = formation(scene, share);
      for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = i + 1; j < all.size(); ++j) {
          const bool burns = has_burn && (all[i].name == "deputy" || all[j].name == "deputy");
          if (!burns && !is_first) continue;
          result.pairs.push_back(safety_of(scene, systems, {&all[i], &all[j]}, settings, units));
          if (burns) result.pairs.back().burn_share = share;
        }
      }
      is_first = false;
    }
  }
  return result;
}

}  // namespace hamjet
