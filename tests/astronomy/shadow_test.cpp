#include "astronomy/shadow.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

// The cone's geometry by closed forms, the overlap of discs by a quadrature that knows no arcs.

namespace hamjet {
namespace {

using Place = std::array<double, 3>;

constexpr double distance_of_sun = 23455;
const Shadow earth = {1, 109.08};
const Place sun = {distance_of_sun, 0, 0};

/// The part of a disc of radius a that a disc of radius b at the distance c leaves free: chords
/// across the line of both centres, at the points of Gauss's rule in the angle.
double free_part(double a, double b, double c) {
  constexpr int count = 200000;
  double free = 0, whole = 0;
  for (int k = 0; k < count; ++k) {
    const double phi = std::numbers::pi * (k + 0.5) / count;
    const double x = a * std::cos(phi);
    const double chord = a * std::sin(phi);
    const double width = a * std::sin(phi);
    const double from_other = x - c;
    const double covered = from_other * from_other < b * b
                               ? std::min(chord, std::sqrt(b * b - from_other * from_other))
                               : 0;
    free += (chord - covered) * width;
    whole += chord * width;
  }
  return free / whole;
}

/// A place behind the sphere at a distance and an angle from the axis.
Place behind(double distance, double angle) {
  return {-distance * std::cos(angle), 0.6 * distance * std::sin(angle),
          -0.8 * distance * std::sin(angle)};
}

TEST(Shadow, FractionIsThatOfAQuadratureOfDiscs) {
  for (const double distance : {1.08, 1.4, 6.6, 60.0, 300.0}) {
    const double middle = std::asin(1 / distance);
    const double width = std::asin(earth.sun_radius / (distance_of_sun + distance));
    for (const double part : {-0.9, -0.4, 0.0, 0.3, 0.95}) {
      const Place place = behind(distance, middle + part * width);
      // The angular radii, and the angle between both centres, by the scalar product.
      const Place to_sun = {sun[0] - place[0], -place[1], -place[2]};
      const double d = std::hypot(to_sun[0], to_sun[1], to_sun[2]);
      const double cosine =
          -(to_sun[0] * place[0] + to_sun[1] * place[1] + to_sun[2] * place[2]) / (d * distance);
      const double a = std::asin(earth.sun_radius / d), b = std::asin(1 / distance);
      // The arc cosine loses digits for small angles: some 1e-9 here.
      EXPECT_NEAR(sunlit_fraction(earth, place, sun), free_part(a, b, std::acos(cosine)), 2e-6)
          << distance << " " << part;
    }
  }
}

TEST(Shadow, HalfWhereTheStraightEdgeCrossesTheCentre) {
  // Seen from low orbits the sphere's edge is nearly straight: half of the disc is left where its
  // centre lies on the edge, but for a part of the ratio of both radii. The Sun is that near that
  // its direction is another one than the axis, by 1 / distance.
  const double height = 1.08;
  const double a = std::asin(earth.sun_radius / distance_of_sun);
  const Place place = behind(height, std::asin(1 / height) + 1 / distance_of_sun);
  EXPECT_NEAR(sunlit_fraction(earth, place, sun), 0.5, a / 2);
}

TEST(Shadow, RingBeyondTheApex) {
  // Beyond the umbra's apex on the axis the sphere covers the square of the ratio of the radii.
  const double distance = 300;
  const double ratio =
      std::asin(1 / distance) / std::asin(earth.sun_radius / (distance_of_sun + distance));
  ASSERT_LT(ratio, 1);
  EXPECT_NEAR(sunlit_fraction(earth, {-distance, 0, 0}, sun), 1 - ratio * ratio, 1e-12);
}

TEST(Shadow, SignsOfDistancesAgreeWithTheFraction) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> spread(-1, 1);
  int inside_penumbra = 0, inside_umbra = 0, inside_antumbra = 0;
  for (int k = 0; k < 20000; ++k) {
    const double reach = k % 2 == 0 ? 8 : 500;
    const Place place = {reach * spread(random), 2.5 * spread(random), 2.5 * spread(random)};
    if (std::hypot(place[0], place[1], place[2]) < 1.001) continue;
    const auto [penumbra, umbra, antumbra] = distances_to_shadow(earth, place, sun);
    const double fraction = sunlit_fraction(earth, place, sun);
    EXPECT_EQ(penumbra < 0, fraction < 1) << k;
    EXPECT_EQ(umbra < 0, fraction == 0) << k;
    const double to_sun = std::hypot(place[0] - sun[0], place[1], place[2]);
    const double a = std::asin(earth.sun_radius / to_sun);
    const double b = std::asin(1 / std::hypot(place[0], place[1], place[2]));
    EXPECT_EQ(antumbra<0, a> b && std::abs(fraction - (1 - b * b / (a * a))) < 1e-14) << k;
    inside_penumbra += penumbra < 0 ? 1 : 0;
    inside_umbra += umbra < 0 ? 1 : 0;
    inside_antumbra += antumbra < 0 ? 1 : 0;
  }
  EXPECT_GT(inside_penumbra, inside_umbra + inside_antumbra);
  EXPECT_GT(inside_umbra, 100);
  EXPECT_GT(inside_antumbra, 10);
}

/// A circle of radius r at the angular velocity 1 whose plane is inclined to the Sun's direction;
/// at the time 0 it is nearest to the axis behind.
ShadowedPath circle(double r, double inclination) {
  return {[=](double t) {
            return Place{-r * std::cos(t) * std::cos(inclination), r * std::sin(t),
                         r * std::cos(t) * std::sin(inclination)};
          },
          [](double) { return sun; }, r};
}

std::vector<ShadowCrossing> crossings(const ShadowedPath& path, double from, double to) {
  std::vector<ShadowCrossing> result;
  const auto start = distances_to_shadow(earth, path.position(from), path.sun(from));
  std::array<bool, 3> inside{};
  for (std::size_t i = 0; i < 3; ++i) inside[i] = start[i] < 0;
  while (const auto next = next_crossing(earth, path, inside, from, to, 1e-5)) {
    result.push_back(*next);
    from = next->time;
    bool& side = inside[static_cast<std::size_t>(next->edge)];
    side = !side;
  }
  return result;
}

/// The angles from the axis at which a circle of radius r meets the cones: its lines touch the
/// sphere, so that r sin(theta -+ alpha) = R with sin alpha = (R_sun +- R) / distance.
double penumbra_angle(double r) {
  return std::asin(1 / r) + std::asin((earth.sun_radius + 1) / distance_of_sun);
}
double umbra_angle(double r) {
  return std::asin(1 / r) - std::asin((earth.sun_radius - 1) / distance_of_sun);
}

TEST(Shadow, EdgesOfACircleThroughTheAxis) {
  for (const double r : {1.05, 1.5, 6.6}) {
    for (const double direction : {1.0, -1.0}) {
      const auto found =
          crossings(circle(r, 0), -3 * direction, (2 * std::numbers::pi + 2) * direction);
      ASSERT_GE(found.size(), 8U) << r;
      const double expected[] = {-penumbra_angle(r), -umbra_angle(r), umbra_angle(r),
                                 penumbra_angle(r)};
      for (std::size_t k = 0; k < 8; ++k) {
        const double turn = k < 4 ? 0 : 2 * std::numbers::pi;
        EXPECT_NEAR(found[k].time * direction, expected[k % 4] + turn, 1e-11) << r << " " << k;
        const bool is_outer = k % 4 == 0 || k % 4 == 3;
        EXPECT_EQ(found[k].edge, is_outer ? ShadowEdge::penumbra : ShadowEdge::umbra);
      }
    }
  }
}

TEST(Shadow, PathsThatGrazeTheConeAreSeen) {
  // Least angles from the axis below that of the penumbra by so much: the shallowest goes 1e-7 into
  // it (60 cm of the Earth's), for 1e-3 of a radian.
  for (const double depth : {1e-2, 1e-4, 1e-7}) {
    const double r = 6.6;
    const double inclination = penumbra_angle(r) - depth;
    const auto found = crossings(circle(r, inclination), -2, 2);
    const double at = std::acos(std::cos(penumbra_angle(r)) / std::cos(inclination));
    ASSERT_EQ(found.size(), depth == 1e-2 ? 4U : 2U) << depth;
    // A tangential passage magnifies rounding by the square root of the depth.
    EXPECT_NEAR(found.front().time, -at, 1e-14 / at) << depth;
    EXPECT_NEAR(found.back().time, at, 1e-14 / at) << depth;
  }
  EXPECT_TRUE(crossings(circle(6.6, penumbra_angle(6.6) + 1e-7), -2, 2).empty());
  // Nothing is behind the sphere on the day side.
  EXPECT_TRUE(crossings(circle(1.05, 0), 2, 4).empty());
}

}  // namespace
}  // namespace hamjet
