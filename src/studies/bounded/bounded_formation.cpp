#include "bounded_formation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "../../poincare/bounded_family.hpp"
#include "../checks/flight_checks.hpp"
#include "../flights/manoeuvred_flight.hpp"
#include "../formation/charts/deputy_flows.hpp"
#include "../formation/formation_problem.hpp"
#include "../formation/single_transfer.hpp"
#include "../stopwatch.hpp"
#include "company_flight.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "hamjet/error.hpp"
#include "mean_element_deputies.hpp"
#include "nodal_section.hpp"
#include "relative_orbit_extent.hpp"
#include "scene_gauss.hpp"

namespace hamjet {
namespace {

/// The largest tolerance of the polynomials' integration, whose errors add up over the window.
constexpr double most_family_tolerance = 1e-13;

std::vector<double> vector_of(const SixNumbers<double>& z) { return {z.begin(), z.end()}; }

class BoundedStudy {
 public:
  BoundedStudy(const Scene& scene, const ProgressCallback& progress)
      : scene_(scene),
        settings_(*scene.bounded),
        progress_(progress),
        field_(orbit_field(scene)),
        start_(six_numbers(scene.nominal)),
        units_(metric_units(scene)),
        family_(field_, start_, scene.order, settings_.revolutions,
                scene_gauss(scene, most_family_tolerance),
                [&](double part) {
                  if (progress_) progress_("polynomials", part);
                }),
        flight_(scene, family_.section(), family_.times(), family_.nodal_period(),
                family_.mean_period()[0]) {}

  BoundedFormation run() {
    result_.scene = scene_;
    result_.nodal_period = family_.nodal_period();
    result_.mean_period = family_.mean_period()[0];
    result_.mean_node = family_.mean_node()[0];
    result_.revolutions =
        static_cast<int>(std::lround(family_.times().back() / family_.nodal_period()));
    const std::size_t all = settings_.sizes_m.size() * bounded_rules.size();
    for (const double size_m : settings_.sizes_m) {
      for (const BoundedRule rule : bounded_rules) {
        if (rule == BoundedRule::refined && !settings_.refine) continue;
        if (progress_) {
          progress_("flights",
                    static_cast<double>(result_.deputies.size()) / static_cast<double>(all));
        }
        result_.deputies.push_back(deputy_of(rule, size_m));
      }
    }
    result_.checks = flight_checks(scene_, flights_of(scene_, family_.times().back(), false));
    if (settings_.box.half_widths_m) {
      result_.box = keep_in_box(scene_, state_in_box(), family_.nodal_period(), progress_);
    }
    return std::move(result_);
  }

 private:
  /// The state of the deputy that the box is about: the map's of the first size, or what was
  /// refined of it; empty where the box is about a place.
  std::vector<double> state_in_box() const {
    if (settings_.box.reference == BoxReference::rest) return {};
    const BoundedDeputy& deputy = result_.deputies[settings_.refine ? 1 : 0];
    if (!deputy.failure.empty()) {
      throw Error(ErrorKind::numerical,
                  "bounded.box: its reference is not there: " + deputy.failure);
    }
    return deputy.state;
  }

  /// The difference of the pericentres' pairs of a deputy, and the turn of its node.
  struct Offset {
    double q;
    double p;
    double node;
  };
  Offset offset_of(const BoundedDeputy& deputy, double amplitude) const {
    // A turn of the node takes the deputy across the plane; what that moves along the track is
    // taken back by the pericentre, so that in their planes the orbits lie alike.
    const SixNumbers<double>& chief = family_.section().chief();
    const double size = deputy.wanted_m / units_.length_m;
    const double turn = settings_.cross_track * size / (flight_.semi_major_axis() * flight_.sine());
    const double length = std::hypot(chief[q_place], chief[p_place]);
    const double pericentre = std::atan2(-chief[q_place], chief[p_place]);
    const double turned = pericentre - turn * flight_.cosine();
    // At the phase 0 the eccentricity grows, at 90 degrees the pericentre turns ahead.
    const double direction = pericentre + settings_.phase_deg * std::numbers::pi / 180;
    const double unit = amplitude * std::sqrt(chief[3]);
    return {-length * std::sin(turned) - chief[q_place] - unit * std::sin(direction),
            length * std::cos(turned) - chief[p_place] + unit * std::cos(direction), turn};
  }

  /// The start of a deputy from its state on the section, its node turned and moved along its
  /// orbit: the field contains neither the node nor the time.
  std::vector<double> shifted(SixNumbers<double> state, const BoundedDeputy& deputy,
                              double turn) const {
    const double c = std::cos(turn), s = std::sin(turn);
    for (const std::size_t i : {std::size_t{0}, std::size_t{3}}) {
      const double x = state[i];
      state[i] = c * x - s * state[i + 1];
      state[i + 1] = s * x + c * state[i + 1];
    }
    const double ahead =
        settings_.along_track * deputy.wanted_m / units_.length_m / flight_.semi_major_axis() -
        turn * flight_.cosine();
    return flight_.flown_on(vector_of(state), 0, ahead / flight_.mean_motion());
  }

  /// The deputy of a rule whose eccentricity vector differs by so much, with its share of the size
  /// across and along the orbit.
  std::vector<double> start_of(BoundedDeputy& deputy, double amplitude) const {
    const Offset offset = offset_of(deputy, amplitude);
    SixNumbers<double> state;
    if (deputy.rule == BoundedRule::poincare_map) {
      const BoundedFamily::Member member = family_.member(offset.q, offset.p, family_.order());
      deputy.period_difference = member.energy;
      deputy.momentum_difference = member.momentum;
      state = member.state;
    } else {
      state = mean_element_deputy(field_, start_,
                                  deputy.rule == BoundedRule::j2_invariant
                                      ? MeanElementRule::j2_invariant
                                      : MeanElementRule::equal_elements,
                                  offset.q, offset.p);
    }
    return shifted(state, deputy, offset.node);
  }

  BoundedDeputy deputy_of(BoundedRule rule, double size_m) {
    BoundedDeputy deputy;
    deputy.rule = rule;
    deputy.wanted_m = size_m;
    try {
      if (rule == BoundedRule::refined) {
        // The map's deputy of the same size stands before it.
        deputy = result_.deputies.back();
        deputy.rule = rule;
        if (!deputy.failure.empty()) return deputy;
        refine(deputy);
      } else {
        find(deputy);
        const Stopwatch watch(result_.flight_seconds);
        flight_.fly(deputy);
      }
      tell_start(deputy);
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
      return flight_.first_orbit(deputy.state);
    };
    const double fixed = largest_distance_m(orbit_at(0));
    constexpr double follower = 0.01;
    if (std::abs(fixed / deputy.wanted_m - 1) < follower) {
      // Nothing is left for the eccentricity vector: the deputy goes before or behind the chief.
      deputy.amplitude = 0;
      return;
    }
    if (!(fixed < deputy.wanted_m)) {
      throw Error(ErrorKind::numerical,
                  fmt::format("bounded: cross_track and along_track alone take it {:.4g} km away, "
                              "further than its size of {:.4g} km",
                              fixed / 1000, deputy.wanted_m / 1000));
    }
    double low = 0;
    double high = 0;
    double at = deputy.wanted_m / (2 * flight_.semi_major_axis() * units_.length_m);
    constexpr int most_iterations = 30;
    constexpr double close = 1e-4;
    for (int i = 0; i < most_iterations; ++i) {
      deputy.first = orbit_at(at);
      deputy.size_m = largest_distance_m(deputy.first);
      deputy.amplitude = at;
      if (std::abs(deputy.size_m / deputy.wanted_m - 1) < close) return;
      (deputy.size_m < deputy.wanted_m ? low : high) = at;
      // The size is about the root of a sum of squares, of a fixed part and of one that grows with
      // the amplitude; the next amplitude stays between the known ones.
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

  /// Newton's method on the mean rates as they are flown over the window, with the polynomials'
  /// derivatives: the amplitude and the phase stay.
  void refine(BoundedDeputy& deputy) {
    const Stopwatch watch(result_.flight_seconds);
    const Offset offset = offset_of(deputy, deputy.amplitude);
    const auto slope = [&](const Series<double>& series, NodalVariable variable,
                           const BoundedDeputy& at) {
      const std::array<double, nodal_variables> point = {at.period_difference, offset.q,
                                                         at.momentum_difference, offset.p};
      return evaluate<double>(derivative(series, variable), point);
    };
    constexpr int most_iterations = 5;
    for (int i = 0; i < most_iterations; ++i) {
      const auto [time, node] = flight_.rates_of(deputy);
      const double a = slope(family_.mean_period(), energy_variable, deputy);
      const double b = slope(family_.mean_period(), momentum_variable, deputy);
      const double c = slope(family_.mean_node(), energy_variable, deputy);
      const double d = slope(family_.mean_node(), momentum_variable, deputy);
      const double determinant = a * d - b * c;
      BoundedDeputy next = deputy;
      next.period_difference -= (d * time - b * node) / determinant;
      next.momentum_difference -= (a * node - c * time) / determinant;
      next.state = shifted(
          family_.state_of(offset.q, offset.p, next.period_difference, next.momentum_difference),
          next, offset.node);
      flight_.fly(next);
      const auto size_of_drift = [](const BoundedDeputy& of) {
        return std::hypot(of.drifts.back().along, of.drifts.back().cross);
      };
      if (!(size_of_drift(next) < size_of_drift(deputy))) return;
      deputy = std::move(next);
      ++deputy.refinements;
    }
  }

  void tell_start(BoundedDeputy& deputy) const {
    std::vector<double> deviation;
    for (std::size_t i = 0; i < 6; ++i) deviation.push_back(deputy.state[i] - scene_.nominal[i]);
    for (std::size_t f = 0; f < deputy.forms.size(); ++f) {
      deputy.forms[f] =
          DeputyCoordinates(scene_.nominal, units_, field_.mu, static_cast<DeputyForm>(f))
              .coordinates(deviation);
    }
  }

  const Scene& scene_;
  const BoundedSettings& settings_;
  const ProgressCallback& progress_;
  ZonalGravity field_;
  SixNumbers<double> start_;
  MetricUnits units_;
  BoundedFamily family_;
  CompanyFlight flight_;
  BoundedFormation result_;
};

}  // namespace

std::string_view name_of(BoundedRule rule) {
  constexpr std::array<std::string_view, 4> names = {"poincare-map", "refined", "j2-invariant",
                                                     "mean-elements"};
  return names[static_cast<std::size_t>(rule)];
}

BoundedFormation study_bounded(const Scene& scene, const ProgressCallback& progress) {
  require_coasting(scene);
  require_formation_problem(scene, scene.bounded.has_value(), "bounded");
  require_nodal_section(scene);
  double seconds = 0;
  BoundedFormation result;
  {
    const Stopwatch watch(seconds);
    result = BoundedStudy(scene, progress).run();
  }
  result.seconds = seconds;
  return result;
}

}  // namespace hamjet
