#include "hamjet/dynamics/osculating_elements.hpp"

#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <limits>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

using Vector3 = std::array<Extended, 3>;

constexpr double earth_mu = 398600.4405;
/// The tolerance is a few units in the last place of 113 bits.
const Extended round_off = Extended(1e-32);

Extended pi() { return boost::math::constants::pi<Extended>(); }

Extended dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

void expect_close(const Extended& value, const Extended& expected, const Extended& tolerance) {
  EXPECT_LE(abs(value - expected), tolerance * (1 + abs(expected)))
      << value.str(36) << " instead of " << expected.str(36);
}

OsculatingElements general_elements() { return {26600, 0.74, 63.4, 227.89, 281.5, 123.75}; }

// Expected: the definition of sine and cosine at multiples of a right angle, whatever the turns.
TEST(SineCosineOfDegrees, IsExactAtRightAngles) {
  const int sines[] = {0, 1, 0, -1};
  for (int quadrant = -9; quadrant <= 9; ++quadrant) {
    const SineCosine value = sine_cosine_of_degrees(Extended(90 * quadrant));
    const auto turn = static_cast<std::size_t>((quadrant + 12) % 4);
    EXPECT_EQ(value.sine, sines[turn]) << quadrant;
    EXPECT_EQ(value.cosine, sines[(turn + 1) % 4]) << quadrant;
  }
  const SineCosine many_turns = sine_cosine_of_degrees(Extended(std::ldexp(360.0, 900) + 0));
  EXPECT_EQ(many_turns.sine, 0);
  EXPECT_EQ(many_turns.cosine, 1);
}

// Expected: sin 30 = 1/2, tan 45 = 1, and sin 15 = (sqrt 6 - sqrt 2)/4, all around the circle.
TEST(SineCosineOfDegrees, AgreesWithClosedForms) {
  const Extended half = 0.5;
  const Extended sine_15 = (sqrt(Extended(6)) - sqrt(Extended(2))) / 4;
  expect_close(sine_cosine_of_degrees(30).sine, half, round_off);
  expect_close(sine_cosine_of_degrees(120).cosine, -half, round_off);
  expect_close(sine_cosine_of_degrees(210).sine, -half, round_off);
  expect_close(sine_cosine_of_degrees(-60).cosine, half, round_off);
  expect_close(sine_cosine_of_degrees(345).sine, -sine_15, round_off);
  expect_close(sine_cosine_of_degrees(105).cosine, -sine_15, round_off);
  const SineCosine diagonal = sine_cosine_of_degrees(225);
  expect_close(diagonal.sine, diagonal.cosine, round_off);
}

// Expected: at perigee r = a (1 - e) and v^2 = mu/a (1 + e)/(1 - e), at right angles.
TEST(StateFromElements, StartsAtPerigee) {
  const CartesianState state = state_from_elements({10000, 0.3, 60, 0, 0, 0}, earth_mu);
  const Extended e = 0.3;
  const Extended speed = sqrt(Extended(earth_mu) / 10000 * (1 + e) / (1 - e));
  expect_close(state.position_km[0], 10000 * (1 - e), round_off);
  EXPECT_EQ(state.position_km[1], 0);
  EXPECT_EQ(state.position_km[2], 0);
  EXPECT_EQ(state.velocity_km_s[0], 0);
  expect_close(state.velocity_km_s[1], speed / 2, round_off);
  expect_close(state.velocity_km_s[2], speed * sqrt(Extended(3)) / 2, round_off);
}

// Expected: uniform motion on a circle in the equatorial plane; the three angles simply add.
TEST(StateFromElements, GivesCircularEquatorialOrbit) {
  const CartesianState state = state_from_elements({42164, 0, 0, 10, 15, 5}, earth_mu);
  const Extended speed = sqrt(Extended(earth_mu) / 42164);
  const Extended cosine = sqrt(Extended(3)) / 2;
  expect_close(state.position_km[0], 42164 * cosine, round_off);
  expect_close(state.position_km[1], Extended(42164) / 2, round_off);
  EXPECT_EQ(state.position_km[2], 0);
  expect_close(state.velocity_km_s[0], -speed / 2, round_off);
  expect_close(state.velocity_km_s[1], speed * cosine, round_off);
  EXPECT_EQ(state.velocity_km_s[2], 0);
}

// Expected: Vallado's example 2-6 (Fundamentals of Astrodynamics, 4th ed.), printed to 3 digits
// after the point in km; its semi-latus rectum of 11067.790 km is a (1 - e^2).
TEST(StateFromElements, AgreesWithPublishedExample) {
  const double e = 0.83285;
  const CartesianState state =
      state_from_elements({11067.790 / (1 - e * e), e, 87.87, 227.89, 53.38, 92.335}, 398600.4418);
  const double position[] = {6525.344, 6861.535, 6449.125};
  const double velocity[] = {4.902276, 5.533124, -1.975709};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(static_cast<double>(state.position_km[i]), position[i], 0.06) << i;
    EXPECT_NEAR(static_cast<double>(state.velocity_km_s[i]), velocity[i], 5e-5) << i;
  }
}

// Expected: the integrals of Kepler's problem written with the elements: energy -mu/2a, angular
// momentum sqrt(mu a (1 - e^2)) about the normal (sin node sin i, -cos node sin i, cos i),
// eccentricity vector of length e at the true anomaly from the position.
TEST(StateFromElements, HasTheIntegralsOfItsElements) {
  const OsculatingElements elements = general_elements();
  const Extended mu = earth_mu;
  const Extended a = elements.semi_major_axis_km;
  const Extended e = elements.eccentricity;
  const CartesianState state = state_from_elements(elements, earth_mu);
  const Vector3& r = state.position_km;
  const Vector3& v = state.velocity_km_s;
  const Extended distance = sqrt(dot(r, r));
  expect_close((dot(v, v) / 2 - mu / distance) * 2 * a / mu, -1, 100 * round_off);

  const Extended size = sqrt(mu * a * (1 - e * e));
  const Vector3 momentum = cross(r, v);
  const SineCosine node = sine_cosine_of_degrees(elements.ascending_node_deg);
  const SineCosine inclination = sine_cosine_of_degrees(elements.inclination_deg);
  expect_close(momentum[0] / size, node.sine * inclination.sine, 100 * round_off);
  expect_close(momentum[1] / size, -node.cosine * inclination.sine, 100 * round_off);
  expect_close(momentum[2] / size, inclination.cosine, 100 * round_off);

  Vector3 eccentricity = cross(v, momentum);
  for (std::size_t i = 0; i < 3; ++i) eccentricity[i] = eccentricity[i] / mu - r[i] / distance;
  expect_close(dot(eccentricity, eccentricity), e * e, 100 * round_off);
  const SineCosine anomaly = sine_cosine_of_degrees(elements.true_anomaly_deg);
  expect_close(dot(eccentricity, r) / distance, e * anomaly.cosine, 100 * round_off);
  // Perigee stands at the argument of perigee from the node, on the side of positive z below 180.
  const SineCosine perigee = sine_cosine_of_degrees(elements.argument_of_perigee_deg);
  expect_close(eccentricity[2], e * perigee.sine * inclination.sine, 100 * round_off);
}

// Expected: zeros that hold for every a and e, because a factor sin or cos of a right angle is 0.
TEST(StateFromElements, KeepsExactZeros) {
  const auto is_plus_zero = [](const Extended& x) { return x == 0 && !signbit(x); };
  for (const double inclination : {0.0, 180.0, 360.0, -180.0}) {
    const CartesianState state =
        state_from_elements({9000, 0.1, inclination, 12.3, 45.6, 78.9}, earth_mu);
    EXPECT_TRUE(is_plus_zero(state.position_km[2])) << inclination;
    EXPECT_TRUE(is_plus_zero(state.velocity_km_s[2])) << inclination;
  }
  for (const double node : {0.0, 180.0, 720.0}) {  // polar, in the plane of x and z
    const CartesianState state = state_from_elements({9000, 0.1, 90, node, 45.6, 78.9}, earth_mu);
    EXPECT_TRUE(is_plus_zero(state.position_km[1])) << node;
    EXPECT_TRUE(is_plus_zero(state.velocity_km_s[1])) << node;
  }
  for (const double anomaly : {0.0, 180.0}) {  // at an apsis on the line of nodes
    const CartesianState state = state_from_elements({9000, 0.1, 33.3, 0, 0, anomaly}, earth_mu);
    EXPECT_TRUE(is_plus_zero(state.position_km[1])) << anomaly;
    EXPECT_TRUE(is_plus_zero(state.position_km[2])) << anomaly;
    EXPECT_TRUE(is_plus_zero(state.velocity_km_s[0])) << anomaly;
  }
  // 45 + 45 degrees from the node is the highest point: no x.
  const CartesianState top = state_from_elements({9000, 0.1, 33.3, 0, 45, 45}, earth_mu);
  EXPECT_TRUE(is_plus_zero(top.position_km[0]));
}

TEST(StateFromElements, RefusesWhatIsNoEllipse) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const OsculatingElements bad[] = {{0, 0.1, 0, 0, 0, 0},      {-7000, 0.1, 0, 0, 0, 0},
                                    {7000, 1, 0, 0, 0, 0},     {7000, -0.1, 0, 0, 0, 0},
                                    {7000, 0.1, nan, 0, 0, 0}, {7000, 0.1, 0, nan, 0, 0},
                                    {7000, 0.1, 0, 0, nan, 0}, {7000, 0.1, 0, 0, 0, nan}};
  for (const OsculatingElements& elements : bad) {
    EXPECT_THROW(state_from_elements(elements, earth_mu), Error);
  }
  EXPECT_THROW(state_from_elements(general_elements(), 0), Error);
  EXPECT_THROW(state_from_elements(general_elements(), nan), Error);
}

// Expected: Vallado's example 2-1 (Fundamentals of Astrodynamics, 4th ed.), printed to 12 digits
// after the point.
TEST(EccentricAnomaly, AgreesWithPublishedExample) {
  expect_close(eccentric_anomaly_of_mean_deg(235.4, Extended("0.4")), Extended("220.512074767522"),
               Extended("3e-15"));
}

// Expected: Kepler's equation itself, M = E - e sin E, near the hardest places too: near the
// perigee of a long ellipse, where the left side is almost of third order.
TEST(EccentricAnomaly, SatisfiesKeplersEquation) {
  for (const char* const e : {"0", "1e-20", "0.1", "0.74", "0.99", "0.999999999999"}) {
    for (const char* const mean : {"1e-12", "0.001", "17.3", "89", "179.999", "235.4", "-359.9"}) {
      const Extended E = eccentric_anomaly_of_mean_deg(Extended(mean), Extended(e));
      const Extended sine = sine_cosine_of_degrees(E).sine;
      expect_close(E - Extended(e) * sine * 180 / pi(), Extended(mean), round_off);
    }
  }
}

// Expected: at the apsides all three anomalies are one, on a circle everywhere; nothing is rounded.
TEST(EccentricAnomaly, IsTheMeanOneAtTheApsidesAndOnACircle) {
  for (int half_turns = -2; half_turns <= 2; ++half_turns) {
    const Extended angle = 180 * half_turns;
    for (const double e : {0.0, 0.3, 0.999}) {
      EXPECT_EQ(eccentric_anomaly_of_mean_deg(angle, e), angle);
      EXPECT_EQ(true_anomaly_of_eccentric_deg(angle, e), angle);
    }
  }
  for (const double angle : {-270.0, 12.345, 90.0, 300.1}) {
    EXPECT_EQ(eccentric_anomaly_of_mean_deg(angle, 0), angle);
    EXPECT_EQ(true_anomaly_of_eccentric_deg(angle, 0), angle);
  }
}

// Expected: r cos nu = a (cos E - e) and r sin nu = a sqrt(1 - e^2) sin E, with r = a (1 - e cos
// E), and nu on the same turn, nearer to E than half of one.
TEST(TrueAnomaly, IsThatOfThePlaceOnTheEllipse) {
  for (const char* const text : {"0.05", "0.4", "0.9", "0.9999"}) {
    const Extended e(text);
    for (int degrees = -357; degrees < 360; degrees += 17) {
      const Extended nu = true_anomaly_of_eccentric_deg(degrees, e);
      const SineCosine eccentric = sine_cosine_of_degrees(degrees);
      const SineCosine truth = sine_cosine_of_degrees(nu);
      const Extended r = 1 - e * eccentric.cosine;
      const Extended b = sqrt(Extended((1 - e) * (1 + e)));
      expect_close(truth.cosine * r, eccentric.cosine - e, 10 * round_off);
      expect_close(truth.sine * r, b * eccentric.sine, 10 * round_off);
      EXPECT_LT(abs(nu - degrees), 180);
    }
  }
}

TEST(Anomalies, AreThoseOfEllipses) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double e : {-0.1, 1.0, 2.0, nan}) {
    EXPECT_THROW(eccentric_anomaly_of_mean_deg(1, e), Error) << e;
    EXPECT_THROW(true_anomaly_of_eccentric_deg(1, e), Error) << e;
  }
  EXPECT_THROW(eccentric_anomaly_of_mean_deg(nan, 0.1), Error);
  EXPECT_THROW(true_anomaly_of_eccentric_deg(nan, 0.1), Error);
}

// Expected: Kepler's third law, n^2 a^3 = mu.
TEST(SemiMajorAxisOfPeriod, FollowsKeplersThirdLaw) {
  for (const double period : {1e-3, 5400.0, 86164.0905, 1e9}) {
    const Extended a = semi_major_axis_of_period_km(period, earth_mu);
    const Extended n = 2 * pi() / period;
    expect_close(n * n * a * a * a / earth_mu, 1, 10 * round_off);
  }
  EXPECT_THROW(semi_major_axis_of_period_km(0, earth_mu), Error);
  EXPECT_THROW(semi_major_axis_of_period_km(1, -1), Error);
}

// Expected: Vallado's example 2-5 (the same book), which prints the state of its example 2-6 with
// more digits.
TEST(ElementsFromState, AgreeWithPublishedExample) {
  const OsculatingElements found = elements_from_state(
      {{6524.834, 6862.875, 6448.296}, {4.901327, 5.533756, -1.976341}}, 398600.4418);
  EXPECT_NEAR(static_cast<double>(found.semi_major_axis_km), 36127.343, 0.02);
  EXPECT_NEAR(static_cast<double>(found.eccentricity), 0.832853, 2e-6);
  EXPECT_NEAR(static_cast<double>(found.inclination_deg), 87.870, 1e-3);
  EXPECT_NEAR(static_cast<double>(found.ascending_node_deg), 227.898, 1e-3);
  EXPECT_NEAR(static_cast<double>(found.argument_of_perigee_deg), 53.38, 1e-2);
  EXPECT_NEAR(static_cast<double>(found.true_anomaly_deg), 92.335, 1e-3);
}

TEST(ElementsFromState, AreTheInverseOfTheState) {
  for (const double e : {0.0, 1e-6, 0.3, 0.95}) {
    for (const double i : {0.0, 1e-5, 63.4, 90.0, 179.0}) {
      for (const double angle : {0.0, 100.0, 250.0}) {
        const OsculatingElements given = {7000, e, i, i > 0 ? 200.0 : 0, e > 0 ? 300.0 : 0, angle};
        const CartesianState state = state_from_elements(given, earth_mu);
        const CartesianState again =
            state_from_elements(elements_from_state(state, earth_mu), earth_mu);
        for (std::size_t k = 0; k < 3; ++k) {
          // Angles of nearly singular orbits are ill-conditioned, their state is not.
          EXPECT_LE(abs(again.position_km[k] - state.position_km[k]), 1e-25) << e << " " << i;
          EXPECT_LE(abs(again.velocity_km_s[k] - state.velocity_km_s[k]), 1e-28) << e << " " << i;
        }
      }
    }
  }
  EXPECT_THROW(elements_from_state({{7000, 0, 0}, {0, 12, 0}}, earth_mu), Error);
  EXPECT_THROW(elements_from_state({{7000, 0, 0}, {0, 7, 0}}, -1), Error);
}

// Expected: Kepler's equation the other way.
TEST(MeanAnomaly, IsThatOfTheEccentricOne) {
  for (const double e : {0.0, 0.3, 0.97}) {
    for (const double mean_deg : {0.0, 10.0, 179.0, 180.0, 300.0}) {
      const Extended anomaly =
          true_anomaly_of_eccentric_deg(eccentric_anomaly_of_mean_deg(mean_deg, e), e);
      EXPECT_LE(abs(mean_anomaly_of_true_deg(anomaly, e) - mean_deg), 1e-29) << e;
    }
  }
}

// Expected: Kepler's third law, T = 2 pi sqrt(a^3 / mu), with the a that the state was made from.
TEST(OsculatingPeriod, FollowsKeplersThirdLaw) {
  const CartesianState circle = {{Extended(1), Extended(0), Extended(0)},
                                 {Extended(0), Extended(1), Extended(0)}};
  expect_close(osculating_period_s(circle, 1).value(), 2 * pi(), round_off);
  const OsculatingElements elements = general_elements();
  const Extended a = elements.semi_major_axis_km;
  expect_close(osculating_period_s(state_from_elements(elements, earth_mu), earth_mu).value(),
               2 * pi() * sqrt(a * a * a / earth_mu), 100 * round_off);
}

// Expected: v^2 = 2 mu / r is the parabola; below it an ellipse, above it a hyperbola; a motion
// along the radius never comes round.
TEST(OsculatingPeriod, ExistsOnEllipsesOnly) {
  const auto period = [](double radius, double radial, double transverse) {
    return osculating_period_s({{Extended(radius), Extended(0), Extended(0)},
                                {Extended(radial), Extended(transverse), Extended(0)}},
                               1);
  };
  EXPECT_FALSE(period(2, 0, 1).has_value());
  EXPECT_FALSE(period(2, 0, std::nextafter(1.0, 2.0)).has_value());
  EXPECT_TRUE(period(2, 0, std::nextafter(1.0, 0.0)).has_value());
  EXPECT_FALSE(period(1, 0, 0).has_value());
  EXPECT_FALSE(period(1, 0.5, 0).has_value());
}

}  // namespace
}  // namespace hamjet
