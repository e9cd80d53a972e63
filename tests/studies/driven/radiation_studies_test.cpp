#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "astronomy/sunlight.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"
#include "hamjet/detail/studies/singular_times.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/propagation.hpp"
#include "studies/checks/force_sizes.hpp"
#include "studies/checks/run_warnings.hpp"
#include "studies/earth_system.hpp"
#include "studies/exact_flow.hpp"
#include "studies/formation/deputy_motion.hpp"
#include "studies/formation/single_transfer.hpp"
#include "support/errors.hpp"
#include "support/flow.hpp"

// Studies of spacecraft in sunlight and shadow, against an integrator of this file: Runge and
// Kutta's method, on the library's gravity, with a light and a shadow of its own.

namespace hamjet {
namespace {

struct Case {
  std::string orbit = "height_km = 700\ni_deg = 51.6\nraan_deg = 30\nu_deg = 0";
  double chief = 0.02;
  double deputy = 0.02;
  double seconds = 12000;
  std::string system = {};
  std::string position_m = "0, 0, 0";
  std::string more = {};
};

Scene scene_of(const Case& one) {
  return io::parse_scene(fmt::format(R"(schema = 1
[system]
model = "earth"
gravity_degree = 2
gravity_order = 0
radiation = true
{}
[spacecraft]
radiation_m2_kg = {}
[nominal]
epoch_utc = "2026-03-01T06:00:00"
{}
[deputy]
position_m = [{}]
spacecraft = {{ radiation_m2_kg = {} }}
[jet]
order = 3
duration_s = {}
{})",
                                     one.system, one.chief, one.orbit, one.position_m, one.deputy,
                                     one.seconds, one.more),
                         "radiation.toml");
}

using Place = std::array<double, 3>;

/// The seen part of the Sun's disc from a position in km: the part of points of the disc, on rings
/// and spokes, whose line of sight passes the Earth.
double seen(const Place& r, const Place& sun) {
  constexpr double sun_km = 695700, earth_km = 6378.1363;
  const Place to = {sun[0] - r[0], sun[1] - r[1], sun[2] - r[2]};
  const double d = std::hypot(to[0], to[1], to[2]);
  const double height = std::hypot(r[0], r[1], r[2]);
  const double cosine = -(to[0] * r[0] + to[1] * r[1] + to[2] * r[2]) / (d * height);
  const double apart = std::acos(std::clamp(cosine, -1.0, 1.0));
  const double a = std::asin(sun_km / d), b = std::asin(earth_km / height);
  if (apart > a + b) return 1;
  if (apart < b - a) return 0;
  constexpr int rings = 300;
  double sum = 0;
  for (int k = 0; k < rings; ++k) {
    // Rings of equal area; of each, the spokes that the disc of the Earth leaves free.
    const double rho = a * std::sqrt((k + 0.5) / rings);
    const double limit = (rho * rho + apart * apart - b * b) / (2 * rho * apart);
    sum += limit >= 1 ? 1 : (limit <= -1 ? 0 : 1 - std::acos(limit) / M_PI);
  }
  return sum / rings;
}

/// Chief and deputy by Runge and Kutta's method in steps of two seconds. The light is that which
/// the chief sees, or each spacecraft.
class OwnFlight {
 public:
  enum class Light { of_chief, of_each, without_shadow, none };

  explicit OwnFlight(const Scene& scene)
      : scene_(scene),
        gravity_(without_light(scene).vector_field),
        sun_(position_of_sun(scene.system, scene.canonical_radius)) {}

  std::vector<double> fly(const std::vector<std::vector<double>>& starts,
                          const std::vector<double>& coefficients, Light light, double seconds) {
    std::vector<double> z;
    for (const auto& start : starts) z.insert(z.end(), start.begin(), start.begin() + 6);
    const int steps = static_cast<int>(seconds / 2);
    const double h = seconds / steps / scene_.units.time_s;
    for (int k = 0; k < steps; ++k) {
      const double t = k * h;
      const auto k1 = rates(z, t, coefficients, light);
      const auto k2 = rates(sum(z, h / 2, k1), t + h / 2, coefficients, light);
      const auto k3 = rates(sum(z, h / 2, k2), t + h / 2, coefficients, light);
      const auto k4 = rates(sum(z, h, k3), t + h, coefficients, light);
      for (std::size_t i = 0; i < z.size(); ++i) {
        z[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
      }
    }
    return z;
  }

 private:
  static DynamicalSystem without_light(const Scene& scene) {
    SystemSettings settings = scene.system;
    settings.earth->radiation.reset();
    settings.earth->parameters.clear();
    return make_system(settings, scene.canonical_radius);
  }
  static std::vector<double> sum(const std::vector<double>& z, double h,
                                 const std::vector<double>& rate) {
    std::vector<double> result = z;
    for (std::size_t i = 0; i < z.size(); ++i) result[i] += h * rate[i];
    return result;
  }
  std::vector<double> rates(const std::vector<double>& z, double t,
                            const std::vector<double>& coefficients, Light light) {
    const double km = scene_.units.length_km;
    std::array<double, 3> sun{};
    sun_->expand(t, 0, sun.data());
    for (double& x : sun) x *= km;
    double part = 1;
    std::vector<double> result;
    for (std::size_t craft = 0; 6 * craft < z.size(); ++craft) {
      const std::span<const double> own(z.data() + 6 * craft, 6);
      gravity_.evaluate(own, t);
      const Place r = {own[0] * km, own[1] * km, own[2] * km};
      if (light == Light::of_each || (light == Light::of_chief && craft == 0)) {
        part = seen(r, sun);
      }
      const Place from = {r[0] - sun[0], r[1] - sun[1], r[2] - sun[2]};
      const double d = std::hypot(from[0], from[1], from[2]);
      // 1361 W/m^2 over the speed of light, at 149597870.7 km; in m/s^2, then canonical.
      const double push = 1361.0 / 299792458 * std::pow(149597870.7 / d, 2) * coefficients[craft] *
                          (light == Light::none ? 0 : part) / (km * 1000) *
                          std::pow(scene_.units.time_s, 2);
      for (std::size_t i = 0; i < 3; ++i) result.push_back(gravity_.value(i));
      for (std::size_t i = 0; i < 3; ++i) {
        result.push_back(gravity_.value(3 + i) + push * from[i] / d);
      }
    }
    return result;
  }

  const Scene& scene_;
  DifferentiableFunction<double> gravity_;
  std::shared_ptr<const BodyPosition> sun_;
};

/// The distance of two positions, canonical.
double apart(std::span<const double> a, std::span<const double> b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST(RadiationStudies, OrbitThroughShadowsIsThatOfAnotherIntegrator) {
  const Scene scene = scene_of({});
  ASSERT_NE(scene.system.earth->sunlight, nullptr);
  OwnFlight own(scene);
  using Light = OwnFlight::Light;
  const auto shaded = own.fly({scene.nominal}, {0.02}, Light::of_each, 12000);
  const auto dark = own.fly({scene.nominal}, {0.02}, Light::none, 12000);
  const auto always = own.fly({scene.nominal}, {0.02}, Light::without_shadow, 12000);
  const auto end = exact_flow(make_system(scene), scene.nominal, scene.start_time, scene.duration);
  // What light does, some metres, to the rounding of flights and the truncation of Runge and Kutta.
  const double metre = 0.001 / scene.units.length_km;
  EXPECT_GT(apart(shaded, dark), 1 * metre);
  EXPECT_GT(apart(shaded, always), 0.1 * metre);
  EXPECT_LT(apart(end, shaded), 1e-3 * metre);
}

TEST(RadiationStudies, DeputiesOfOtherAreaAreOnTheChiefsJet) {
  const Scene scene = scene_of({.deputy = 0.03, .position_m = "300, -700, 200"});
  const DeputyMotion motion = study_deputy_motion(scene);
  std::vector<double> deputy = scene.nominal;
  const std::vector<double> deviation =
      ChiefFrame(scene.nominal, metric_units(scene), scene.deputy->frame)
          .deviation(scene.deputy->start);
  for (std::size_t i = 0; i < 6; ++i) deputy[i] += deviation[i];
  OwnFlight own(scene);
  const auto end =
      own.fly({scene.nominal, deputy}, {0.02, 0.03}, OwnFlight::Light::of_chief, 12000);
  const double length_m = 1000 * scene.units.length_km;
  const double distance = apart(std::span(end).first(6), std::span(end).last(6)) * length_m;
  EXPECT_NEAR(motion.points.back().state.position_m.norm(), distance, 1e-3);
  // The jet of order 3 is right to what flights are.
  EXPECT_LT(motion.largest_error_m(3), 1e-3);
  EXPECT_GT(motion.largest_error_m(1), 0.01);
}

TEST(RadiationStudies, ChecksSayWhatLightAndItsEdgesDo) {
  const Scene scene = scene_of({.deputy = 0.03, .position_m = "0, -100000, 0"});
  const std::vector<ForceSize> forces = force_sizes(scene);
  const auto named = [&](const std::string& name) -> const ForceSize& {
    const auto found = std::find_if(forces.begin(), forces.end(),
                                    [&](const ForceSize& one) { return one.name == name; });
    EXPECT_NE(found, forces.end()) << name;
    return *found;
  };
  // 0.02 m^2/kg of 4.54e-6 N/m^2 at 0.991 AU, the Sun's distance on the 1st of March.
  EXPECT_NEAR(named("radiation").largest_m_s2, 0.02 * 4.5398e-6 / (0.991 * 0.991), 2e-10);
  EXPECT_GT(named("shadow").chief_m, 0.1);
  // The edges that a deputy has of its own, 100 km behind, by the own integrator.
  std::vector<double> deputy = scene.nominal;
  const std::vector<double> deviation =
      ChiefFrame(scene.nominal, metric_units(scene), scene.deputy->frame)
          .deviation(scene.deputy->start);
  for (std::size_t i = 0; i < 6; ++i) deputy[i] += deviation[i];
  OwnFlight own(scene);
  const auto with_own =
      own.fly({scene.nominal, deputy}, {0.02, 0.03}, OwnFlight::Light::of_each, 12000);
  const auto with_chief =
      own.fly({scene.nominal, deputy}, {0.02, 0.03}, OwnFlight::Light::of_chief, 12000);
  const double left = apart(std::span(with_own).last(6), std::span(with_chief).last(6)) * 1000 *
                      scene.units.length_km;
  const double told = named("deputy's own edges").relative_m.value();
  EXPECT_GE(told, 0.95 * left);
  EXPECT_LT(told, 100 * left);
  EXPECT_GT(left, 1e-4);
}

/// The edges of a circular orbit about which nothing but the point mass counts: Kepler's third law
/// and the angle from the axis, against what the scene's flight finds.
TEST(RadiationStudies, EdgesStandWhereTheConesAre) {
  const Scene scene = scene_of(
      {.orbit = "height_km = 20000\ni_deg = 23.4\nraan_deg = 0\nu_deg = 0", .seconds = 86400});
  const Sunlight& light = *scene.system.earth->sunlight;
  const SharedSystem system = make_system(scene);
  EXPECT_EQ(system->break_times, light.edges());
  ASSERT_GE(light.edges().size(), 8U);
  const double km = scene.units.length_km;
  const auto sun = position_of_sun(scene.system, scene.canonical_radius);
  for (std::size_t k = 0; k < light.edges().size(); ++k) {
    const double t = light.edges()[k];
    if (t < 0 || t > scene.duration) continue;
    const auto z = exact_flow(system, scene.nominal, scene.start_time, t);
    std::array<double, 3> s{};
    sun->expand(t, 0, s.data());
    const double d = std::hypot(s[0], s[1], s[2]) * km;
    const double r = std::hypot(z[0], z[1], z[2]) * km;
    const double cosine = -(z[0] * s[0] + z[1] * s[1] + z[2] * s[2]) * km * km / (r * d);
    const double angle = std::asin(6378.1363 / r);
    const double outer = angle + std::asin((695700 + 6378.1363) / d);
    const double inner = angle - std::asin((695700 - 6378.1363) / d);
    const double found = std::acos(cosine);
    // To 1e-9 of a radian, 30 micrometres at this distance.
    EXPECT_LT(std::min(std::abs(found - outer), std::abs(found - inner)), 2e-9) << k;
  }
}

TEST(RadiationStudies, ToleranceIsKeptAcrossEdges) {
  // A balloon of 20 m^2/kg, so that light is not lost in the tolerance.
  const Scene scene = scene_of({.chief = 20, .deputy = 20});
  DynamicalSystem with = make_system(scene), without = make_system(scene);
  without.break_times.clear();
  const auto flow = [&](const DynamicalSystem& system) {
    return test::Flow<double>{system, scene.nominal, scene.duration, 2};
  };
  const auto exact = test::run_gauss(flow(with), test::adaptive(14, 1e-15));
  for (const double tolerance : {1e-8, 1e-10}) {
    IntegrationStatistics statistics, over;
    const auto jet = test::run_gauss(flow(with), test::adaptive(8, tolerance), &statistics);
    for (int degree = 0; degree <= 2; ++degree) {
      EXPECT_LT(test::relative_error(jet, exact, degree),
                10 * tolerance * std::max(1.0, statistics.periods))
          << tolerance << " " << degree;
    }
    test::run_gauss(flow(without), test::adaptive(8, tolerance), &over);
    EXPECT_GT(over.rejected_steps, statistics.rejected_steps) << tolerance;
  }
}

TEST(RadiationStudies, EqualStepsSayThatTheyPassOverEdges) {
  const Scene scene = scene_of(
      {.more = "[[integrator]]\nlabel = \"equal\"\nmethod = \"gauss\"\nstep_canonical = 0.1\n"});
  const PropagationResult result = propagate(scene);
  ASSERT_EQ(result.runs.size(), 1U);
  EXPECT_NE(passed_edges_warning(scene, result.runs[0]).find("edges"), std::string::npos);
  EXPECT_TRUE(result.runs[0].failed_checks.empty());
}

TEST(RadiationStudies, BackwardsThereIsTheSameLight) {
  const Scene there = scene_of({});
  const auto end = exact_flow(make_system(there), there.nominal, there.start_time, there.duration);
  Scene back = scene_of({.seconds = -12000});
  // The light before the start: from a flight there and forwards again.
  const SharedSystem system = make_system(back);
  const auto before = exact_flow(system, back.nominal, back.start_time, back.duration);
  const auto again = exact_flow(system, before, back.start_time + back.duration, -back.duration);
  EXPECT_LT(apart(again, back.nominal), 1e-11);
  const auto& edges = back.system.earth->sunlight->edges();
  EXPECT_GT(std::count_if(edges.begin(), edges.end(), [](double t) { return t < 0; }), 8);
  // Both scenes compute the light for a quarter of a day beyond their spans too, and it is the same
  // there.
  for (const double t : {0.5, 1.5, 3.0, -2.5}) {
    double one = 0, other = 0;
    there.system.earth->sunlight->expand(t, 0, &one);
    back.system.earth->sunlight->expand(t, 0, &other);
    EXPECT_NEAR(one, other, 1e-9) << t;
  }
  EXPECT_GT(apart(end, there.nominal), 1e-3);
}

// Equal steps of a linear flow would pass over the edges, whose error their estimate does not see.
// A flight in one, whose steps end at the edges, has the same states; each checkpoint may add
// 1e-14.
TEST(RadiationStudies, LinearFlowsEndTheirStepsAtTheEdges) {
  const Scene scene = scene_of({});
  const ComputedProblem problem = make_problem(scene);
  for (const double per_revolution : {48.0, 240.0}) {
    const LinearFlow flow(problem, scene.duration, per_revolution);
    const double allowed = 1e-14 * static_cast<double>(flow.times().size());
    for (int k = 1; k <= 50; ++k) {
      const double time = scene.duration * k / 50;
      EXPECT_LT(apart(flow.nominal(time),
                      exact_flow(problem.system, problem.nominal, problem.start_time, time)),
                allowed)
          << per_revolution << ": " << time;
    }
  }
}

TEST(RadiationStudies, NoShadowNoEdges) {
  const Scene scene = scene_of({.system = "shadow = \"none\""});
  EXPECT_EQ(scene.system.earth->sunlight, nullptr);
  EXPECT_TRUE(make_system(scene).break_times.empty());
  EXPECT_TRUE(make_system(scene).is_hamiltonian);
}

}  // namespace
}  // namespace hamjet
