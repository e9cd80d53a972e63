#include "hamjet/relative_motion/deputy_coordinates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "hamjet/dynamics/osculating_elements.hpp"
#include "hamjet/error.hpp"

// A deputy's deviation in each form. Expected: the definitions of the forms, evaluated on classical
// elements, whose states come from state_from_elements, which shares no formula with the code under
// test; closed forms on circular orbits; derivatives as differences along Kepler's motion.

namespace hamjet {
namespace {

constexpr double mu_km = 398600.4415, pi = std::numbers::pi, degree = pi / 180;
constexpr double length_km = 7000;

MetricUnits units_of_orbit() {
  return {length_km * 1000, std::sqrt(length_km * length_km * length_km / mu_km)};
}

/// Osculating elements in double precision, which the formulas of the tests compute with.
struct Elements {
  double semi_major_axis_km, eccentricity, inclination_deg, ascending_node_deg,
      argument_of_perigee_deg, true_anomaly_deg;
};

std::vector<double> state_of(const Elements& elements) {
  const auto& [a, e, i, node, perigee, anomaly] = elements;
  const CartesianState state = state_from_elements({a, e, i, node, perigee, anomaly}, mu_km);
  const double speed_km_s = units_of_orbit().velocity_m_s() / 1000;
  std::vector<double> numbers;
  for (const auto& x : state.position_km) numbers.push_back(convert<double>(x) / length_km);
  for (const auto& v : state.velocity_km_s) numbers.push_back(convert<double>(v) / speed_km_s);
  return numbers;
}

DeputyCoordinates coordinates_of(const std::vector<double>& chief, DeputyForm form) {
  return {chief, units_of_orbit(), 1, form};
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result;
  for (std::size_t i = 0; i < 6; ++i) result.push_back(a[i] - b[i]);
  return result;
}

/// Kepler's equation's right side: the mean anomaly of a true one, by the eccentric one.
double mean_anomaly(const Elements& orbit) {
  const double e = orbit.eccentricity;
  const double E =
      2 * std::atan(std::sqrt((1 - e) / (1 + e)) * std::tan(orbit.true_anomaly_deg * degree / 2));
  return E - e * std::sin(E);
}

const Elements chief_orbit{8000, 0.1, 55, 30, 70, 40};
const Elements deputy_orbit{8000.02, 0.1001, 55.003, 30.002, 70.01, 39.98};

TEST(DeputyCoordinates, RelativeElementsAreThoseOfTheDefinition) {
  const auto& c = chief_orbit;
  const auto& d = deputy_orbit;
  const std::vector<double> chief = state_of(c);
  const auto found = coordinates_of(chief, DeputyForm::relative_elements)
                         .coordinates(difference(state_of(d), chief));
  const double a = c.semi_major_axis_km * 1000;
  const double w_c = c.argument_of_perigee_deg * degree, w_d = d.argument_of_perigee_deg * degree;
  const double node = (d.ascending_node_deg - c.ascending_node_deg) * degree;
  const double i = c.inclination_deg * degree;
  const double u = w_d + mean_anomaly(d) - w_c - mean_anomaly(c);
  const double expected[] = {(d.semi_major_axis_km - c.semi_major_axis_km) * 1000,
                             a * (u + node * std::cos(i)),
                             a * (d.eccentricity * std::cos(w_d) - c.eccentricity * std::cos(w_c)),
                             a * (d.eccentricity * std::sin(w_d) - c.eccentricity * std::sin(w_c)),
                             a * (d.inclination_deg - c.inclination_deg) * degree,
                             a * node * std::sin(i)};
  // The states are rounded to doubles: 1e-16 of 8000 km is 1 nm, which the elements enlarge.
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(found[k], expected[k], 5e-8) << k;
}

TEST(DeputyCoordinates, ElementDifferencesAreThoseOfTheDefinition) {
  const auto& c = chief_orbit;
  const auto& d = deputy_orbit;
  const std::vector<double> chief = state_of(c);
  const auto found = coordinates_of(chief, DeputyForm::element_differences)
                         .coordinates(difference(state_of(d), chief));
  const double w_c = c.argument_of_perigee_deg * degree, w_d = d.argument_of_perigee_deg * degree;
  const double expected[] = {(d.semi_major_axis_km - c.semi_major_axis_km) * 1000,
                             d.argument_of_perigee_deg + d.true_anomaly_deg -
                                 c.argument_of_perigee_deg - c.true_anomaly_deg,
                             d.inclination_deg - c.inclination_deg,
                             d.eccentricity * std::cos(w_d) - c.eccentricity * std::cos(w_c),
                             d.eccentricity * std::sin(w_d) - c.eccentricity * std::sin(w_c),
                             d.ascending_node_deg - c.ascending_node_deg};
  const double rounding[] = {5e-8, 1e-13, 1e-13, 1e-14, 1e-14, 1e-13};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(found[k], expected[k], rounding[k]) << k;
}

TEST(DeputyCoordinates, CurvilinearOnOneCircleIsTheArcAlone) {
  // 300 km behind on the chief's own circular orbit: only the arc is not zero, and it is exact.
  const double a = 7000, arc = -300e3;
  const std::vector<double> chief = state_of({a, 0, 98, 10, 0, 50});
  const std::vector<double> deputy = state_of({a, 0, 98, 10, 0, 50 + arc / (a * 1000) / degree});
  const auto found =
      coordinates_of(chief, DeputyForm::curvilinear).coordinates(difference(deputy, chief));
  const double expected[] = {0, arc, 0, 0, 0, 0};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(found[k], expected[k], 1e-8) << k;
  // In the plane across it, at the same place: the angle out of the plane is the inclination's.
  const std::vector<double> tilted = state_of({a, 0, 98.1, 10, 0, 90});
  const auto out = coordinates_of(state_of({a, 0, 98, 10, 0, 90}), DeputyForm::curvilinear)
                       .coordinates(difference(tilted, state_of({a, 0, 98, 10, 0, 90})));
  EXPECT_NEAR(out[2], a * 1000 * 0.1 * degree, 1e-8);
  EXPECT_NEAR(out[0], 0, 1e-8);
}

TEST(DeputyCoordinates, CurvilinearRatesAreDerivativesByTime) {
  // Along Kepler's motion, by the mean anomaly: the error of a central difference over 2 h goes as
  // h^2 of the third derivative, some 1e-3 m/s over the square of the time unit, 930 s.
  const auto moved = [](Elements orbit, double t_s) {
    const double e = orbit.eccentricity, a = orbit.semi_major_axis_km;
    const double M = mean_anomaly(orbit) + t_s * std::sqrt(mu_km / (a * a * a));
    double E = M;
    for (int i = 0; i < 60; ++i) E = M + e * std::sin(E);
    orbit.true_anomaly_deg = 2 * std::atan(std::sqrt((1 + e) / (1 - e)) * std::tan(E / 2)) / degree;
    return state_of(orbit);
  };
  const auto at = [&](double t_s) {
    const std::vector<double> chief = moved(chief_orbit, t_s);
    return coordinates_of(chief, DeputyForm::curvilinear)
        .coordinates(difference(moved(deputy_orbit, t_s), chief));
  };
  const double h = 0.5;
  const auto before = at(-h), now = at(0), after = at(h);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR((after[k] - before[k]) / (2 * h), now[k + 3], 3e-7) << k;
    EXPECT_GT(std::abs(now[k + 3]), 1e-4) << k;
  }
}

TEST(DeputyCoordinates, BothWaysAreInverseToRounding) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const DeputyForm form :
       {DeputyForm::rtn_rotating, DeputyForm::rtn_inertial, DeputyForm::inertial,
        DeputyForm::curvilinear, DeputyForm::relative_elements, DeputyForm::element_differences}) {
    for (int k = 0; k < 40; ++k) {
      const double e = k < 3 ? 0 : 0.45 * (1 + uniform(generator));
      const std::vector<double> chief =
          state_of({7000 / (1 - e), e, 90 * (1.001 + uniform(generator)), 180 * uniform(generator),
                    180 * uniform(generator), 180 * uniform(generator)});
      const auto coordinates = coordinates_of(chief, form);
      // The sizes are from a metre to a thousand kilometres.
      const double size = std::pow(10, -3.4 + 3.4 * uniform(generator));
      std::vector<double> deviation;
      for (int i = 0; i < 6; ++i) deviation.push_back(0.1 * size * uniform(generator));
      const auto back = coordinates.deviation(coordinates.coordinates(deviation));
      // The coordinates are rounded to doubles; what that does to the state is told by moving each
      // by an ulp.
      const auto given = coordinates.coordinates(deviation);
      for (std::size_t i = 0; i < 6; ++i) {
        double allowed = 4e-16 * size;
        for (std::size_t j = 0; j < 6; ++j) {
          auto moved = given;
          moved[j] = std::nextafter(moved[j], 2 * moved[j] + 1);
          allowed += 2 * std::abs(coordinates.deviation(moved)[i] - back[i]);
        }
        EXPECT_NEAR(back[i], deviation[i], allowed)
            << components_of(form)[0].name << ", draw " << k << ", number " << i;
      }
    }
  }
}

TEST(DeputyCoordinates, NearTheChiefCurvilinearIsRtnToSecondOrder) {
  const std::vector<double> chief = state_of(chief_orbit);
  const std::array<double, 6> rtn = {30, -50, 20, 0.02, -0.03, 0.01};
  const auto deviation = coordinates_of(chief, DeputyForm::rtn_rotating).deviation(rtn);
  const auto curved = coordinates_of(chief, DeputyForm::curvilinear).coordinates(deviation);
  for (std::size_t k = 0; k < 6; ++k) {
    // d^2 / r is 6e-4 m, and a thousandth of that per second in the rates.
    EXPECT_NEAR(curved[k], rtn[k], k < 3 ? 6e-4 : 2e-6) << k;
  }
}

TEST(DeputyCoordinates, RefusesWhatHasNoElements) {
  const std::vector<double> below_the_centre = {-9e6, 0, 0, 0, 0, 0};
  const std::vector<double> equatorial = state_of({8000, 0.1, 0, 0, 70, 40});
  for (const DeputyForm form : {DeputyForm::relative_elements, DeputyForm::element_differences}) {
    EXPECT_THROW(coordinates_of(equatorial, form), Error);
    const std::vector<double> chief = state_of(chief_orbit);
    const auto coordinates = coordinates_of(chief, form);
    // A deputy with twice the speed escapes.
    EXPECT_THROW(
        coordinates.coordinates(std::vector<double>{0, 0, 0, chief[3], chief[4], chief[5]}), Error);
    EXPECT_THROW(coordinates.deviation(below_the_centre), Error);
  }
  EXPECT_NO_THROW(coordinates_of(equatorial, DeputyForm::curvilinear));
  EXPECT_THROW(coordinates_of(equatorial, DeputyForm::curvilinear).deviation(below_the_centre),
               Error);
}

}  // namespace
}  // namespace hamjet
