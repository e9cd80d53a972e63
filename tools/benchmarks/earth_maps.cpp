#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "cases.hpp"
#include "dynamics/fields/point_mass_field.hpp"
#include "dynamics/fields/spherical_harmonic_field.hpp"
#include "hamjet/astronomy/body_position.hpp"
#include "hamjet/astronomy/earth_rotation.hpp"
#include "hamjet/dynamics/earth_gravity.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/integrators/explicit_runge_kutta.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "timing.hpp"

namespace hamjet::benchmarks {
namespace {

constexpr double mu_km3_s2 = 398600.4415;
constexpr double radius_km = 6378.1363;
constexpr double unit_km = 6878;
constexpr double day_s = 86400;
constexpr int order = 4;
constexpr double tolerance = 1e-12;

double unit_s() { return std::sqrt(unit_km * unit_km * unit_km / mu_km3_s2); }
double day() { return day_s / unit_s(); }

/// Functions of the time as they are at one moment, without their cost.
class HeldFunction final : public TimeFunction {
 public:
  HeldFunction(const TimeFunction& function, double time) : values_(function.components()) {
    function.expand(time, 0, values_.data());
  }
  std::size_t components() const override { return values_.size(); }
  void expand(double, int degree, double* out) const override { put(degree, out); }
  void expand(const Extended&, int degree, Extended* out) const override { put(degree, out); }

 private:
  template <class Real>
  void put(int degree, Real* out) const {
    for (const double value : values_) {
      *out++ = Real(value);
      out = std::fill_n(out, degree, Real(0));
    }
  }
  std::vector<double> values_;
};

/// A full field by Kaula's rule, beside the Earth's oblateness.
SphericalHarmonicCoefficients earth_like_field(int degree) {
  SphericalHarmonicCoefficients field(degree, degree);
  for (int n = 2; n <= degree; ++n) {
    for (int m = 0; m <= n; ++m) {
      const double sign = (n + m) % 3 == 0 ? -1 : 1;
      field.C(n, m) = sign * 1e-5 / (n * n);
      if (m > 0) field.S(n, m) = -0.8 * sign * 1e-5 / (n * n);
    }
  }
  field.C(2, 0) = -4.8417e-4;
  return field;
}

enum class TimeValues { moving, held };

SharedSystem earth(int degree, bool has_bodies, TimeValues values) {
  const Instant epoch{parse_epoch("2023-05-16T20:00:00").value()};
  const auto as_asked = [&](std::shared_ptr<const TimeFunction> function) {
    if (values == TimeValues::moving) return function;
    return std::shared_ptr<const TimeFunction>(std::make_shared<HeldFunction>(*function, 0.0));
  };
  GravityOfTurningBody gravity;
  gravity.potential =
      std::make_shared<SphericalHarmonicField>(1.0, radius_km / unit_km, earth_like_field(degree));
  gravity.axes = as_asked(std::make_shared<EarthRotation>(epoch, unit_s(), 0.0, day()));
  if (has_bodies) {
    for (const auto& [body, mu] : {std::pair(PerturbingBody::sun, 132712440041.27942),
                                   std::pair(PerturbingBody::moon, 4902.800118)}) {
      const double ratio = mu / mu_km3_s2;
      gravity.others.push_back(
          {ratio, std::make_shared<PointMassField>(ratio),
           as_asked(std::make_shared<BodyPosition>(body, epoch, unit_s(), unit_km, 0.0, day()))});
    }
  }
  return earth_gravity(gravity);
}

/// A day of a nearly circular orbit 500 km high.
FlowProblem<double> problem_of(const SharedSystem& system, int of_order) {
  FlowProblem<double> problem{
      system, SeriesSpace::create(6, of_order), {}, {1, 0, 0, 0, -0.13, 0.99}, ClockTime::epoch(),
      day()};
  problem.variables.resize(6);
  std::iota(problem.variables.begin(), problem.variables.end(), std::size_t{0});
  return problem;
}

struct Row {
  std::string name;
  SharedSystem system;
  FlowSymmetry symmetry = FlowSymmetry::none;
};

IntegrationStatistics map_of(const Row& row, const GaussSettings& settings) {
  FlowProblem<double> problem = problem_of(row.system, order);
  problem.symmetry = row.symmetry;
  IntegrationStatistics statistics;
  integrate_gauss<double>(problem, settings, statistics);
  return statistics;
}

void propagate(const Row& row) {
  FlowProblem<double> problem = problem_of(row.system, 0);
  problem.space = SeriesSpace::create(1, 0);
  problem.variables = {0};
  IntegrationStatistics statistics;
  integrate_fehlberg78<double>(problem, {.tolerance = tolerance}, statistics);
}

}  // namespace

void benchmark_earth_maps() {
  const SharedSystem zonal =
      zonal_gravity({1.0, radius_km / unit_km, {{2, 1.08262668e-3}, {3, -2.53265649e-6}}});
  std::vector<Row> rows = {{"J2 and J3, five variables", zonal, FlowSymmetry::rotation},
                           {"J2 and J3", zonal}};
  for (const int degree : {20, 36, 70}) {
    const std::string name = fmt::format("{0} x {0}", degree);
    rows.push_back({name, earth(degree, false, TimeValues::moving)});
    rows.push_back({name + ", Sun, Moon", earth(degree, true, TimeValues::moving)});
    rows.push_back({name + ", all held", earth(degree, true, TimeValues::held)});
  }
  GaussSettings adaptive;
  adaptive.tolerance = tolerance;
  // As many steps as the finest field takes.
  const long steps = map_of(rows[rows.size() - 2], adaptive).steps;
  GaussSettings fixed;
  fixed.step = day() / static_cast<double>(steps);
  std::vector<std::function<void()>> works;
  for (const Row& row : rows) {
    works.emplace_back([&row, &fixed] { map_of(row, fixed); });
    works.emplace_back([&row, &adaptive] { map_of(row, adaptive); });
    works.emplace_back([&row] { propagate(row); });
  }
  const auto seconds = median_seconds(works, 7, processor_seconds_of);
  fmt::print(
      "\nmaps of order 4 over a day, 500 km high, Gauss with 8 stages: {} fixed steps, and the\n"
      "steps for 1e-12 with their choice; beside them one satellite by Fehlberg 7(8), 1e-12;\n"
      "medians of processor time\n",
      steps);
  fmt::print("{:<26} {:>11} {:>10} {:>15} {:>6} {:>12} {:>9}\n", "forces", "fixed steps",
             "of zonals", "adaptive map", "steps", "propagation", "map is");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double* const t = &seconds[3 * i];
    fmt::print("{:<26} {:>8.2f} ms {:>10.2f} {:>12.1f} ms {:>6} {:>9.2f} ms {:>9.1f}\n",
               rows[i].name, t[0] * 1e3, t[0] / seconds[3], t[1] * 1e3,
               map_of(rows[i], adaptive).steps, t[2] * 1e3, t[1] / t[2]);
  }
  fmt::print("    held: matrix, Sun and Moon as at the start, which leaves out their cost\n");
}

}  // namespace hamjet::benchmarks
