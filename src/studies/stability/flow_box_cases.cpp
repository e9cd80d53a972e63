#include "flow_box_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "../../charts/chief_orbit.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/integrators/explicit_runge_kutta.hpp"

namespace hamjet {
namespace {

ChiefOrbit state(const SixNumbers<double>& z, double J2 = 1e-3) {
  ChiefOrbit orbit{{.mu = 1, .radius = 0.9}, z, 2 * std::numbers::pi};
  orbit.field.J[2] = J2;
  return orbit;
}

/// The same orbit with lengths in another unit.
ChiefOrbit in_unit(ChiefOrbit orbit, double length) {
  orbit.field.radius *= length;
  for (std::size_t i = 0; i < 3; ++i) {
    orbit.start[i] *= length;
    orbit.start[3 + i] /= std::sqrt(length);
  }
  orbit.period *= std::pow(length, 1.5);
  return orbit;
}

ChiefOrbit high_zonals() {
  ChiefOrbit orbit = orbit_of(6800, 0.001, 90, 0, 0, 0);
  for (int n = 4; n <= 20; ++n) orbit.field.J[n] = (n % 2 == 0 ? -1 : 1) * 1e-6 / n;
  return orbit;
}

struct Case {
  const char* name;
  ChiefOrbit orbit;
  double time;  ///< in canonical units
  const char* refused =
      nullptr;  ///< a word of the reason for the refusal; null if the case must be answered
};

std::vector<Case> cases() {
  const auto of = [](double e, double i, double anomaly, double a = 9000) {
    return orbit_of(a / (1 - std::min(e, 0.9)), e, i, 30, 40, anomaly);
  };
  const auto turn = [](const char* name, const ChiefOrbit& orbit, double revolutions,
                       const char* refused = nullptr) {
    return Case{name, orbit, revolutions * orbit.period, refused};
  };
  return {
      turn("circle in the equator", state({1, 0, 0, 0, 1, 0}), 1.3),
      turn("circle, the other way in the equator", state({1, 0, 0, 0, -1, 0}), 1.3),
      turn("inclination 1e-6 deg", of(0.1, 1e-6, 10), 1.3),
      turn("inclination just where a node is defined", of(0.1, 0.58, 10), 1.3),
      turn("inclination just where none is", of(0.1, 0.56, 10), 1.3),
      turn("inclination 179.43", of(0.1, 179.43, 10), 1.3),
      turn("polar, from the pole", state({0, 0, 1, 1, 0, 0}), 1.3),
      turn("polar, from the equator", state({1, 0, 0, 0, 0, 1}), 1.3),
      turn("circle, inclined", state({1, 0, 0, 0, std::sqrt(0.5), std::sqrt(0.5)}, 0), 1.3),
      turn("eccentricity 1e-9", of(1e-9, 50, 0), 1.3),
      turn("critical inclination", of(0.1, 63.4349, 10), 3),
      turn("e 0.8 from perigee", of(0.8, 50, 0), 1.3),
      turn("e 0.9 from perigee", of(0.9, 50, 0), 1.3),
      turn("e 0.9 from apogee", of(0.9, 50, 180), 1.3),
      turn("e 0.95 from perigee", of(0.95, 50, 0, 20000), 1.0),
      turn("e 0.98 from apogee", of(0.98, 50, 180, 60000), 0.4),
      turn("e 0.99 from apogee", of(0.99, 50, 180, 120000), 0.3),
      Case{"e 0.995 from perigee", orbit_of(2e6, 0.995, 50, 0, 0, 0), 5},
      Case{"parabola", state({1, 0, 0, 0, std::sqrt(1.0), 1.0}, 0), 4},
      Case{"energy just below zero", state({1, 0, 0, 0, 1.0, 0.999}), 4},
      Case{"hyperbola", state({1, 0, 0, 0.2, 1.3, 0.8}), 4},
      Case{"hyperbola in the equator", state({1, 0, 0, 0, 1.6, 0}), 4},
      Case{"flight past the centre", state({4, 1, 0, -0.7, 0.1, 0.1}), 6},
      turn("backwards", of(0.3, 50, 100), -1.3),
      turn("no time", of(0.3, 50, 100), 0),
      turn("a quarter of a turn", of(0.3, 50, 100), 0.25),
      turn("thirty revolutions", of(0.01, 50, 100), 30),
      turn("lengths in units of 1e-3", in_unit(of(0.3, 50, 100), 1000), 1.3),
      turn("lengths in units of 1e6", in_unit(of(0.3, 50, 100), 1e-6), 1.3),
      turn("zonals to J20", high_zonals(), 1.3),
      turn("an oblate body", state({1, 0, 0, 0, 0.8, 0.7}, 0.05), 1.3),
      turn("a line through the centre", state({1, 0, 0, 0.1, 0, 0}), 0.05, "line"),
      turn("almost a line", state({1, 0, 0, 0.5, 0.002, 0.001}), 0.05, "line"),
      Case{"a fall into the centre", state({1, 0, 0, -0.5, 0.006, 0.001}), 3, "collision"},
  };
}

SixNumbers<double> flown(const FlowBoxCase& orbit, const SixNumbers<double>& start) {
  FlowProblem<double> problem{zonal_gravity(orbit.field),   SeriesSpace::create(1, 0), {0},
                              {start.begin(), start.end()}, ClockTime::epoch(),        orbit.time};
  IntegrationStatistics statistics;
  const auto jet = integrate_fehlberg78<double>(problem, {.tolerance = 1e-14}, statistics);
  SixNumbers<double> end;
  for (std::size_t i = 0; i < 6; ++i) end[i] = jet[i][0];
  return end;
}

/// The largest derivative of the final positions, with velocities in units of the chief's.
double growth(const FlowBoxCase& orbit) {
  FlowProblem<double> problem{zonal_gravity(orbit.field), SeriesSpace::create(6, 1),
                              {0, 1, 2, 3, 4, 5},         {orbit.start.begin(), orbit.start.end()},
                              ClockTime::epoch(),         orbit.time};
  GaussSettings settings;
  settings.tolerance = 1e-8;
  IntegrationStatistics statistics;
  const Matrix<double> flow = linear_part(integrate_gauss<double>(problem, settings, statistics));
  const double r = std::hypot(orbit.start[0], orbit.start[1], orbit.start[2]);
  const double v = std::hypot(orbit.start[3], orbit.start[4], orbit.start[5]);
  return std::max(flow.topLeftCorner(3, 3).cwiseAbs().maxCoeff() * r,
                  flow.topRightCorner(3, 3).cwiseAbs().maxCoeff() * v);
}

}  // namespace

std::vector<StabilityCase> flow_box_cases() {
  std::vector<StabilityCase> result;
  for (const Case& one : cases()) {
    std::string name = "flow box: " + std::string(one.name);
    StabilityExpectation expected;
    expected.source = "flights by Runge-Kutta-Fehlberg 7(8), tolerance 1e-14";
    if (one.refused != nullptr) {
      expected.outcome = CaseOutcome::refused;
      expected.source.clear();
      expected.exit_code = static_cast<int>(ErrorKind::numerical);
      expected.message = one.refused;
    }
    result.push_back({name, name, "Flow boxes at the edges of their charts",
                      "where time and energy, or the sections' elements, come near where they are "
                      "not defined",
                      std::move(expected),
                      FlowBoxCase{one.orbit.field, one.orbit.start, one.time}});
  }
  return result;
}

MeasuredError flow_box_error(const FlowBoxCase& subject) {
  constexpr int order = 2;
  constexpr double size = 1e-7;  // the deputies' distances and speeds over those of the chief
  const SixNumbers<double>& start = subject.start;
  GaussSettings settings;
  settings.tolerance = 1e-13;
  const ChartName section = section_chart(start, subject.field.mu);
  FlowBoxPropagation<double> propagation(subject.field, section, start, order, settings);
  const auto flow = flow_box_deputy_flow(subject.field, propagation.advance_to(subject.time));
  const double r = std::hypot(start[0], start[1], start[2]);
  const double v = std::hypot(start[3], start[4], start[5]);
  MeasuredError result;
  result.quantity = fmt::format("deputies through {} sections{}", name_of(section),
                                section == ChartName::nodal ? "" : " in place of nodal ones");
  // Rounding a start by 2^-53 moves the end by as much, times the growth. Flights and sections
  // round some tens of times, and the flights' tolerance is 90 roundings. Up to 100 roundings were
  // measured, and 340 from apogee at e = 0.9.
  result.tolerance = 2000 * 0x1p-53 * (growth(subject) + r);
  std::mt19937_64 generator(11);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 4; ++k) {
    SixNumbers<double> deviation;
    SixNumbers<double> deputy = start;
    for (std::size_t i = 0; i < 6; ++i) {
      deviation[i] = size * normal(generator) * (i < 3 ? r : v);
      deputy[i] += deviation[i];
    }
    const SixNumbers<double> end = flown(subject, deputy);
    const SixNumbers<double> predicted = flow->predict(deviation, order).deviation;
    for (std::size_t i = 0; i < 3; ++i) {
      const double error = std::abs(flow->chief_end()[i] + predicted[i] - end[i]);
      // NaN counts as larger than any number.
      if (!(error <= result.error)) result.error = error;
    }
  }
  return result;
}

}  // namespace hamjet
