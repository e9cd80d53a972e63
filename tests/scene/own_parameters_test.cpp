#include <gtest/gtest.h>

#include <cmath>

#include "hamjet/studies/propagation.hpp"
#include "scene_samples.hpp"
#include "support/line_of_flights.hpp"
#include "support/scenes.hpp"

// Parameters of systems that scenes write, as variables of their jets: against differences of
// flights whose equations are written here by hand.

namespace hamjet::io {
namespace {

using test::Numbers;

constexpr double allowed = 1e-9;
constexpr double line_step = 2e-5;  // of the line

const std::string restricted_problem = R"T(schema = 1
[system]
model = "own"
coordinates = ["x", "y"]
momenta = ["px", "py"]
parameters = { mu = 0.0121505856, one = 1, rest = "one - mu" }
definitions = { r1 = "sqrt((x + mu)^2 + y^2)", r2 = "sqrt((x - rest)^2 + y^2)" }
hamiltonian = "(px^2 + py^2)/2 + y*px - x*py - rest/r1 - mu/r2"
[nominal]
coordinates = [0.75, 0.1]
momenta = [-0.08, 0.95]
[jet]
order = 3
duration_canonical = 1.5
variables = ["x", "y", "px", "py", "mu"]
)T" + test::gauss8("tolerance = 1e-14");

RunResult only_run(const Scene& scene) {
  PropagationResult result = propagate(scene);
  EXPECT_EQ(result.runs.size(), 1U);
  EXPECT_EQ(result.runs.at(0).failure, "");
  EXPECT_TRUE(result.runs.at(0).failed_checks.empty());
  return std::move(result.runs.at(0));
}

/// The start, moved by s along a direction of all its numbers.
Numbers moved(const std::vector<double>& start, const std::vector<double>& direction, Extended s) {
  Numbers z(start.begin(), start.end());
  for (std::size_t i = 0; i < z.size(); ++i) z[i] += s * direction[i];
  return z;
}

/// The planar restricted problem of three bodies, with mu as the fifth number (V. Szebehely, Theory
/// of Orbits, 1967, section 1.5).
Numbers restricted_rates(const Numbers& z, Extended) {
  const Extended mu = z[4];
  const Extended a = z[0] + mu, b = z[0] - 1 + mu;
  const Extended r1 = sqrt(a * a + z[1] * z[1]), r2 = sqrt(b * b + z[1] * z[1]);
  const Extended f1 = (1 - mu) / (r1 * r1 * r1), f2 = mu / (r2 * r2 * r2);
  return {z[2] + z[1], z[3] - z[0], z[3] - f1 * a - f2 * b, -z[2] - (f1 + f2) * z[1], 0};
}

TEST(OwnParameters, DerivativesByTheMassRatioAreThoseOfFlights) {
  const Scene scene = parse_scene(restricted_problem, "file.toml");
  EXPECT_EQ(scene.system.own_names, (std::vector<std::string>{"x", "y", "px", "py", "mu"}));
  EXPECT_EQ(scene.nominal.back(), 0.0121505856);
  EXPECT_TRUE(scene.warnings.empty());
  const RunResult run = only_run(scene);
  ASSERT_EQ(run.jet.size(), 5U);
  // By mu alone, and by all numbers at once, which takes every mixed derivative.
  for (const std::vector<double>& direction :
       {std::vector<double>{0, 0, 0, 0, 1}, std::vector<double>{0.3, -0.2, 0.25, 0.4, 0.2}}) {
    const auto right = test::coefficients_by_differences(
        [&](Extended s) {
          return test::extrapolated_flight(restricted_rates, moved(scene.nominal, direction, s), 0,
                                           scene.duration, 20);
        },
        line_step);
    EXPECT_LT(test::largest_difference(run.jet, direction, right, 4), allowed);
  }
  // The parameter stays what it was.
  for (std::size_t k = 0; k < run.jet[4].size(); ++k) {
    const double own = k == 0 ? 0.0121505856 : k == 5 ? 1 : 0;
    EXPECT_EQ(static_cast<double>(run.jet[4][k]), own) << k;
  }
}

const std::string swinging = R"T(schema = 1
[system]
model = "own"
states = ["angle", "rate"]
parameters = { l = "1/4", g = 9.8, stiffness = "g/l", friction = 0.1 }
vector_field = { angle = "rate", rate = "-stiffness*sin(angle) - friction*rate" }
[nominal]
states = [1.1, 0.3]
[jet]
order = 3
duration_canonical = 1.2
variables = ["angle", "rate", "friction", "l"]
)T" + test::gauss8("tolerance = 1e-14");

Numbers pendulum_rates(const Numbers& z, Extended) {
  return {z[1], -Extended("9.8") / z[3] * sin(z[0]) - z[2] * z[1], 0, 0};
}

// A constant that is made of a parameter follows it; the order of parameters is that of the scene's
// variables.
TEST(OwnParameters, LengthAndFrictionOfAPendulum) {
  const Scene scene = parse_scene(swinging, "file.toml");
  const RunResult run = only_run(scene);
  EXPECT_EQ(scene.nominal, (std::vector<double>{1.1, 0.3, 0, 0, 0.1, 0.25}));
  const std::vector<double> start = {1.1, 0.3, 0.1, 0.25};
  const std::vector<double> direction = {0.1, 0.5, 0.4, 0.05};
  const auto right = test::coefficients_by_differences(
      [&](Extended s) {
        return test::extrapolated_flight(pendulum_rates, moved(start, direction, s), 0,
                                         scene.duration, 20);
      },
      line_step);
  EXPECT_LT(test::largest_difference(run.jet, direction, right, 2), allowed);
}

TEST(OwnParameters, JetsWithoutThemAreTheSame) {
  const RunResult with = only_run(parse_scene(restricted_problem, "file.toml"));
  const RunResult without =
      only_run(parse_scene(changed(restricted_problem, ", \"mu\"]", "]"), "file.toml"));
  ASSERT_EQ(without.jet.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 5; ++k) {
      const double right = static_cast<double>(without.jet[i][k]);
      EXPECT_NEAR(static_cast<double>(with.jet[i][k]), right, 1e-11 * (1 + std::abs(right)));
    }
  }
}

// A field that is the same after a rotation whatever mu is: the rotation is left out of the
// integration and put back beside the parameter too.
TEST(OwnParameters, RotationsAreLeftOutBesideAParameter) {
  const std::string central = R"T(schema = 1
[system]
model = "own"
coordinates = ["x", "y"]
momenta = ["px", "py"]
parameters = { mu = 1.5 }
hamiltonian = "(px^2 + py^2)/2 - mu/sqrt(x^2 + y^2)"
[nominal]
coordinates = [1, 0.2]
momenta = [-0.1, 1.3]
[jet]
order = 3
duration_canonical = 3
variables = ["x", "y", "px", "py", "mu"]
)T";
  const RunResult reduced = only_run(parse_scene(central, "file.toml"));
  const RunResult whole =
      only_run(parse_scene(central, "file.toml", {{"jet.symmetry", "\"none\""}}));
  EXPECT_NE(reduced.statistics.left_out, FlowSymmetry::none);
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t k = 0; k < whole.jet[i].size(); ++k) {
      const double right = static_cast<double>(whole.jet[i][k]);
      EXPECT_NEAR(static_cast<double>(reduced.jet[i][k]), right, 1e-10 * (1 + std::abs(right)));
    }
  }
}

TEST(OwnParameters, RefusesWhatHasNoMeaning) {
  const auto refuse = [](const std::string& from, const std::string& to,
                         const std::vector<std::string>& words) {
    expect_scene_error(changed(restricted_problem, from, to), words);
  };
  refuse("\"mu\"]", "\"nu\"]", {"jet.variables.4: unknown variable, got \"nu\"", "py, mu, one"});
  refuse("\"mu\"]", "\"mu\", \"mu\"]", {"jet.variables.5: duplicate variable"});
  refuse("\"mu\"]", "\"mu\"]\nsymmetry = \"rotation-and-time\"", {"jet.symmetry: beside", "mu"});
  refuse("[jet]", "[generating_function]\nkinds = [\"F1\"]\n[jet]",
         {"generating_function.kinds: not defined beside the parameter mu"});
  refuse("\"one - mu\"", "\"one - mu*x\"", {"system.parameters.rest: not constant"});
}

}  // namespace
}  // namespace hamjet::io
