#include "frozen_orbit_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../poincare/frozen_orbit.hpp"
#include "../../poincare/rotation_normal_form.hpp"
#include "../checks/flight_checks.hpp"
#include "../flights/manoeuvred_flight.hpp"
#include "../formation/charts/deputy_flows.hpp"
#include "../formation/formation_problem.hpp"
#include "../formation/single_transfer.hpp"
#include "hamjet/error.hpp"
#include "nodal_section.hpp"
#include "scene_gauss.hpp"

namespace hamjet {
namespace {

constexpr double search_tolerance = 1e-14;
constexpr double refining_tolerance = 1e-22;
constexpr int flown_returns = 100;
constexpr int points_of_curve = 96;

/// Nearer to the critical inclination than this value of |5 cos^2 i - 1|, frozen orbits of any
/// eccentricity may be near; elsewhere the nearly circular one is the only one.
constexpr double critical = 0.05;

double eccentricity_of(const SixNumbers<double>& z) {
  const double ratio = 1 - (z[q_place] * z[q_place] + z[p_place] * z[p_place]) / (2 * z[3]);
  return std::sqrt((1 - ratio) * (1 + ratio));
}

double inclination_cosine(const SixNumbers<double>& z) {
  return z[momentum_place] / (z[3] - (z[q_place] * z[q_place] + z[p_place] * z[p_place]) / 2);
}

template <class To, class From>
SixNumbers<To> converted(const SixNumbers<From>& z) {
  SixNumbers<To> result;
  for (std::size_t i = 0; i < 6; ++i) result[i] = static_cast<To>(z[i]);
  return result;
}

/// Refuses a point to which Newton's method has not come, and one whose return is not a revolution,
/// as a field far from a sphere's may have.
void require_frozen(const FrozenOrbit<Extended>& frozen, const ZonalGravity& field) {
  const double L = static_cast<double>(frozen.coordinates[3]);
  const double revolution = 2 * std::numbers::pi * L * L * L / (field.mu * field.mu);
  const double return_time = static_cast<double>(frozen.period) / revolution;
  const double residual = static_cast<double>(frozen.residual) / std::sqrt(L);
  constexpr double rounding = 1e-13;
  if (residual <= rounding && return_time > 0.5 && return_time < 1.5) return;
  throw Error(ErrorKind::numerical,
              fmt::format("frozen orbit: none was found; the nearest state moves the pair of the "
                          "pericentre by {:.2g} and returns after {:.4g} revolutions of Kepler's "
                          "ellipse",
                          residual, return_time));
}

/// Where an orbit of a circle is after the returns, (q, p) less the frozen orbit's, and how far
/// that is from its place in the normal form, relative to the radius.
struct FlownCircle {
  std::array<double, 2> end;
  double miss;
};
std::optional<FlownCircle> flown_circle(const ZonalGravity& field, const GaussSettings& gauss,
                                        const FlowSection<double>& section,
                                        const RotationNormalForm& form,
                                        const RotationNormalForm::Circle& circle) {
  try {
    SixNumbers<double> z = section.chief();
    const auto from = form.pair(circle, 0);
    z[q_place] += from[0];
    z[p_place] += from[1];
    const SixNumbers<double> state = section.state(section.energy(), z);
    const ReturnMap<double> back =
        return_near<double>(field, state, flown_returns * form.mean_period(circle), 0, gauss);
    const auto wanted = form.pair(circle, form.angle_after(circle, 0, flown_returns));
    const SixNumbers<double>& end = back.map.end->chief();
    const std::array<double, 2> pair = {end[q_place] - section.chief()[q_place],
                                        end[p_place] - section.chief()[p_place]};
    return FlownCircle{pair, std::hypot(pair[0] - wanted[0], pair[1] - wanted[1]) / circle.radius};
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    return std::nullopt;
  }
}

/// Refuses a normal form, made of a return in double precision, whose turn is not that of the
/// multipliers, found in extended precision: the sum of multipliers near 1 loses their angle's
/// digits.
void require_resolved_turn(const RotationNormalForm& form, const FrozenOrbitStudy& study) {
  if (!study.is_stable()) return;
  // 2 - t = 4 sin^2(pi rho)
  const double turn = std::asin(std::sqrt(-study.trace_less_2) / 2) / std::numbers::pi;
  const double miss = std::abs(std::abs(form.rotation_number({})) - turn) / turn;
  if (miss <= FrozenOrbitStudy::largest_miss) return;
  throw Error(ErrorKind::numerical,
              fmt::format("normal form: neighbours turn about the frozen orbit in {:.6g} "
                          "revolutions, too slowly for a return in double precision, which "
                          "misses that by {:.1g} of it",
                          1 / turn, miss));
}

void add_normal_form(const ZonalGravity& field, const SixNumbers<double>& chief,
                     const ProgressCallback& progress, FrozenOrbitStudy& study) {
  const GaussSettings gauss = scene_gauss(study.scene, search_tolerance);
  const ReturnMap<double> back =
      first_return<double>(field, six_numbers(study.state), study.scene.order, gauss);
  const FlowSection<double> section(field, ChartName::nodal, six_numbers(study.state));
  const RotationNormalForm form(back.flight);
  require_resolved_turn(form, study);
  study.smallest_divisor = form.smallest_divisor();
  study.flown_revolutions = flown_returns;
  const double unit = std::sqrt(section.chief()[3]);
  const double length_km = study.semi_major_axis * study.scene.units.length_km;
  const auto add = [&](const RotationNormalForm::Circle& circle, bool is_chiefs) {
    LibrationCircle told{is_chiefs,
                         circle.radius / unit,
                         form.rotation_number(circle),
                         form.mean_period(circle),
                         form.mean_node(circle),
                         form.action(circle),
                         study.residual,
                         {},
                         {}};
    if (circle.radius > 0) {
      const std::optional<FlownCircle> flown = flown_circle(field, gauss, section, form, circle);
      told.miss = flown ? std::optional(flown->miss) : std::nullopt;
      if (flown) told.flown_to = {flown->end[0] / unit, flown->end[1] / unit};
      for (int k = 0; k <= points_of_curve; ++k) {
        const auto pair = form.pair(circle, 2 * std::numbers::pi * k / points_of_curve);
        told.curve.push_back({pair[0] / unit, pair[1] / unit});
      }
    }
    study.circles.push_back(std::move(told));
  };
  constexpr std::array<double, 4> amplitudes_km = {1, 10, 100, 1000};
  for (const double amplitude_km : amplitudes_km) {
    if (progress) progress("normal form", 0.5);
    if (amplitude_km < length_km) add({amplitude_km / length_km * unit, 0, 0}, false);
  }
  const SixNumbers<double> z = FlowSection<double>(field, ChartName::nodal, chief).chief();
  if (const auto place = form.place_of(
          {z[q_place] - section.chief()[q_place], z[p_place] - section.chief()[p_place]})) {
    add(place->circle, true);
  }
  // The miss grows as a power of the amplitude: by factors, then by halves of what is between.
  constexpr double factor = 2;
  constexpr double largest = 0.5;
  double good = 0;
  double bad = 0;
  double at = 1e-3;
  constexpr int most_trials = 14;
  for (int i = 0; i < most_trials && (bad == 0 || bad > 1.1 * good); ++i) {
    if (progress) progress("reach", static_cast<double>(i) / most_trials);
    const RotationNormalForm::Circle circle{at * unit, 0, 0};
    const std::optional<FlownCircle> flown = flown_circle(field, gauss, section, form, circle);
    study.flown_amplitudes.push_back(
        {at, form.rotation_number(circle), flown ? std::optional(flown->miss) : std::nullopt});
    (flown && flown->miss <= FrozenOrbitStudy::largest_miss ? good : bad) = at;
    if (good >= largest) break;
    at = bad == 0    ? std::min(largest, at * factor)
         : good == 0 ? at / factor
                     : std::sqrt(good * bad);
  }
  study.reach = good;
  std::sort(study.flown_amplitudes.begin(), study.flown_amplitudes.end(),
            [](const auto& a, const auto& b) { return a.amplitude < b.amplitude; });
}

}  // namespace

double FrozenOrbitStudy::length_m(double of_eccentricity) const {
  return of_eccentricity * semi_major_axis * scene.units.length_km * 1000;
}

std::array<double, 2> FrozenOrbitStudy::multiplier() const {
  const double half = trace / 2;
  // (t/2)^2 - 1 = (t - 2)(t + 2)/4 without the loss of digits.
  const double discriminant = trace_less_2 * (trace + 2) / 4;
  if (discriminant < 0) return {half, std::sqrt(-discriminant)};
  return {half + std::copysign(std::sqrt(discriminant), half), 0};
}

FrozenOrbitStudy study_frozen_orbit(const Scene& scene, const ProgressCallback& progress) {
  require_coasting(scene);
  require_formation_problem(scene, true, "nominal");
  FrozenOrbitStudy study;
  study.scene = scene;
  const ZonalGravity field = orbit_field(scene);
  const SixNumbers<double> chief = six_numbers(scene.nominal);
  bool has_harmonics = false;
  for (int n = ZonalCoefficients::lowest; n <= ZonalCoefficients::highest; ++n) {
    has_harmonics = has_harmonics || field.J[n] != 0;
  }
  if (!has_harmonics) {
    throw Error(ErrorKind::numerical,
                "frozen orbit: without zonal harmonics every ellipse is the same after each "
                "revolution, and none is singled out");
  }
  if (progress) progress("frozen orbit", 0);
  require_nodal_section(scene);
  const SixNumbers<double> z = FlowSection<double>(field, ChartName::nodal, chief).chief();
  const double cosine = inclination_cosine(z);
  const bool from_circle = std::abs(5 * cosine * cosine - 1) > critical;
  const auto coarse =
      find_frozen_orbit<double>(field, chief, from_circle, scene_gauss(scene, search_tolerance));
  if (progress) progress("frozen orbit", 0.3);
  const auto frozen = find_frozen_orbit<Extended>(field, converted<Extended>(coarse.state), false,
                                                  scene_gauss(scene, refining_tolerance));
  require_frozen(frozen, field);
  const SixNumbers<double> state = converted<double>(frozen.state);
  study.state.assign(state.begin(), state.end());
  const SixNumbers<double> at = converted<double>(frozen.coordinates);
  study.semi_major_axis = at[3] * at[3] / field.mu;
  study.eccentricity = eccentricity_of(at);
  study.inclination_deg = std::acos(inclination_cosine(at)) * 180 / std::numbers::pi;
  study.pericentre_deg = std::atan2(-at[q_place], at[p_place]) * 180 / std::numbers::pi;
  if (study.pericentre_deg < 0) study.pericentre_deg += 360;
  study.pericentre_depth = field.radius - study.semi_major_axis * (1 - study.eccentricity);
  study.nodal_period = static_cast<double>(frozen.period);
  study.node = static_cast<double>(frozen.node);
  study.residual = static_cast<double>(frozen.residual);
  study.trace = static_cast<double>(frozen.trace());
  study.trace_less_2 = static_cast<double>(Extended(frozen.trace() - 2));
  const auto& d = frozen.derivative;
  study.area_defect = static_cast<double>(Extended(d[0] * d[3] - d[1] * d[2] - 1));
  study.iterations = frozen.iterations;
  std::vector<CheckedFlight> flights = flights_of(scene, study.nodal_period, false);
  flights.push_back({"the frozen orbit", study.state, scene.start_time, study.nodal_period});
  study.checks = flight_checks(scene, flights);
  try {
    add_normal_form(field, chief, progress, study);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    study.failure = error.what();
    study.circles.clear();
  }
  return study;
}

}  // namespace hamjet
