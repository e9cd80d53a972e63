#include "bounded_formation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../poincare/bounded_family.hpp"
#include "../exact_flow.hpp"
#include "../formation/deputy_flows.hpp"
#include "../formation/formation_problem.hpp"
#include "../formation/single_transfer.hpp"
#include "../stopwatch.hpp"
#include "hamjet/error.hpp"
#include "hamjet/studies/propagation.hpp"
#include "mean_element_deputies.hpp"

namespace hamjet {
namespace {

/// Of the relative orbits that are measured and drawn.
constexpr int points_of_orbit = 96;
/// Of the polynomials' integration, whose errors add up over the window.
constexpr double map_tolerance = 1e-13;

std::vector<double> vector_of(const SixNumbers<double>& z) { return {z.begin(), z.end()}; }

class BoundedStudy {
 public:
  BoundedStudy(const Scene& scene, const ProgressCallback& progress)
      : scene_(scene),
        settings_(*scene.bounded),
        progress_(progress),
        field_(orbit_field(scene)),
        start_(six_numbers(scene.nominal)),
        system_(make_system(scene)),
        units_(metric_units(scene)) {}

  BoundedFormation run() {
    const Stopwatch whole(result_.family_seconds);
    result_.scene = scene_;
    const BoundedFamily family = make_family();
    family_ = &family;
    const SixNumbers<double>& chief = family.section().chief();
    const double G =
        chief[3] - (chief[q_place] * chief[q_place] + chief[p_place] * chief[p_place]) / 2;
    cosine_ = chief[momentum_place] / G;
    semi_major_axis_ = chief[3] * chief[3] / field_.mu;
    result_.nodal_period = family.nodal_period();
    result_.mean_period = family.mean_period()[0];
    result_.mean_node = family.mean_node()[0];
    make_times();
    fly_chief();
    const std::size_t all = settings_.sizes_m.size() * bounded_rules.size();
    for (const double size_m : settings_.sizes_m) {
      for (const BoundedRule rule : bounded_rules) {
        if (progress_) {
          progress_("flights",
                    static_cast<double>(result_.deputies.size()) / static_cast<double>(all));
        }
        result_.deputies.push_back(deputy_of(rule, size_m));
      }
    }
    return std::move(result_);
  }

 private:
  BoundedFamily make_family() {
    BoundedFamily family(field_, start_, scene_.order, settings_.revolutions, map_tolerance,
                         [&](double part) {
                           if (progress_) progress_("polynomials", part);
                         });
    const double revolutions = family.times().back() / family.nodal_period();
    result_.revolutions = static_cast<int>(std::lround(revolutions));
    return family;
  }

  /// The window's times, and those of a tenth of it: index and revolutions.
  void make_times() {
    const std::vector<double>& window = family_->times();
    for (const double t : window) times_.push_back(t / 10);
    for (const double t : window) {
      if (t > times_[window.size() - 1] * (1 + 1e-9)) times_.push_back(t);
    }
  }

  std::vector<double> flown_on(const std::vector<double>& state, double time) const {
    return exact_flow(system_, state, time);
  }

  void fly_chief() {
    chief_orbit_ = orbit_from(vector_of(start_));
    std::vector<double> state = vector_of(start_);
    chief_.push_back(state);
    for (std::size_t k = 1; k < times_.size(); ++k) {
      state = flown_on(state, times_[k] - times_[k - 1]);
      chief_.push_back(state);
    }
    chief_last_orbit_ = orbit_from(chief_.back());
  }

  /// States at equal times of one revolution.
  std::vector<std::vector<double>> orbit_from(const std::vector<double>& start) const {
    std::vector<std::vector<double>> orbit = {start};
    for (int k = 1; k <= points_of_orbit; ++k) {
      orbit.push_back(flown_on(orbit.back(), result_.nodal_period / points_of_orbit));
    }
    return orbit;
  }

  std::vector<RelativeState> relative_orbit(const std::vector<std::vector<double>>& chief,
                                            const std::vector<std::vector<double>>& deputy) const {
    std::vector<RelativeState> states;
    for (std::size_t k = 0; k < chief.size(); ++k) {
      std::vector<double> difference;
      for (std::size_t i = 0; i < 6; ++i) difference.push_back(deputy[k][i] - chief[k][i]);
      states.push_back(
          ChiefFrame(chief[k], units_, RelativeFrame::rtn_rotating).relative(difference));
    }
    return states;
  }

  /// The deputy of a rule whose eccentricity vector differs by so much, with its share of the size
  /// across and along the orbit.
  std::vector<double> start_of(BoundedDeputy& deputy, double amplitude) const {
    // At the phase 0 the eccentricity grows, at 90 degrees the pericentre turns ahead.
    const SixNumbers<double>& chief = family_->section().chief();
    const double phase =
        std::atan2(chief[q_place], chief[p_place]) - settings_.phase_deg * std::numbers::pi / 180;
    const double unit = amplitude * std::sqrt(chief[3]);
    const double q = unit * std::sin(phase);
    const double p = unit * std::cos(phase);
    SixNumbers<double> state;
    if (deputy.rule == BoundedRule::poincare_map) {
      const BoundedFamily::Member member = family_->member(q, p, family_->order());
      deputy.energy = member.energy;
      deputy.momentum = member.momentum;
      state = member.state;
    } else {
      state = mean_element_deputy(field_, start_,
                                  deputy.rule == BoundedRule::j2_invariant
                                      ? MeanElementRule::j2_invariant
                                      : MeanElementRule::equal_elements,
                                  q, p);
    }
    // The field contains neither the node nor the time: both are shifted freely.
    const double size = deputy.wanted_m / units_.length_m;
    const double sine = std::sqrt((1 - cosine_) * (1 + cosine_));
    const double turn = settings_.cross_track * size / (semi_major_axis_ * sine);
    const double c = std::cos(turn), s = std::sin(turn);
    for (const std::size_t i : {std::size_t{0}, std::size_t{3}}) {
      const double x = state[i];
      state[i] = c * x - s * state[i + 1];
      state[i + 1] = s * x + c * state[i + 1];
    }
    // What the node's shift moves along the track is taken back.
    const double mean_motion = 2 * std::numbers::pi / result_.mean_period;
    const double ahead = settings_.along_track * size / semi_major_axis_ - turn * cosine_;
    return flown_on(vector_of(state), ahead / mean_motion);
  }

  double size_of(const std::vector<RelativeState>& states) const {
    double size = 0;
    for (const RelativeState& state : states) size = std::max(size, state.position_m.norm());
    return size;
  }

  BoundedDeputy deputy_of(BoundedRule rule, double size_m) {
    BoundedDeputy deputy;
    deputy.rule = rule;
    deputy.wanted_m = size_m;
    try {
      find(deputy);
      fly(deputy);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      deputy = {};
      deputy.rule = rule;
      deputy.wanted_m = size_m;
      deputy.failure = error.what();
    }
    return deputy;
  }

  /// Seeks the amplitude of the deputy's size, by the secant method from that of small ones.
  void find(BoundedDeputy& deputy) const {
    const auto orbit_at = [&](double amplitude) {
      deputy.state = start_of(deputy, amplitude);
      return relative_orbit(chief_orbit_, orbit_from(deputy.state));
    };
    const double fixed = size_of(orbit_at(0));
    if (!(fixed < deputy.wanted_m)) {
      throw Error(ErrorKind::numerical,
                  fmt::format("bounded: cross_track and along_track alone take it {:.4g} km away, "
                              "further than its size of {:.4g} km",
                              fixed / 1000, deputy.wanted_m / 1000));
    }
    double low = 0;
    double high = 0;
    double at = deputy.wanted_m / (2 * semi_major_axis_ * units_.length_m);
    constexpr int most_iterations = 30;
    constexpr double close = 1e-4;
    for (int i = 0; i < most_iterations; ++i) {
      deputy.first = orbit_at(at);
      deputy.size_m = size_of(deputy.first);
      deputy.amplitude = at;
      if (std::abs(deputy.size_m / deputy.wanted_m - 1) < close) return;
      (deputy.size_m < deputy.wanted_m ? low : high) = at;
      // About the root of a sum of squares, held between what is known.
      const double square = std::pow(deputy.size_m, 2) - std::pow(fixed, 2);
      double next = at * std::sqrt((std::pow(deputy.wanted_m, 2) - std::pow(fixed, 2)) /
                                   std::max(square, 1e-6 * std::pow(deputy.size_m, 2)));
      if (high > 0 && !(next > low && next < high)) next = (low + high) / 2;
      at = std::clamp(next, 0.3 * at, 3 * at);
    }
    throw Error(ErrorKind::numerical,
                fmt::format("bounded: no amplitude has this size, the last one tried {:.4g} km",
                            deputy.size_m / 1000));
  }

  void fly(BoundedDeputy& deputy) {
    const Stopwatch watch(result_.flight_seconds);
    const CanonicalChart<double>& chart = family_->section().chart();
    std::vector<double> along = {};
    std::vector<double> cross = {};
    std::vector<double> state = deputy.state;
    double last_along = 0;
    double last_node = 0;
    SixNumbers<double> first = {};
    for (std::size_t k = 0; k < times_.size(); ++k) {
      if (k > 0) state = flown_on(state, times_[k] - times_[k - 1]);
      const SixNumbers<double> z = chart.coordinates(six_numbers(state));
      const SixNumbers<double> c = chart.coordinates(six_numbers(chief_[k]));
      if (k == 0) first = {z[0] - c[0], z[1] - c[1]};
      // Differences of angles go on from the last ones, so that whole turns are not lost.
      const double angle = z[0] - c[0] - first[0];
      const double node = z[1] - c[1] - first[1];
      last_along += within_half_a_turn(angle - last_along);
      last_node += within_half_a_turn(node - last_node);
      along.push_back(semi_major_axis_ * (last_along + cosine_ * last_node));
      cross.push_back(semi_major_axis_ * std::sqrt((1 - cosine_) * (1 + cosine_)) * last_node);
    }
    deputy.last = relative_orbit(chief_last_orbit_, orbit_from(state));
    const std::size_t tenth = family_->times().size();
    std::vector<std::size_t> early(tenth);
    for (std::size_t k = 0; k < tenth; ++k) early[k] = k;
    std::vector<std::size_t> window = {0};
    for (std::size_t k = 0; k < times_.size(); ++k) {
      const double part = times_[k] / family_->times()[1];
      if (k > 0 && std::abs(part - std::round(part)) < 1e-6) window.push_back(k);
    }
    for (const auto& places : {early, window}) {
      BoundedDrift drift;
      drift.revolutions =
          static_cast<int>(std::lround(times_[places.back()] / result_.nodal_period));
      const double size = deputy.size_m / units_.length_m;
      drift.along = slope_of(places, along) / size;
      drift.cross = slope_of(places, cross) / size;
      double least = 0, most = 0;
      for (const std::size_t k : places) {
        least = std::min(least, along[k]);
        most = std::max(most, along[k]);
      }
      drift.range = (most - least) / size;
      deputy.drifts.push_back(drift);
    }
    std::vector<double> deviation;
    for (std::size_t i = 0; i < 6; ++i) deviation.push_back(deputy.state[i] - scene_.nominal[i]);
    for (std::size_t f = 0; f < deputy.forms.size(); ++f) {
      deputy.forms[f] =
          DeputyCoordinates(scene_.nominal, units_, field_.mu, static_cast<DeputyForm>(f))
              .coordinates(deviation);
    }
    deputy.lowest_m = std::numeric_limits<double>::infinity();
    for (const auto& point : orbit_from(deputy.state)) {
      deputy.lowest_m =
          std::min(deputy.lowest_m, std::hypot(point[0], point[1], point[2]) * units_.length_m);
    }
  }

  /// The slope a revolution of the straight line of least squares.
  double slope_of(const std::vector<std::size_t>& places, const std::vector<double>& values) const {
    double mean_x = 0, mean_y = 0;
    const auto x_of = [&](std::size_t k) { return times_[k] / result_.nodal_period; };
    for (const std::size_t k : places) {
      mean_x += x_of(k) / static_cast<double>(places.size());
      mean_y += values[k] / static_cast<double>(places.size());
    }
    double xy = 0, xx = 0;
    for (const std::size_t k : places) {
      xy += (x_of(k) - mean_x) * (values[k] - mean_y);
      xx += std::pow(x_of(k) - mean_x, 2);
    }
    return xy / xx;
  }

  const Scene& scene_;
  const BoundedSettings& settings_;
  const ProgressCallback& progress_;
  ZonalGravity field_;
  SixNumbers<double> start_;
  SharedSystem system_;
  MetricUnits units_;
  const BoundedFamily* family_ = nullptr;
  double cosine_ = 0;  ///< of the chief's inclination
  double semi_major_axis_ = 0;
  std::vector<double> times_;
  std::vector<std::vector<double>> chief_;  ///< at the times
  std::vector<std::vector<double>> chief_orbit_;
  std::vector<std::vector<double>> chief_last_orbit_;
  BoundedFormation result_;
};

}  // namespace

std::string_view name_of(BoundedRule rule) {
  constexpr std::array<std::string_view, 3> names = {"poincare-map", "j2-invariant",
                                                     "mean-elements"};
  return names[static_cast<std::size_t>(rule)];
}

BoundedFormation study_bounded(const Scene& scene, const ProgressCallback& progress) {
  require_formation_problem(scene, scene.bounded.has_value(), "bounded");
  return BoundedStudy(scene, progress).run();
}

}  // namespace hamjet
