#include "astronomy/sunlight.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "support/errors.hpp"

namespace hamjet {
namespace {

/// The light on the way across the edge of a half-plane over a disc: 1 - (phi - sin phi cos phi) /
/// pi with cos phi = s, from -1 to 1.
double behind_a_straight_edge(double s) {
  const double phi = std::acos(std::min(1.0, std::max(-1.0, s)));
  return (phi - std::sin(phi) * std::cos(phi)) / M_PI;
}

/// Full light to 10, penumbra to 12, none from there.
std::unique_ptr<Sunlight> passage() {
  auto light = std::make_unique<Sunlight>(Sunlight::constant(1));
  light->append(
      10, Sunlight::interpolated([](double t) { return behind_a_straight_edge(t - 11); }, 10, 12));
  light->append(12, Sunlight::constant(0));
  return light;
}

TEST(Sunlight, PenumbraIsMetAndItsMeanIsExact) {
  const auto known = passage();
  const Sunlight& light = *known;
  double sum = 0;
  constexpr int count = 4000;
  for (int k = 0; k < count; ++k) {
    const double t = 10 + 2 * (k + 0.5) / count;
    double value = 0;
    light.expand(t, 0, &value);
    EXPECT_NEAR(value, behind_a_straight_edge(t - 11), 6.5e-5) << t;
    sum += value / count;
  }
  // By symmetry half of the light passes.
  EXPECT_NEAR(sum, 0.5, 1e-8);
  for (const auto& [t, value] : {std::pair{9.0, 1.0}, {13.0, 0.0}, {10.0, 1.0}, {12.0, 0.0}}) {
    double found = 0;
    light.expand(t, 0, &found);
    EXPECT_NEAR(found, value, 1e-12) << t;
  }
}

TEST(Sunlight, ExpansionsAreTaylorSeries) {
  const auto known = passage();
  const Sunlight& light = *known;
  std::array<double, 20> series{};
  light.expand(10.7, 19, series.data());
  std::array<Extended, 20> extended{};
  light.expand(Extended(10.7), 19, extended.data());
  for (const double s : {-0.5, 0.1, 0.9}) {
    double sum = 0;
    for (std::size_t k = series.size(); k-- > 0;) sum = sum * s + series[k];
    double direct = 0;
    light.expand(10.7 + s, 0, &direct);
    EXPECT_NEAR(sum, direct, 1e-9);
  }
  // Above the polynomial's degree there is nothing.
  for (std::size_t k = 17; k < 20; ++k) EXPECT_EQ(series[k], 0);
  for (std::size_t k = 0; k < 17; ++k) {
    EXPECT_NEAR(series[k], static_cast<double>(extended[k]), 1e-9 * (1 + std::abs(series[k])));
  }
}

TEST(Sunlight, EdgesStandInTheirOrder) {
  const auto known = passage();
  Sunlight& light = *known;
  light.prepend(2, Sunlight::constant(0));
  EXPECT_EQ(light.edges(), (std::vector<double>{2, 10, 12}));
  double value = 1;
  light.expand(1.0, 0, &value);
  EXPECT_EQ(value, 0);
  test::expect_error(ErrorKind::usage, "edge", [&] { light.append(5, Sunlight::constant(1)); });
  test::expect_error(ErrorKind::usage, "edge", [&] { light.prepend(5, Sunlight::constant(1)); });
}

}  // namespace
}  // namespace hamjet
