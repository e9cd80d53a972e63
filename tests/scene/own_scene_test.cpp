#include <Eigen/LU>
#include <array>
#include <boost/math/special_functions/ellint_1.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "hamjet/algebra/composition.hpp"
#include "hamjet/detail/algebra/monomial_values.hpp"
#include "hamjet/studies/comparison.hpp"
#include "hamjet/studies/propagation.hpp"
#include "scene_samples.hpp"

// Systems that scenes write themselves: how they are read, and the shipped ones against published
// numbers and closed forms.

namespace hamjet::io {
namespace {

const std::filesystem::path own = std::filesystem::path(HAMJET_SOURCE_DIR) / "data/scenes/own";

const std::string pendulum = R"T(schema = 1
title = "pendulum"
[system]
model = "own"
coordinates = ["q"]
momenta = ["p"]
parameters = { g = 2.0, l = "1/4" }
definitions = { swing = "g*l*cos(q)" }
hamiltonian = "p^2/2 - swing"
[units]
length_km = 2
time_s = 3
[nominal]
coordinates = [1.5]
momenta = [0.25]
[jet]
order = 2
duration_s = 6
)T";

TEST(OwnScene, IsRead) {
  const Scene scene = parse_scene(pendulum, "file.toml");
  EXPECT_EQ(scene.system.model, SystemModel::own);
  EXPECT_EQ(scene.system.own_names, (std::vector<std::string>{"q", "p"}));
  EXPECT_EQ(scene.nominal, (std::vector<double>{1.5, 0.25}));
  EXPECT_DOUBLE_EQ(scene.duration, 2);
  EXPECT_EQ(scene.units.length_km, 2);
  EXPECT_EQ(scene.units.time_s, 3);
  EXPECT_TRUE(scene.warnings.empty());
  ASSERT_TRUE(scene.own_system);
  EXPECT_EQ(scene.own_system->degrees_of_freedom, 1U);
  // The scene's key holds the text, so that kept results of another system are not taken for its
  // own.
  const Scene other = parse_scene(changed(pendulum, "1/4", "1/5"), "file.toml");
  EXPECT_NE(reference_key(scene, 2), reference_key(other, 2));
}

TEST(OwnScene, TakesChangesOfParameters) {
  const Scene scene = parse_scene(pendulum, "file.toml", {{"system.parameters.g", "4"}});
  const Scene same = parse_scene(changed(pendulum, "g = 2.0", "g = 4"), "file.toml");
  EXPECT_EQ(reference_key(scene, 2), reference_key(same, 2));
}

TEST(OwnScene, TellsMistakesWithFileKeyAndColumn) {
  const auto refuse = [](const std::string& from, const std::string& to,
                         const std::vector<std::string>& words) {
    expect_scene_error(changed(pendulum, from, to), words);
  };
  refuse("p^2/2 - swing", "p^2/2 - swings",
         {"file.toml:9:", "system.hamiltonian: unknown name", "got \"swings\" at column 9"});
  refuse("g*l*cos(q)", "g*l*cos q",
         {"file.toml:8:", "system.definitions.swing: a function without parentheses"});
  refuse("\"1/4\"", "\"1/0\"", {"file.toml:7:", "system.parameters.l: division by zero"});
  refuse("\"1/4\"", "true", {"system.parameters.l: wrong type, got true"});
  refuse("momenta = [\"p\"]\n", "", {"system.momenta: missing"});
  refuse("momenta = [\"p\"]", "momenta = [\"p\", \"s\"]", {"system.momenta: ", "must be 1"});
  refuse("coordinates = [\"q\"]", "states = [\"q\"]", {"system.states: beside a hamiltonian"});
  refuse("hamiltonian = \"p^2/2 - swing\"\n", "", {"system: missing", "hamiltonian, vector_field"});
  refuse("[nominal]\ncoordinates", "[nominal]\nposition_m", {"nominal.position_m: "});
  refuse("coordinates = [1.5]", "coordinates = [1.5, 2]", {"nominal.coordinates: wrong length"});
  refuse("time_s = 3\n", "", {"units.time_s: missing"});
  refuse("- swing", "- swing/(q - 1.5)",
         {"system.hamiltonian: at the start: division by zero", "got \"/\""});
  refuse("- swing", "- swing + sqrt(p - 1)", {"no finite real value", "it is given -0.75"});
  refuse("duration_s = 6", "duration_orbits = 6", {"duration_orbits"});
}

TEST(OwnScene, WarnsOfLikelyMistakes) {
  const Scene scene = parse_scene(changed(pendulum, "- swing", "- cos(q)"), "file.toml");
  ASSERT_EQ(scene.warnings.size(), 3U);
  EXPECT_EQ(scene.warnings[0].find("warning: file.toml:7:"), 0U) << scene.warnings[0];
  EXPECT_NE(scene.warnings[2].find("system.definitions.swing: nothing uses it"), std::string::npos);
}

/// The result of a shipped scene, whose runs and checks must be good.
PropagationResult computed(const std::string& name) {
  PropagationResult result = propagate(read_scene(own / name));
  EXPECT_EQ(result.runs.size(), 1U);
  EXPECT_EQ(result.runs.at(0).failure, "");
  EXPECT_TRUE(result.runs.at(0).failed_checks.empty());
  return result;
}

Matrix<double> linear_part(const PropagationResult& result) {
  const auto& jet = result.runs.at(0).jet;
  const auto n = static_cast<Eigen::Index>(jet.size());
  Matrix<double> matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      matrix(i, j) =
          static_cast<double>(jet[static_cast<std::size_t>(i)][1 + static_cast<std::size_t>(j)]);
    }
  }
  return matrix;
}

// The published orbit closes with the published period (R. Zanetti and others give its state to 36
// digits for a mass ratio of 81.30059); the jet's linear part has a pair of eigenvalues 1 then.
TEST(OwnScene, TheHaloOrbitOfTheMoonClosesAfterItsPeriod) {
  const PropagationResult result = computed("earth-moon-nrho.toml");
  const std::vector<double>& start = result.scene.nominal;
  const std::vector<double>& end = result.runs.at(0).nominal_final;
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(end[i], start[i], 1e-10) << i;
  EXPECT_NEAR(result.scene.duration * result.scene.units.time_s / 86400, 6.562, 5e-4);
  const Matrix<double> monodromy = linear_part(result);
  EXPECT_NEAR(monodromy.determinant(), 1, 1e-6);
  // The flow's direction comes back: M f = f, with the period's error in the difference.
  const double mu = 1 / 82.30059;
  const double x = start[0], z = start[2], py = start[4];
  const double to_earth = std::hypot(x + mu, z), to_moon = std::hypot(x - 1 + mu, z);
  const double a = (1 - mu) / std::pow(to_earth, 3), b = mu / std::pow(to_moon, 3);
  Vector<double> f(6);
  f << 0, py - x, 0, py - a * (x + mu) - b * (x - 1 + mu), 0, -(a + b) * z;
  EXPECT_LE((monodromy * f - f).norm(), 1e-7 * monodromy.norm());
}

// The motion about L2 of Hill's problem is linear with c = 4: the rates in the plane are sqrt(2
// sqrt 7
// + 1), real, and sqrt(2 sqrt 7 - 1), imaginary; across it 2.
TEST(OwnScene, HillsProblemHasItsRatesAtItsEquilibrium) {
  const PropagationResult result = computed("hill.toml");
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(result.runs.at(0).nominal_final[i], result.scene.nominal[i], 1e-14);
  }
  const Matrix<double> step = linear_part(result);
  const double real = std::sqrt(2 * std::sqrt(7.0) + 1), turn = std::sqrt(2 * std::sqrt(7.0) - 1);
  EXPECT_NEAR(step.trace(), 2 * std::cosh(real) + 2 * std::cos(turn) + 2 * std::cos(2.0), 1e-9);
  EXPECT_NEAR((step * step).trace(),
              2 * std::cosh(2 * real) + 2 * std::cos(2 * turn) + 2 * std::cos(4.0), 1e-8);
  ASSERT_EQ(result.runs.at(0).kinds.size(), 1U);
  EXPECT_TRUE(result.runs.at(0).kinds[0].generating_function);
}

using LongNumbers = std::array<long double, 9>;  ///< four states, their costates, the energy

/// Hill's problem in the plane under the thrust of least energy, written by hand.
LongNumbers thrusted_hill(const LongNumbers& z) {
  const long double r2 = z[0] * z[0] + z[1] * z[1], r3 = r2 * std::sqrt(r2), r5 = r3 * r2;
  const long double xx = 2 - 1 / r3 + 3 * z[0] * z[0] / r5, xy = 3 * z[0] * z[1] / r5,
                    yy = -1 - 1 / r3 + 3 * z[1] * z[1] / r5;
  return {z[2] + z[1],
          z[3] - z[0],
          z[3] + (2 - 1 / r3) * z[0] - z[6],
          -z[2] - (1 + 1 / r3) * z[1] - z[7],
          z[5] - xx * z[6] - xy * z[7],
          -z[4] - xy * z[6] - yy * z[7],
          -z[4] + z[7],
          -z[5] - z[6],
          (z[6] * z[6] + z[7] * z[7]) / 2};
}

LongNumbers flown_hill(LongNumbers z, long double time) {
  constexpr int steps = 2000;
  const long double h = time / steps;
  const auto moved = [](LongNumbers a, const LongNumbers& b, long double by) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += by * b[i];
    return a;
  };
  for (int k = 0; k < steps; ++k) {
    const LongNumbers a = thrusted_hill(z), b = thrusted_hill(moved(z, a, h / 2)),
                      c = thrusted_hill(moved(z, b, h / 2)), d = thrusted_hill(moved(z, c, h));
    z = moved(moved(moved(moved(z, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
  }
  return z;
}

// About L2 the motion is x'' - 2 y' = 9 x, y'' + 2 x' = -3 y. The least energy from a state x0 to
// xT is d^T W^-1 d / 2, d = xT - Phi x0, with the Gramian W of the time (here by Simpson's rule on
// Runge and Kutta's transition matrix); F1 is minus that. Beyond first order its derivatives are
// the costates that lead there, which the test flies.
TEST(OwnScene, LeastEnergyAboutHillsL2IsThatOfItsGramian) {
  const PropagationResult result = computed("hill-least-energy.toml");
  ASSERT_EQ(result.runs.at(0).kinds.size(), 1U);
  const Series<Extended>& f1 = *result.runs.at(0).kinds[0].generating_function;
  ASSERT_EQ(f1.order(), 5);
  Eigen::Matrix4d A;  // of (x, y, px, py), x' = px + y, y' = py - x
  A << 0, 1, 1, 0, -1, 0, 0, 1, 8, 0, 0, 1, 0, -4, -1, 0;
  constexpr int steps = 1000;
  const double h = result.scene.duration / steps;
  Eigen::Matrix4d phi = Eigen::Matrix4d::Identity(), gramian = Eigen::Matrix4d::Zero();
  const Eigen::Matrix4d step = Eigen::Matrix4d::Identity() +
                               h * A *
                                   (Eigen::Matrix4d::Identity() +
                                    h / 2 * A *
                                        (Eigen::Matrix4d::Identity() +
                                         h / 3 * A * (Eigen::Matrix4d::Identity() + h / 4 * A)));
  for (int k = 0; k <= steps; ++k) {
    const double weight = h / 3 * (k == 0 || k == steps ? 1 : k % 2 == 1 ? 4 : 2);
    gramian += weight * phi.rightCols<2>() * phi.rightCols<2>().transpose();
    if (k < steps) phi = step * phi;
  }
  // F1's variables are the states at the end, then those at the start.
  const Eigen::Matrix4d inverse = gramian.inverse();
  Eigen::Matrix<double, 8, 8> expected;
  expected.topLeftCorner<4, 4>() = inverse;
  expected.topRightCorner<4, 4>() = -inverse * phi;
  expected.bottomLeftCorner<4, 4>() = -phi.transpose() * inverse;
  expected.bottomRightCorner<4, 4>() = phi.transpose() * inverse * phi;
  const auto second = [&](std::size_t i, std::size_t j) {
    std::vector<std::uint8_t> powers(8);
    ++powers[i];
    ++powers[j];
    return static_cast<double>(f1[f1.space().index(powers)]) * (i == j ? 2 : 1);
  };
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < 8; ++j) {
      const double value = expected(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      EXPECT_NEAR(second(i, j), -value, 1e-8 * expected.norm());
    }
  }
  // Twice as near, costates of order 4 miss by a 32nd, and energies, of degree 5, by a 64th.
  const std::array<double, 8> ends = {0.3, -0.6, 0.2, 0.5, -0.7, 0.4, 0.1, -0.3};
  std::vector<double> misses, wrong;
  for (const double size : {0.02, 0.01}) {
    std::vector<double> point;
    for (const double x : ends) point.push_back(size * x);
    MonomialValues values(f1.space_pointer());
    values.set_point(point);
    const Series<double> rounded = convert_map<double>(std::vector{f1}).front();
    LongNumbers z{};
    for (std::size_t i = 0; i < 4; ++i) {
      z[i] = result.scene.nominal[i] + static_cast<long double>(point[4 + i]);
      z[4 + i] = -values.derivative(rounded, 4 + i, 5);
    }
    const LongNumbers end = flown_hill(z, result.scene.duration);
    double miss = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      miss = std::hypot(miss, static_cast<double>(end[i] - result.scene.nominal[i]) - point[i]);
    }
    misses.push_back(miss);
    wrong.push_back(std::abs(static_cast<double>(end[8]) + values.value(rounded, 5)));
  }
  EXPECT_LT(misses[1], 1e-7);
  EXPECT_NEAR(std::log2(misses[0] / misses[1]), 5, 0.3);
  EXPECT_GT(std::log2(wrong[0] / wrong[1]), 5);
}

// On the axis y'' = -y + y^2. With the energy 1/12 = y'^2/2 + y^2/2 - y^3/3 and its roots e1 < 0 <
// e2 < e3, y = e1 + (e2 - e1) sn^2, and the period is 4 K(k)/sqrt(2 (e3 - e1)/3), k^2 = (e2 -
// e1)/(e3 - e1). The roots are (1 - sqrt 3)/2, 1/2 and (1 + sqrt 3)/2.
TEST(OwnScene, HenonAndHeilesOnTheAxisHasItsPeriod) {
  Scene scene = read_scene(own / "henon-heiles.toml");
  const double s = std::sqrt(3.0);
  const double k = std::sqrt((s / 2) / s);
  scene.duration = 2 * boost::math::ellint_1(k) / std::sqrt(s / 6);
  scene.order = 2;
  const PropagationResult result = propagate(scene);
  ASSERT_EQ(result.runs.at(0).failure, "");
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(result.runs.at(0).nominal_final[i], scene.nominal[i], 1e-9) << i;
  }
}

TEST(OwnScene, ThePendulumHasItsPeriod) {
  Scene scene = read_scene(own / "pendulum.toml");
  scene.duration = 4 * boost::math::ellint_1(std::sin(scene.nominal[0] / 2));
  scene.kinds.reset();
  const PropagationResult result = propagate(scene);
  ASSERT_EQ(result.runs.at(0).failure, "");
  EXPECT_NEAR(result.runs.at(0).nominal_final[0], scene.nominal[0], 1e-10);
  EXPECT_NEAR(result.runs.at(0).nominal_final[1], 0, 1e-10);
}

// A particle that is pushed by cos(t): q'' = cos(t) from rest is at 1 - cos(t), and its jet is that
// of a free one.
TEST(OwnScene, TakesTheTime) {
  const Scene scene = parse_scene(R"scene([system]
model = "own"
coordinates = ["q"]
momenta = ["p"]
hamiltonian = "p^2/2 - q*cos(t)"
[nominal]
coordinates = [0]
momenta = [0]
[jet]
order = 2
duration_canonical = 2
)scene",
                                  "file.toml");
  const PropagationResult result = propagate(scene);
  ASSERT_EQ(result.runs.at(0).failure, "");
  EXPECT_NEAR(result.runs.at(0).nominal_final[0], 1 - std::cos(2.0), 1e-11);
  EXPECT_NEAR(result.runs.at(0).nominal_final[1], std::sin(2.0), 1e-11);
  EXPECT_NEAR(static_cast<double>(result.runs.at(0).jet[0][2]), 2, 1e-12);
}

/// The trace of the in-plane flow's linear part about L4 on an ellipse, over a turn, by RK4 in long
/// double: x'' - 2y' = a x + b y, y'' + 2x' = b x + c y, divided by 1 + e cos(f).
long double trace_about_l4(long double mu, long double e) {
  using Row = std::array<long double, 4>;
  const long double b = 3 * std::sqrt(3.0L) / 4 * (1 - 2 * mu);
  const auto slope = [&](const Row& s, long double f) {
    const long double k = 1 / (1 + e * std::cos(f));
    return Row{s[2], s[3], 2 * s[3] + k * (0.75L * s[0] + b * s[1]),
               -2 * s[2] + k * (b * s[0] + 2.25L * s[1])};
  };
  constexpr int steps = 4000;
  const long double h = 2 * std::numbers::pi_v<long double> / steps;
  long double trace = 0;
  for (std::size_t j = 0; j < 4; ++j) {
    Row s{};
    s[j] = 1;
    for (int k = 0; k < steps; ++k) {
      const auto moved = [&](const Row& f, long double part) {
        Row result = s;
        for (std::size_t i = 0; i < 4; ++i) result[i] += part * h * f[i];
        return result;
      };
      const Row f1 = slope(s, k * h);
      const Row f2 = slope(moved(f1, 0.5L), (k + 0.5L) * h);
      const Row f3 = slope(moved(f2, 0.5L), (k + 0.5L) * h);
      const Row f4 = slope(moved(f3, 1), (k + 1) * h);
      for (std::size_t i = 0; i < 4; ++i) s[i] += h / 6 * (f1[i] + 2 * f2[i] + 2 * f3[i] + f4[i]);
    }
    trace += s[j];
  }
  return trace;
}

// L4 rests in the pulsating coordinates on every ellipse; across the plane z'' = -z, whose flow
// comes back after a turn.
TEST(OwnScene, TheEllipticProblemRestsInItsTriangle) {
  const PropagationResult result = computed("elliptic-restricted.toml");
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(result.runs.at(0).nominal_final[i], result.scene.nominal[i], 1e-12) << i;
  }
  const Matrix<double> turn = linear_part(result);
  EXPECT_NEAR(turn(2, 2), 1, 1e-10);
  EXPECT_NEAR(turn(5, 5), 1, 1e-10);
  EXPECT_NEAR(turn(2, 5), 0, 1e-10);
  EXPECT_NEAR(turn.trace() - 2, static_cast<double>(trace_about_l4(1 / 82.30059L, 0.0549L)), 1e-8);
}

// x' = v, v' = -x - 2c v has the flow of a damped oscillator, and its jet is in the states alone.
TEST(OwnScene, AVectorFieldHasItsJetInTheStates) {
  const Scene scene = parse_scene(R"([system]
model = "own"
states = ["x", "v"]
parameters = { c = 0.1 }
vector_field = { x = "v", v = "-x - 2*c*v" }
[nominal]
states = [1, 0]
[jet]
order = 2
duration_canonical = 3
)",
                                  "file.toml");
  EXPECT_EQ(scene.variables, (std::vector<std::size_t>{0, 1}));
  const PropagationResult result = propagate(scene);
  ASSERT_EQ(result.runs.at(0).failure, "");
  EXPECT_TRUE(result.runs.at(0).failed_checks.empty());
  const double w = std::sqrt(0.99), t = 3, decay = std::exp(-0.3);
  const double x = decay * (std::cos(w * t) + 0.1 / w * std::sin(w * t));
  const double v = -decay / w * std::sin(w * t);
  EXPECT_NEAR(result.runs.at(0).nominal_final[0], x, 1e-11);
  EXPECT_NEAR(result.runs.at(0).nominal_final[1], v, 1e-11);
  EXPECT_NEAR(static_cast<double>(result.runs.at(0).jet[0][2]), decay / w * std::sin(w * t), 1e-11);
}

}  // namespace
}  // namespace hamjet::io
