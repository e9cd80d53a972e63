#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <string>

#include "hamjet/error.hpp"
#include "scene/study_reader.hpp"

namespace hamjet::io {
namespace {

const std::filesystem::path scenes = std::filesystem::path(HAMJET_SOURCE_DIR) / "data/scenes";

/// A scene whose conversions are exact: the nominal is 4 km from a centre with mu = 1 km^3/s^2, so
/// that the units are 4 km, 8 s and 0.5 km/s, and at half a km/s it is on a circle.
constexpr const char* round_orbit = R"(schema = 1
title = "circle"
[system]
model = "zonal-gravity"
mu_km3_s2 = 1
radius_km = 2
J2 = 0.25
[nominal]
position_km = [4, 0, 0]
velocity_km_s = [0, 0.5, 0]
[jet]
order = 3
duration_s = -16
[[integrator]]
label = "a"
method = "gauss"
step_s = 4
[[integrator]]
label = "b.2"
method = "cvode-bdf"
tolerance = 1e-3
require_relative_error = 1e-2
require_symplecticity = 1
)";

constexpr const char* slow_oscillator = R"(schema = 1
title = "oscillator"
precision = "extended"
[system]
model = "harmonic-oscillator"
stiffness_N_per_m = 4
[nominal]
position_m = [2]
momentum_kg_m_s = [-3.5]
[jet]
order = 1
variables = ["p"]
duration_s = 0
[[integrator]]
label = "a"
method = "fehlberg78"
tolerance = 1e-30
[formation]
separation_m = 0.5
)";

const double pi = std::acos(-1.0);

// Expected: the units in the comment on `round_orbit`; p = v / 0.5, duration / 8 s, step / 8 s, 2
// km / 4.
TEST(Scene, ConvertsToCanonicalUnits) {
  const Scene scene = parse_scene(round_orbit, "dir/circle.toml");
  EXPECT_EQ(scene.name, "circle");
  EXPECT_EQ(scene.title, "circle");
  EXPECT_EQ(scene.precision, Precision::double_precision);
  EXPECT_EQ(scene.system.model, SystemModel::zonal_gravity);
  EXPECT_EQ(scene.system.mu_km3_s2, 1);
  EXPECT_EQ(scene.system.radius_km, 2);
  EXPECT_EQ(scene.system.J[2], 0.25);
  EXPECT_EQ(scene.system.J[3], 0);
  EXPECT_EQ(scene.units.length_km, 4);
  EXPECT_EQ(scene.units.time_s, 8);
  EXPECT_EQ(scene.canonical_radius, 0.5);
  EXPECT_EQ(scene.nominal, (std::vector<double>{1, 0, 0, 0, 1, 0}));
  EXPECT_EQ(scene.duration, -2);
  EXPECT_EQ(scene.order, 3);
  EXPECT_EQ(scene.variables, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
  ASSERT_EQ(scene.integrators.size(), 2U);
  const IntegratorSettings& gauss = scene.integrators[0];
  EXPECT_EQ(gauss.label, "a");
  EXPECT_EQ(gauss.method, IntegrationMethod::gauss);
  EXPECT_EQ(gauss.stages, 8);
  EXPECT_EQ(gauss.step_canonical, 0.5);
  EXPECT_FALSE(gauss.tolerance || gauss.require_relative_error || gauss.require_symplecticity);
  const IntegratorSettings& cvode = scene.integrators[1];
  EXPECT_EQ(cvode.label, "b.2");
  EXPECT_EQ(cvode.method, IntegrationMethod::cvode_bdf);
  EXPECT_EQ(cvode.tolerance, 1e-3);
  EXPECT_EQ(cvode.require_relative_error, 1e-2);
  EXPECT_EQ(cvode.require_symplecticity, 1);
  EXPECT_FALSE(cvode.step_canonical || scene.separation || scene.kinds || scene.reference);
}

// Expected: metre, kilogram and second stay, 1 m = 1e-3 km.
TEST(Scene, LeavesTheOscillatorInItsUnits) {
  const Scene scene = parse_scene(slow_oscillator, "oscillator.toml");
  EXPECT_EQ(scene.precision, Precision::extended);
  EXPECT_EQ(scene.system.model, SystemModel::harmonic_oscillator);
  EXPECT_EQ(scene.system.mass_kg, 1);
  EXPECT_EQ(scene.system.stiffness_N_per_m, 4);
  EXPECT_EQ(scene.units.length_km, 1e-3);
  EXPECT_EQ(scene.units.time_s, 1);
  EXPECT_EQ(scene.nominal, (std::vector<double>{2, -3.5}));
  EXPECT_EQ(scene.duration, 0);
  EXPECT_EQ(scene.variables, (std::vector<std::size_t>{1}));
  EXPECT_EQ(scene.integrators[0].method, IntegrationMethod::fehlberg78);
  EXPECT_EQ(scene.integrators[0].tolerance, 1e-30);
  EXPECT_EQ(scene.separation, 0.5);
}

// Expected: a circle of radius 1 has the period 2 pi.
TEST(Scene, TakesEachFormOfDuration) {
  const auto duration = [](const std::string& form) {
    return parse_scene(round_orbit, "x", {{"jet", "{order = 1, " + form + "}"}}).duration;
  };
  EXPECT_EQ(duration("duration_orbits = 1"), 2 * pi);
  EXPECT_EQ(duration("duration_orbits = -0.5"), -pi);
  EXPECT_EQ(duration("duration_canonical = 0.1"), 0.1);
  EXPECT_EQ(duration("duration_s = 0"), 0);
}

// Expected: the state of the reference case SEED-10PI, computed apart from this program in 60
// decimal digits: sqrt(1.3)/2 and sqrt(1.3) sqrt(3)/2 lie 0.35 and 0.19 units in the last place
// from these, so that they are the nearest binary64 numbers. So are the units: 7000 km, sqrt(7000^3
// / mu) s, and 2 pi (1/0.7)^(3/2) for the period.
TEST(Scene, ConvertsThePapersOrbitToTheLastBit) {
  const auto file = scenes / "paper/earth-orbit.toml";
  const Scene scene = read_scene(file);
  EXPECT_EQ(scene.name, "earth-orbit");
  EXPECT_EQ(scene.nominal,
            (std::vector<double>{1, 0, 0, 0, 0x1.23e2896280f23p-1, 0x1.f98f3adef13f2p-1}));
  EXPECT_EQ(scene.units.length_km, 7000);
  EXPECT_EQ(scene.units.time_s, 0x1.cfd190ed1555ap+9);
  EXPECT_EQ(scene.canonical_radius, 0x1.d283e1c01dcf3p-1);
  EXPECT_EQ(scene.separation, 0x1.767dce434a9b1p-10);
  EXPECT_EQ(scene.duration, 31.41592653589793);
  EXPECT_EQ(scene.system.J[3], 2.532436e-6);
  EXPECT_EQ(scene.kinds, (std::vector<std::string>{"F1", "auto"}));
  ASSERT_TRUE(scene.reference.has_value());
  EXPECT_EQ(scene.reference->tolerance, 1e-24);
  const Scene revolution = read_scene(file, {{"jet", "{order = 4, duration_orbits = 1}"}});
  EXPECT_EQ(revolution.duration, 10.728346909843646);
}

// Expected: with mu fixed, lengths times 4^k, velocities over 2^k and times times 8^k are the same
// scene, and powers of two change no bit.
TEST(Scene, IsTheSameAtEveryScale) {
  const std::vector<Override> plain = {{"nominal.position_km", "[3, -1.25, 0.3]"},
                                       {"nominal.velocity_km_s", "[0.1, 0.4, 0.2]"}};
  const Scene expected = parse_scene(round_orbit, "x", plain);
  for (const int k : {-240, -166, -20, 20, 166, 240}) {
    const auto number = [k](double value, int power) {
      std::ostringstream text;
      text << std::setprecision(17) << std::ldexp(value, power * k);
      return text.str();
    };
    const Scene scaled =
        parse_scene(round_orbit, "x",
                    {{"nominal.position_km",
                      "[" + number(3, 2) + ", " + number(-1.25, 2) + ", " + number(0.3, 2) + "]"},
                     {"nominal.velocity_km_s", "[" + number(0.1, -1) + ", " + number(0.4, -1) +
                                                   ", " + number(0.2, -1) + "]"},
                     {"system.radius_km", number(2, 2)},
                     {"jet.duration_s", number(-16, 3)},
                     {"integrator.a.step_s", number(4, 3)}});
    EXPECT_EQ(scaled.nominal, expected.nominal) << k;
    EXPECT_EQ(scaled.duration, expected.duration) << k;
    EXPECT_EQ(scaled.canonical_radius, expected.canonical_radius) << k;
    EXPECT_EQ(scaled.integrators[0].step_canonical, expected.integrators[0].step_canonical) << k;
    EXPECT_EQ(scaled.units.length_km, std::ldexp(expected.units.length_km, 2 * k)) << k;
    EXPECT_EQ(scaled.units.time_s, std::ldexp(expected.units.time_s, 3 * k)) << k;
  }
}

// Expected: the definitions; an equatorial orbit without J3 has a plane subsystem of 4 variables.
TEST(Scene, TakesKindsOfGeneratingFunctions) {
  const auto kinds = [](const std::string& list, const std::string& variables) {
    return parse_scene(round_orbit, "x",
                       {{"generating_function.kinds", list}, {"jet.variables", variables}})
        .kinds.value();
  };
  const std::string all = R"(["pz", "x", "y", "z", "px", "py"])";
  EXPECT_EQ(kinds(R"(["F1", "F2", "F3", "F4", "auto", "qpq-qqp"])", all),
            (std::vector<std::string>{"F1", "F2", "F3", "F4", "auto", "qpq-qqp"}));
  const std::string plane = R"(["py", "x", "px", "y"])";
  EXPECT_EQ(kinds(R"(["qq-pp", "F1", "qp-pq"])", plane),
            (std::vector<std::string>{"qq-pp", "F1", "qp-pq"}));
  EXPECT_EQ(parse_scene(slow_oscillator, "x",
                        {{"generating_function.kinds", R"(["q-p", "F1"])"},
                         {"jet.variables", R"(["p", "q"])"}})
                .kinds,
            (std::vector<std::string>{"q-p", "F1"}));
}

TEST(Scene, SortsVariables) {
  EXPECT_EQ(parse_scene(round_orbit, "x", {{"jet.variables", R"(["py", "x", "z"])"}}).variables,
            (std::vector<std::size_t>{0, 2, 4}));
}

TEST(Scene, TakesEmptyReferenceForItsDefault) {
  EXPECT_EQ(parse_scene(round_orbit, "x", {{"reference", "{}"}}).reference.value().tolerance,
            1e-24);
}

// Expected: the rule in Scene::name.
TEST(Scene, NamesItselfAfterTheFile) {
  const auto name = [](const char* file) { return parse_scene(round_orbit, file).name; };
  EXPECT_EQ(name("a/b/my scene.v2.toml"), "my_scene.v2");
  EXPECT_EQ(name("..hidden.toml"), "hidden");
  EXPECT_EQ(name("<a\n\"b>.toml"), "_a__b_");
  EXPECT_EQ(name(".."), "scene");
}

TEST(Scene, AcceptsWindowsLineEndsAndByteOrderMark) {
  std::string text = "\xef\xbb\xbf";
  for (const char c : std::string(round_orbit))
    text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(parse_scene(text, "x").nominal, parse_scene(round_orbit, "x").nominal);
}

TEST(Scene, IsNotMisledByStringsAndComments) {
  const std::string nested(100, '[');
  const std::string text = std::string(round_orbit) + "# 1e999 " + nested + "\n[reference] # \"\n";
  const std::vector<Override> titles = {{"title", "'1e999" + nested + "'"},
                                        {"title", "\"a\\\"" + nested + "\""},
                                        {"title", "\"\"\"1e999\n" + nested + "\"\"\"\""}};
  for (const Override& title : titles) {
    EXPECT_EQ(parse_scene(text, "x", {title}).order, 3) << title.value;
  }
}

TEST(SceneOverride, ReachesEveryKey) {
  const Scene scene = parse_scene(round_orbit, "x",
                                  {{"jet.order", "2"},
                                   {"integrator.0.stages", "3"},
                                   {"integrator.a.label", "first"},
                                   {"integrator.b.2.tolerance", "1e-5"},
                                   {"formation.separation_km", "8"},
                                   {"nominal.position_km.0", "-4"},
                                   {"system.J3", "-1e-6"}});
  EXPECT_EQ(scene.order, 2);
  EXPECT_EQ(scene.integrators[0].stages, 3);
  EXPECT_EQ(scene.integrators[0].label, "first");
  EXPECT_EQ(scene.integrators[1].tolerance, 1e-5);
  EXPECT_EQ(scene.separation, 2);
  EXPECT_EQ(scene.nominal[0], -1);
  EXPECT_EQ(scene.system.J[3], -1e-6);
}

TEST(SceneOverride, TakesForAStringWhatIsNotToml) {
  const auto title = [](const char* value) {
    return parse_scene(round_orbit, "x", {{"title", value}}).title;
  };
  EXPECT_EQ(title("two words"), "two words");
  EXPECT_EQ(title("\"quoted\""), "quoted");
  EXPECT_EQ(title("a\"b\\c\nd"), "a\"b\\c\\x0ad");
  EXPECT_EQ(title("\"\""), "");
}

TEST(SceneOverride, TwoOfOneKeyAreRefused) {
  try {
    (void)parse_scene(round_orbit, "x", {{"jet.order", "5"}, {"jet.order", "6"}});
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_STREQ(error.what(), "--set jet.order: given twice, as 5 and as 6; must be given once");
  }
}

TEST(ShippedScenes, AreAllRead) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes)) {
    if (entry.path().extension() != ".toml") continue;
    // Some cases of `hamjet stability` are meant to be refused.
    if (entry.path().parent_path().filename() == "extreme") continue;
    // Studies of `hamjet sweep`, and the scenes that they vary.
    if (entry.path().parent_path().filename() == "sweeps") continue;
    ++count;
    Study study;
    ASSERT_NO_THROW(study = read_study(entry.path())) << entry.path();
    if (!std::holds_alternative<Scene>(study)) continue;
    const Scene scene = std::get<Scene>(study);
    EXPECT_EQ(scene.name, entry.path().stem().string());
    // A study of relative motion or of a distribution uses one integrator, and is proved by flying.
    if (scene.transfer || scene.deputy || scene.bounded || scene.uncertainty) continue;
    // Jets of systems that scenes write are compared with closed forms and published numbers.
    if (scene.system.model == SystemModel::own) continue;
    EXPECT_TRUE(scene.reference.has_value()) << entry.path();
    EXPECT_GE(scene.integrators.size(), 2U) << entry.path();
  }
  EXPECT_GE(count, 4);
}

}  // namespace
}  // namespace hamjet::io
