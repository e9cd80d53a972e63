#include "sunlight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "../algebra/scalar_search.hpp"
#include "../astronomy/physical_constants.hpp"
#include "../astronomy/sampled_days.hpp"
#include "../astronomy/shadow.hpp"
#include "../integrators/taylor_flow.hpp"
#include "earth_system.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// A step of a flight, as polynomials of the time in a unit.
struct LitArc {
  double start = 0;
  double span = 0;
  double unit = 1;
  /// The coefficients of each component of the state.
  std::vector<std::vector<double>> coefficients;

  double value(std::size_t component, double time) const {
    const double s = (time - start) / unit;
    double sum = 0;
    const std::vector<double>& c = coefficients[component];
    for (std::size_t k = c.size(); k-- > 0;) sum = sum * s + c[k];
    return sum;
  }
  std::array<double, 3> position(double time) const {
    return {value(0, time), value(1, time), value(2, time)};
  }
  std::vector<double> state(double time) const {
    std::vector<double> result;
    for (std::size_t i = 0; i < coefficients.size(); ++i) result.push_back(value(i, time));
    return result;
  }
  /// A bound of the length of three components within the arc, by those of their terms.
  double greatest_length(std::size_t first) const {
    double square = 0;
    for (std::size_t i = first; i < first + 3; ++i) {
      double sum = 0;
      double power = 1;
      for (const double c : coefficients[i]) {
        sum += std::abs(c) * power;
        power *= std::abs(span) / unit;
      }
      square += sum * sum;
    }
    return std::sqrt(square);
  }
};

/// Flies an orbit in one direction from the time 0, and finds its light meanwhile.
class LitFlight {
 public:
  LitFlight(SystemSettings settings, double canonical_radius, const std::vector<double>& state,
            double needed, double to)
      : needed_(needed), to_(to), state_(state), sun_(position_of_sun(settings, canonical_radius)) {
    const double km = settings.radius_km / canonical_radius;
    shadow_ = {canonical_radius, sun_radius_km / km};
    const double second = std::sqrt(settings.mu_km3_s2 / (km * km * km));
    time_s_ = 1 / second;
    // A path that touches a boundary is inside for 0.01 s at most where that is passed over: by
    // less than a millimetre, of which the penumbra is a ten-millionth or less.
    least_step_ = 0.01 * second;
    set_sides({state[0], state[1], state[2]}, 0);
    light_ = std::make_shared<Sunlight>(Sunlight::constant(constant_light()));
    settings.earth->sunlight = light_;
    system_ = earth_system(settings, canonical_radius);
  }

  std::shared_ptr<Sunlight> run() {
    TaylorFlow flow(system_);
    while (time_ != to_ && !has_ended_) {
      if (is_partial()) {
        pass_partial_light(flow);
      } else {
        const std::vector<LitArc> arcs = fly(flow);
        advance(arcs);
      }
    }
    return light_;
  }

 private:
  bool inside(ShadowEdge edge) const { return inside_[static_cast<std::size_t>(edge)]; }
  bool is_partial() const { return inside(ShadowEdge::penumbra) && !inside(ShadowEdge::umbra); }
  double constant_light() const { return inside(ShadowEdge::penumbra) ? 0 : 1; }
  double direction() const { return std::copysign(1.0, to_); }

  std::array<double, 3> sun_at(double time) const {
    std::array<double, 3> sun{};
    sun_->expand(time, 0, sun.data());
    return sun;
  }

  void set_sides(const std::array<double, 3>& position, double time) {
    const auto distances = distances_to_shadow(shadow_, position, sun_at(time));
    for (std::size_t i = 0; i < inside_.size(); ++i) inside_[i] = distances[i] < 0;
  }

  /// The angular velocity of the Sun's direction, and how fast it comes nearer, about a time.
  double rate_of_sun(double time) const {
    std::array<double, 6> sun{};
    sun_->expand(time, 1, sun.data());
    return std::hypot(sun[1], sun[3], sun[5]) / std::hypot(sun[0], sun[2], sun[4]);
  }

  LitArc arc_from(TaylorFlow& flow, double time, const std::vector<double>& state) const {
    // Of the reach only this fraction is used, as in flights that are looked at between their
    // steps.
    constexpr double used_reach = 0.8;
    // Functions of the time are those of the side to which the flight goes on.
    const ClockTime clock(
        light_->edges().empty() || time == 0 ? time : std::nextafter(time, direction() * HUGE_VAL));
    for (std::size_t lane = 0; lane < TaylorFlow::lanes; ++lane) {
      flow.set_state(lane, clock, state, direction());
    }
    flow.expand();
    const double reach = flow.reach(0, used_reach);
    LitArc arc{time, std::clamp(to_ - time, -reach, reach), flow.unit(0), {}};
    for (std::size_t i = 0; i < state.size(); ++i) {
      std::vector<double>& series = arc.coefficients.emplace_back();
      for (int k = 0; k <= flow.powers(0); ++k) series.push_back(flow.coefficient(0, i, k));
    }
    return arc;
  }

  /// Flies on from the present state to the next edge, or to the end.
  std::vector<LitArc> fly(TaylorFlow& flow) {
    // A step shorter than this fraction of the whole time runs into a collision.
    constexpr double least_part = 1e-9;
    constexpr long most_arcs = 200000;
    std::vector<LitArc> arcs;
    crossing_.reset();
    double time = time_;
    std::vector<double> state = state_;
    while (time != to_ && !crossing_) {
      const LitArc arc = arc_from(flow, time, state);
      if (!(std::abs(arc.span) > least_part * std::abs(to_)) && arc.span != to_ - time) {
        if (std::abs(time) < std::abs(needed_)) {
          throw Error(ErrorKind::numerical,
                      fmt::format("the light along an orbit cannot be followed beyond {:.6g} s: "
                                  "it runs into a collision, or decays",
                                  time * time_s_));
        }
        has_ended_ = true;
        return arcs;
      }
      if (++flown_arcs_ > most_arcs) {
        throw Error(ErrorKind::too_large,
                    fmt::format("the light along an orbit: more than {} steps of a flight would be "
                                "needed; a shorter duration or shadow = \"none\" would do",
                                most_arcs));
      }
      const double end = arc.span == to_ - time ? to_ : time + arc.span;
      // One part in a hundred more than the rate at one time covers its change within an arc.
      const double turning = 1.01 * rate_of_sun(time) * arc.greatest_length(0);
      const ShadowedPath path{[&](double at) { return arc.position(at); },
                              [&](double at) { return sun_at(at); },
                              arc.greatest_length(3) + turning};
      crossing_ = next_crossing(shadow_, path, inside_, time, end, least_step_);
      arcs.push_back(arc);
      time = crossing_ ? crossing_->time : end;
      state = arc.state(time);
    }
    return arcs;
  }

  /// Goes to the end of arcs, and over the edge there.
  void advance(const std::vector<LitArc>& arcs) {
    if (arcs.empty()) return;
    time_ = crossing_ ? crossing_->time : to_;
    state_ = arcs.back().state(time_);
    if (has_ended_) time_ = arcs.back().start;
    if (!crossing_) return;
    bool& side = inside_[static_cast<std::size_t>(crossing_->edge)];
    side = !side;
    const Sunlight::Piece next = Sunlight::constant(constant_light());
    if (direction() > 0) {
      light_->append(time_, next);
    } else {
      light_->prepend(time_, next);
    }
  }

  /// Flies through light that changes: at first without any, which moves a spacecraft by less than
  /// a metre, and again with the polynomial of the first flight.
  void pass_partial_light(TaylorFlow& flow) {
    std::vector<LitArc> arcs;
    for (int round = 0; round < 2; ++round) {
      arcs = fly(flow);
      if (arcs.empty()) return;
      const double end = crossing_ ? crossing_->time : arcs.back().start + arcs.back().span;
      const auto fraction = [&](double time) {
        const auto arc = std::find_if(arcs.begin(), arcs.end() - 1, [&](const LitArc& one) {
          return (one.start + one.span - time) * direction() >= 0;
        });
        return sunlit_fraction(shadow_, arc->position(time), sun_at(time));
      };
      Sunlight::Piece piece =
          Sunlight::interpolated(fraction, std::min(time_, end), std::max(time_, end));
      (direction() > 0 ? light_->last() : light_->first()) = std::move(piece);
    }
    advance(arcs);
  }

  double needed_;
  double to_;
  double time_ = 0;
  std::vector<double> state_;
  std::shared_ptr<const BodyPosition> sun_;
  Shadow shadow_;
  double time_s_ = 0;  ///< the unit of time
  double least_step_ = 0;
  std::array<bool, 3> inside_{};
  std::optional<ShadowCrossing> crossing_;
  bool has_ended_ = false;
  long flown_arcs_ = 0;
  std::shared_ptr<Sunlight> light_;  ///< grows with the flight, whose forces take it
  SharedSystem system_;
};

}  // namespace

std::shared_ptr<const Sunlight> sunlight_along(const SystemSettings& settings,
                                               double canonical_radius,
                                               const std::vector<double>& state) {
  const double km = settings.radius_km / canonical_radius;
  const double second = std::sqrt(settings.mu_km3_s2 / (km * km * km));
  const EarthSettings& earth = settings.earth.value();
  // What is asked of the axes at the end itself must be within their own span.
  const double beyond_s = 0.999 * 86400 * days_beyond_span;
  const double first = std::min(0.0, earth.first_s) * second;
  const double last = std::max(0.0, earth.last_s) * second;
  const auto later =
      LitFlight(settings, canonical_radius, state, last, last + beyond_s * second).run();
  const auto earlier =
      LitFlight(settings, canonical_radius, state, first, first - beyond_s * second).run();
  // At the time 0 both have the same light; where it changes there, each has a polynomial of it.
  if (earlier->last().is_constant() && earlier->edges().empty()) return later;
  const std::vector<Sunlight::Piece>& before = earlier->pieces();
  const bool is_one = earlier->last().is_constant();
  if (!is_one) later->prepend(0, before.back());
  for (std::size_t i = earlier->edges().size(); i-- > 0;) {
    later->prepend(earlier->edges()[i], before[i]);
  }
  return later;
}

void light_nominal(Scene& scene) {
  if (!scene.system.earth) return;
  EarthSettings& earth = *scene.system.earth;
  if (!earth.radiation || earth.radiation->shadow == ShadowModel::none) return;
  earth.sunlight = sunlight_along(scene.system, scene.canonical_radius, scene.nominal);
}

}  // namespace hamjet
