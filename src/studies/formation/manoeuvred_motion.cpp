#include "manoeuvred_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "../../algebra/state_sums.hpp"
#include "../exact_flow.hpp"
#include "../flights/manoeuvred_flight.hpp"
#include "formation_problem.hpp"
#include "hamjet/error.hpp"
#include "single_transfer.hpp"

namespace hamjet {
namespace {

/// Parts in which a span with a burn is flown and told.
constexpr int parts_of_burn = 16;

/// One of the two spacecraft.
struct ManoeuvredSpacecraft {
  SharedSystem system;
  std::vector<double> state;
  const std::vector<Manoeuvre>& manoeuvres;

  /// The burn that lasts through a span.
  const Manoeuvre* burn_in(double from, double to) const {
    const auto found =
        std::find_if(manoeuvres.begin(), manoeuvres.end(), [&](const Manoeuvre& one) {
          return one.start <= from && one.end() >= to && one.length > 0;
        });
    return found != manoeuvres.end() ? &*found : nullptr;
  }
  void pass_impulses(double time) {
    for (const Manoeuvre& one : manoeuvres) {
      if (one.length == 0 && one.start == time) state = behind_impulse(std::move(state), one);
    }
  }
  void fly(const ClockTime& start, double from, double to) {
    const Manoeuvre* burn = burn_in(from, to);
    state = burn != nullptr ? burnt_flow(*system, std::move(state), start, *burn, from, to)
                            : exact_flow(system, state, start + from, to - from);
  }
};

class ManoeuvredMotion {
 public:
  ManoeuvredMotion(const Scene& scene, const ProgressCallback& progress)
      : scene_(scene),
        coasting_(without_manoeuvres(scene)),
        progress_(progress),
        chief_{SharedSystem(make_system(coasting_)), scene.nominal, scene.manoeuvres},
        deputy_{SharedSystem(make_system(with_deputy_coefficients(coasting_))),
                state_sum(scene.nominal,
                          ChiefFrame(scene.nominal, metric_units(scene), scene.deputy->frame)
                              .deviation(scene.deputy->start)),
                scene.deputy->manoeuvres} {}

  DeputyMotion run() {
    motion_.integrator = symplectic_integrator(scene_).label;
    std::vector<double> times = {0, scene_.duration};
    for (const auto* manoeuvres : {&scene_.manoeuvres, &scene_.deputy->manoeuvres}) {
      for (const Manoeuvre& one : *manoeuvres) {
        for (const double time : {one.start, one.end()}) {
          if (time < scene_.duration) times.push_back(time);
        }
        if (one.start < scene_.duration) ++motion_.manoeuvres;
      }
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
      chief_.pass_impulses(times[k]);
      deputy_.pass_impulses(times[k]);
      const bool is_burning = chief_.burn_in(times[k], times[k + 1]) != nullptr ||
                              deputy_.burn_in(times[k], times[k + 1]) != nullptr;
      is_burning ? burn(times[k], times[k + 1]) : coast(times[k], times[k + 1]);
    }
    motion_.scene = scene_;
    return std::move(motion_);
  }

 private:
  RelativeState relative() const {
    return ChiefFrame(chief_.state, metric_units(scene_), scene_.deputy->frame)
        .relative(state_difference(deputy_.state, chief_.state));
  }

  void add_flown(double time) {
    motion_.flown.times.push_back(time);
    motion_.flown.states.push_back(relative());
    motion_.flown.chief.push_back(chief_.state);
    motion_.flown.deputy.push_back(deputy_.state);
  }

  void add_separation(const SeparationAt& at) {
    auto& [nearest, farthest] = motion_.extremes;
    const double size = at.state.position_m.norm();
    if (!has_extremes_ || size < nearest.state.position_m.norm()) nearest = at;
    if (!has_extremes_ || size > farthest.state.position_m.norm()) farthest = at;
    has_extremes_ = true;
  }

  /// Of the same check of several arcs, one that failed is kept.
  void add_check(SelfCheck check) {
    const auto same =
        std::find_if(motion_.checks.begin(), motion_.checks.end(),
                     [&](const SelfCheck& other) { return other.name == check.name; });
    if (same == motion_.checks.end()) {
      motion_.checks.push_back(std::move(check));
    } else if (check.state == SelfCheckState::failed && same->state != SelfCheckState::failed) {
      *same = std::move(check);
    }
  }

  void burn(double from, double to) {
    motion_.flown.frame = scene_.deputy->frame;
    for (int part = 0; part <= parts_of_burn; ++part) {
      const double time = part == parts_of_burn ? to : from + (to - from) * part / parts_of_burn;
      if (part > 0) {
        const double last = motion_.flown.times.back();
        chief_.fly(scene_.start_time, last, time);
        deputy_.fly(scene_.start_time, last, time);
      }
      add_flown(time);
      add_separation({time, relative()});
    }
    // Polynomials begin anew where a burn ends, and none are about a spacecraft that burns.
    const std::vector<double> no_errors(static_cast<std::size_t>(scene_.order), 0.0);
    if (from == 0) motion_.points.push_back({0, motion_.flown.states.front(), no_errors, 0});
    if (to == scene_.duration) motion_.points.push_back({to, relative(), no_errors, 0});
  }

  void coast(double from, double to) {
    Scene arc = coasting_;
    arc.start_time = scene_.start_time + from;
    arc.nominal = chief_.state;
    arc.duration = to - from;
    arc.deputy->start = relative();
    DeputyMotion part = study_deputy_motion(arc, progress_);
    chief_.state = part.flown.chief.back();
    chief_.state.resize(scene_.nominal.size());
    deputy_.state = part.flown.deputy.back();
    deputy_.state.resize(scene_.nominal.size());
    for (DeputyMotionPoint& point : part.points) {
      point.time += from;
      motion_.points.push_back(std::move(point));
    }
    motion_.points.back().time = to;
    motion_.flown.frame = part.flown.frame;
    for (std::size_t i = 0; i < part.flown.times.size(); ++i) {
      motion_.flown.times.push_back(part.flown.times[i] + from);
      motion_.flown.states.push_back(part.flown.states[i]);
      motion_.flown.chief.push_back(part.flown.chief[i]);
      motion_.flown.deputy.push_back(part.flown.deputy[i]);
    }
    for (SeparationAt at : {part.extremes.nearest, part.extremes.farthest}) {
      at.time += from;
      add_separation(at);
    }
    motion_.integrator = part.integrator;
    motion_.coordinates = part.coordinates;
    motion_.flight_floor_m += part.flight_floor_m;
    motion_.propagation_seconds += part.propagation_seconds;
    for (SelfCheck& check : part.checks) add_check(std::move(check));
  }

  const Scene& scene_;
  Scene coasting_;
  const ProgressCallback& progress_;
  ManoeuvredSpacecraft chief_;
  ManoeuvredSpacecraft deputy_;
  DeputyMotion motion_;
  bool has_extremes_ = false;
};

/// A manoeuvre that the scene's end leaves out, or cuts, would be missed in silence.
void require_manoeuvres_within(const Scene& scene, const std::vector<Manoeuvre>& manoeuvres,
                               std::string_view owner) {
  for (const Manoeuvre& one : manoeuvres) {
    // An impulse at the end itself is behind what is asked for.
    if (one.end() <= scene.duration * (1 + 1e-12)) continue;
    const double seconds = scene.units.time_s;
    throw Error(ErrorKind::scene,
                fmt::format("{}.opm_file: a manoeuvre that ends {:.6g} s after the start, got a "
                            "scene of {:.6g} s, must be within it: a longer jet.duration_s, or "
                            "manoeuvres = \"leave-out\"",
                            owner, one.end() * seconds, scene.duration * seconds));
  }
}

}  // namespace

DeputyMotion manoeuvred_motion(const Scene& scene, const ProgressCallback& progress) {
  if (!(scene.duration > 0)) {
    throw Error(ErrorKind::scene,
                "deputy: manoeuvres are flown forward in time alone, got a jet.duration that is "
                "not positive");
  }
  if (scene.system.earth && scene.system.earth->sunlight && !scene.manoeuvres.empty()) {
    throw Error(
        ErrorKind::scene,
        "nominal.opm_file: manoeuvres of a chief in the Earth's shadow, whose edges are those "
        "of its coasting orbit; must be without, or beside system.shadow = \"none\"");
  }
  require_manoeuvres_within(scene, scene.manoeuvres, "nominal");
  require_manoeuvres_within(scene, scene.deputy->manoeuvres, "deputy");
  return ManoeuvredMotion(scene, progress).run();
}

}  // namespace hamjet
