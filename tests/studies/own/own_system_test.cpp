#include <gtest/gtest.h>

#include "hamjet/detail/studies/self_checks.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/maps/symplecticity.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/comparison.hpp"
#include "support/errors.hpp"

// A scene of a Hamiltonian of the user's own gets what a scene of a file gets.

namespace hamjet {
namespace {

/// Two oscillators with a cubic coupling; Hénon and Heiles, Astronomical Journal 69 (1964) 73.
struct CubicCoupling {
  double coupling = 1;

  template <class T>
  T operator()(std::span<const T> q, std::span<const T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + q[0] * q[0] + q[1] * q[1]) / T(2) +
           T(coupling) * (q[0] * q[0] * q[1] - q[1] * q[1] * q[1] / T(3));
  }
};

Scene coupled_scene(double coupling) {
  Scene scene =
      make_scene(make_system("coupled", 2, CubicCoupling{coupling}), {0.1, 0.2, 0.25, 0}, 5, 3);
  scene.integrators = {{.label = "gauss8", .stages = 8, .tolerance = 1e-12}};
  scene.kinds = {"F1"};
  scene.reference = ReferenceSettings{};
  scene.separation = 1e-3;
  return scene;
}

// The same Hamiltonian by its name and as one's own: the same operations, hence the same bits.
TEST(OwnSystem, GivesTheJetOfTheSameSystemByName) {
  const std::vector<double> nominal = {1, 0, 0.1, 0, 0.9, 0.2};
  Scene own = make_scene(kepler(), nominal, 3, 3);
  own.integrators = {{.label = "gauss8", .stages = 8, .tolerance = 1e-12}};
  Scene named = own;
  named.own_system = nullptr;
  named.system.model = SystemModel::kepler;
  const FlowJet<Extended> a = propagate(own).runs.at(0).jet;
  const FlowJet<Extended> b = propagate(named).runs.at(0).jet;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < a[i].size(); ++k) EXPECT_EQ(a[i][k], b[i][k]) << i << " " << k;
  }
}

TEST(OwnSystem, HasReferenceChecksAndGeneratingFunction) {
  const PropagationResult result = propagate(coupled_scene(1));
  ASSERT_TRUE(result.reference) << result.reference_failure;
  const RunResult& run = result.runs.at(0);
  EXPECT_EQ(run.failure, "");
  EXPECT_TRUE(run.failed_checks.empty());
  ASSERT_TRUE(run.error_by_degree);
  // A hundred tolerances a period, which the duration falls short of, are what is promised.
  for (const double error : *run.error_by_degree) EXPECT_LE(error, 100 * 1e-12);
  ASSERT_EQ(run.kinds.size(), 1U);
  EXPECT_TRUE(run.kinds[0].generating_function) << run.kinds[0].failure;
}

// Two equal oscillators turn into themselves. A linear flow has no degrees above the first: what a
// rotation that is left out and put back left there was rounding, which checks compared with
// itself.
TEST(OwnSystem, ALinearFlowHasNoHigherDegrees) {
  const Scene scene = io::parse_scene(R"(
system = { model = "own", coordinates = ["x", "y"], momenta = ["px", "py"], hamiltonian = "(px^2+py^2+x^2+y^2)/2" }
nominal = { coordinates = [0.7, 0.4], momenta = [0.1, -0.2] }
jet = { order = 3, duration_canonical = 1 }
)",
                                      "oscillators.toml");
  const PropagationResult result = propagate(scene);
  const RunResult& run = result.runs.at(0);
  EXPECT_TRUE(run.failed_checks.empty());
  for (const Series<Extended>& component : run.jet) {
    for (std::size_t k = component.space().first(2); k < component.size(); ++k) {
      EXPECT_EQ(component[k], 0) << k;
    }
  }
}

// Forces that are linear but for what cancels: degrees of which rounding alone is left are no
// defect of the map, and a defect of the same size as theirs in one that is not linear is.
TEST(OwnSystem, RoundingOfWhatCancelsIsNoDefect) {
  const auto scene_of = [](const std::string& hamiltonian) {
    return io::parse_scene(
        "[system]\nmodel = \"own\"\ncoordinates = [\"x\"]\nmomenta = [\"p\"]\n"
        "hamiltonian = \"" +
            hamiltonian +
            "\"\n[nominal]\ncoordinates = [0.3]\nmomenta = [0.2]\n[jet]\n"
            "order = 4\nduration_canonical = 5\n",
        "cancels.toml");
  };
  for (const char* const hamiltonian :
       {"p^2/2 + (sqrt((x + 1)^2) - 1)^2/2", "p^2/2 + sqrt((x + 1)^4)/2 + sin(x)^2 + cos(x)^2",
        "p^2/2 + (sqrt((1000*x + 1000)^2) - 1000)^2/2e6", "p^2/2 + log(exp(x))^2/2"}) {
    const PropagationResult result = propagate(scene_of(hamiltonian));
    EXPECT_TRUE(result.runs.at(0).failure.empty()) << hamiltonian;
    EXPECT_TRUE(result.runs.at(0).failed_checks.empty()) << hamiltonian;
  }
  const Scene bent = scene_of("p^2/2 + (sqrt((x + 1)^2) - 1)^2/2 + 1e-3*x^3");
  PropagationResult result = propagate(bent);
  RunResult& run = result.runs.at(0);
  EXPECT_TRUE(run.failed_checks.empty());
  const std::size_t second = run.jet[0].space().first(2);
  run.jet[0][second] += 1e-9;
  run.symplecticity = symplecticity_by_degree(run.jet);
  for (const SelfCheck& check : self_checks(bent, run)) {
    if (check.name != SelfCheckName::symplecticity) continue;
    EXPECT_EQ(check.state, SelfCheckState::failed) << check.text;
  }
}

TEST(OwnSystem, IsCompared) {
  Scene scene = coupled_scene(1);
  scene.comparison.methods = {IntegrationMethod::gauss, IntegrationMethod::velocity_verlet};
  scene.comparison.stages = {4};
  scene.comparison.steps_canonical = {0.5, 0.25};
  scene.comparison.orders = {1};
  scene.comparison.repeats = 1;
  ComparisonResult result;
  compare(scene, {}, result);
  ASSERT_FALSE(result.runs.empty());
  for (const ComparedRun& run : result.runs) EXPECT_TRUE(run.is_finished()) << run.failure;
}

// References are kept by what determines them: the Hamiltonian itself, not its name.
TEST(OwnSystem, ReferencesOfOtherHamiltoniansAreOthers) {
  EXPECT_EQ(reference_key(coupled_scene(1), 3), reference_key(coupled_scene(1), 3));
  EXPECT_NE(reference_key(coupled_scene(1), 3), reference_key(coupled_scene(2), 3));
}

// A force written by hand is integrated in place of the Hamiltonian's own: the key holds it too,
// and which of a list's values is the Hamiltonian.
TEST(OwnSystem, ReferencesOfOtherFieldsAreOthers) {
  const auto potential = [](std::span<const Expression> q, std::span<const Expression> p) {
    return p[0] * p[0] / Expression(2) + q[0] * q[0] / Expression(2);
  };
  const auto key = [&](double stiffness) {
    const auto force = [=](std::span<const Expression> q) {
      return std::vector<Expression>{Expression(-stiffness) * q[0]};
    };
    return reference_key(make_scene(make_system("spring", 1, potential, force), {1, 0}, 1, 2), 2);
  };
  EXPECT_NE(key(1), key(1.5));
  const auto key_of = [](bool is_sine) {
    const auto h = [=](std::span<const Expression> q, std::span<const Expression> p) {
      const Expression f = q[0] + p[0];
      return is_sine ? sin(f) : cos(f);
    };
    return reference_key(make_scene(make_system("wave", 1, h), {1, 0}, 1, 2), 2);
  };
  EXPECT_NE(key_of(true), key_of(false));
}

TEST(OwnSystem, RefusesWhatCannotBeRun) {
  const auto make = [](int order, const CanonicalUnits& units) {
    return make_scene(make_system("coupled", 2, CubicCoupling{}), {0.1, 0, 0, 0}, 1, order, units);
  };
  test::expect_error(ErrorKind::usage, "order 0", [&] { make(0, {1, 1}); });
  test::expect_error(ErrorKind::usage, "positive units", [&] { make(1, {0, 1}); });
  Scene scene = coupled_scene(1);
  scene.integrators.push_back(scene.integrators[0]);
  test::expect_error(ErrorKind::usage, "stands twice", [&] { propagate(scene); });
  scene = coupled_scene(1);
  scene.integrators[0].tolerance.reset();
  test::expect_error(ErrorKind::usage, "either a step or a tolerance", [&] { propagate(scene); });
  test::expect_error(ErrorKind::usage, "own_system", [&] { make_system(scene.system, 1); });
}

TEST(OwnSystem, RefusesANominalOfAnotherSize) {
  test::expect_error(ErrorKind::usage, "2 degrees of freedom and a nominal of 3 numbers", [] {
    make_scene(make_system("coupled", 2, CubicCoupling{}), {1, 2, 3}, 1, 2);
  });
}

}  // namespace
}  // namespace hamjet
