#include "refused_scene.hpp"

// Scenes that write their own system, with one mistake each: what users of other programs write by
// habit, and what has no Taylor series or no canonical equations. Columns and lines are counted by
// hand.

namespace hamjet::test {
namespace {

using std::string;

const string own_scene = R"T(schema = 1
title = "own"
[system]
model = "own"
coordinates = ["x", "y"]
momenta = ["px", "py"]
parameters = { mu = 0.01, k = "2*mu" }
definitions = { r = "sqrt(x^2 + y^2)" }
hamiltonian = "(px^2 + py^2)/2 - 1/r + k*x"
[nominal]
coordinates = [1, 0]
momenta = [0, 1]
[jet]
order = 2
duration_canonical = 1
)T";
const string hamiltonian = R"T(hamiltonian = "(px^2 + py^2)/2 - 1/r + k*x")T";

using BadOwn = RefusedScene;

TEST_F(BadOwn, NamesAreOneLine) {
  const std::vector<Mistake> mistakes = {
      {"k*x\"", "kk*x\"", {":9:15: system.hamiltonian", "\"kk\" at column 25", "k, mu, px"}},
      {"1/r", "1/R", {"\"R\" at column 21", "must be one of"}},
      {"2*mu", "2*nu", {":7:31: system.parameters.k", "\"nu\" at column 3"}},
      {"mu = 0.01", "mu = \"x\"", {"parameters.mu: not constant", "numbers and parameters"}},
      {"mu = 0.01", "mu = \"t\"", {"parameters.mu: not constant, got \"t\""}},
      {"mu = 0.01", "mu = \"k\"", {"parameters.k: defined by itself", "parameters.mu"}},
      {"\"sqrt(x^2 + y^2)\"", "\"r + x\"", {"definitions.r: defined by itself"}},
      {"mu = 0.01", "x = 1, mu = 0.01", {"parameters.x: a name given twice", "a variable"}},
      {"{ r =", "{ mu =", {"definitions.mu: a name given twice", "parameters.mu"}},
      {"mu = 0.01", "pi = 3, mu = 0.01", {"parameters.pi: a name that is taken", "number pi"}},
      {"[\"px\", \"py\"]", "[\"px\", \"sin\"]", {"system.momenta", "the function sin"}},
      {"[\"x\", \"y\"]", "[\"x\", \"t\"]", {"system.coordinates", "t is the time"}},
      {"[\"px\", \"py\"]", "[\"px\", \"2p\"]", {":6:11: system.momenta: no name", "a letter"}}};
  ASSERT_EQ(mistakes.size(), 13U);
  expect_each_refused(own_scene, mistakes);
}

TEST_F(BadOwn, VariablesAreOneLine) {
  const std::vector<Mistake> mistakes = {
      {"momenta = [\"px\", \"py\"]\n", "", {":3:1: system.momenta: missing"}},
      {"[\"px\", \"py\"]", "[\"px\"]", {"system.momenta: wrong length", "must be 2"}},
      {"[\"px\", \"py\"]", "[\"px\", \"px\"]", {"system.momenta: a name given twice, got px"}},
      {"[\"x\", \"y\"]", "[]", {"system.coordinates: empty", "at least one"}},
      {"coordinates = [1, 0]", "coordinates = [1]", {":11:15: nominal.coordinates", "array of 2"}},
      {"coordinates = [1, 0]", "position_km = [1, 0]", {"nominal.position_km", "no key"}},
      {"momenta = [0, 1]", "momenta = [0, nan]", {"nominal.momenta.1: not finite"}},
      {"momenta = [0, 1]", "velocities = [0, 1]", {"nominal.velocities", "momenta"}},
      {"[nominal]", "[units]\nlength_km = 9\n[nominal]", {"units.time_s: missing", "above 0"}},
      {"[nominal]",
       "[units]\nlength_km = 1e200\ntime_s = 1e-200\nmass_kg = 5\n[nominal]",
       {"units.mass_kg: out of range", "within binary64"}},
      {"model = \"own\"", "model = \"own\"\nmu_km3_s2 = 4e5", {"system.mu_km3_s2", "no key"}}};
  ASSERT_EQ(mistakes.size(), 11U);
  expect_each_refused(own_scene, mistakes);
}

TEST_F(BadOwn, ExpressionsAreOneLine) {
  const std::vector<Mistake> mistakes = {
      {"sqrt(x^2 + y^2)", "sqrt(x^2, y^2)", {"definitions.r", "2 arguments", "must have 1"}},
      {"k*x", "atan2(y)", {"atan2", "must have 2, as atan2(y, x)"}},
      {"k*x", "k x", {"no operator, got \"x\"", "such as *"}},
      {"k*x", "sin x", {"without parentheses", "sin(x)"}},
      {"k*x", "k*x)", {"\")\" without \"(\"", "left out"}},
      {"(px^2", "((px^2", {"not closed", "must be \")\""}},
      {"k*x", "abs(x)", {"a corner", "must be a smooth function"}},
      {"k*x", "gamma(x)", {"unknown function", "sqrt, exp"}},
      {hamiltonian, "hamiltonian = \"\"", {"system.hamiltonian: empty"}},
      {hamiltonian, "hamiltonian = 3", {"system.hamiltonian: wrong type", "must be a string"}},
      {hamiltonian, "hamiltonian = \"H = px^2\"", {"an equation", "must be an expression alone"}}};
  ASSERT_EQ(mistakes.size(), 11U);
  expect_each_refused(own_scene, mistakes);
}

TEST_F(BadOwn, WhatHasNoValueIsOneLine) {
  const std::vector<Mistake> mistakes = {
      {"mu = 0.01", "mu = \"1/0\"", {"parameters.mu: division by zero"}},
      {"mu = 0.01", "mu = \"sqrt(-1)\"", {"parameters.mu: no finite real value", "given -1"}},
      {"mu = 0.01", "mu = inf", {"parameters.mu: not finite"}},
      {"mu = 0.01", "mu = \"log(0)\"", {"parameters.mu: no finite real value", "\"log\""}},
      {"coordinates = [1, 0]", "coordinates = [0, 0]", {"at the start: division by zero"}},
      {"y^2)\"", "y^2 - 2)\"", {"definitions.r: at the start: no finite real value", "given -1"}},
      {"k*x", "log(x - 1)", {"at the start: no finite real value, got \"log\"", "given 0"}},
      {"k*x", "(x - 1)^0.5", {"no finite equations of motion at the start"}},
      {"k*x", "asin(2*x)", {"at the start: no finite real value, got \"asin\""}}};
  ASSERT_EQ(mistakes.size(), 9U);
  expect_each_refused(own_scene, mistakes);
}

TEST_F(BadOwn, StudiesAreOneLine) {
  const auto table = [](const string& text) { return text + "\n[nominal]"; };
  const std::vector<Mistake> mistakes = {
      {"[nominal]",
       table("[event]\nsurface = \"apsis\""),
       {"event.surface: of an orbit, got", "must be \"expression\""}},
      {"[nominal]",
       table("[event]\nsurface = \"expression\""),
       {"event.expression: missing", "must be a string"}},
      {"[nominal]",
       table("[event]\nsurface = \"expression\"\nexpression = \"x - q\""),
       {"event.expression", "\"q\" at column 5", "must be one of"}},
      {"[nominal]",
       table("[event]\nsurface = \"expression\"\nexpression = \"x - t\""),
       {"event.expression: depends on the time"}},
      {"[nominal]",
       table("[event]\nsurface = \"expression\"\nexpression = \"mu*2\""),
       {"event.expression: the same everywhere", "must depend on the variables"}},
      {"[nominal]",
       table("[uncertainty]\nposition_m = [1, 1, 1]"),
       {"uncertainty.position_m: wrong length", "must be an array of 2"}},
      {"[nominal]",
       table("[uncertainty]\nposition_m = [1, 1e155]"),
       {"uncertainty.position_m.1: no standard deviation", "far from the nominal"}},
      {"[nominal]",
       table("[uncertainty]\nburn = { velocity_change_m_s = [1, 0, 0], magnitude = 0.1 }"),
       {"uncertainty.burn: has a direction in space", "must be left out"}},
      {"[nominal]",
       table("[uncertainty]\nposition_m = [1, 1]\ncollision = { radius_m = 1 }"),
       {"uncertainty.collision: for spacecraft in an orbit", "must be left out"}},
      {"[nominal]", table("[periodic]\nhold = \"z\""), {"periodic.hold", "energy, period, x"}},
      {"[nominal]", table("[periodic]\narcs = 0"), {"periodic.arcs", "from 1 to 64"}},
      {"[nominal]",
       table("[periodic]\nhold = \"period\"\nvalue = -1"),
       {"periodic.value", "above"}},
      {"[nominal]",
       table("[periodic.family]\nalong = \"parameters.nu\"\nto = 1"),
       {"periodic.family.along", "parameters.mu, parameters.k"}},
      {"[nominal]", table("[periodic.family]\nalong = \"x\""), {"periodic.family.to: missing"}},
      {"duration_canonical = 1", "duration_canonical = -1\n[periodic]", {"periodic: no guess"}},
      {"duration_canonical = 1", "duration_orbits = 1", {"jet.duration_orbits", "no key"}}};
  ASSERT_EQ(mistakes.size(), 16U);
  expect_each_refused(own_scene, mistakes);
  // An orbit that closes at one time does not at another where the forces change.
  expect_refused(changed(own_scene, "k*x", "k*x*cos(t)"), "[nominal]", "[periodic]\n[nominal]",
                 {"periodic: the Hamiltonian depends on the time, got t", "without t"});
}

// What a study of orbits lacks is not asked for, since it would be refused.
TEST_F(BadOwn, StudiesOfOrbitsNameWhatServesInstead) {
  write("own.toml", own_scene);
  for (const char* const command : {"motion", "assign", "bounded"}) {
    SCOPED_TRACE(command);
    expect_error({command, "own.toml"}, 3,
                 {string("own.toml: system.model: `hamjet ") + command + "` is about orbits, got",
                  "\"own\"", "`hamjet transfer`, `hamjet validity` and `hamjet uncertainty`"});
  }
  expect_error({"poincare", "own.toml"}, 3,
               {"own.toml: event: missing, must be a table [event]", "expression = \"x\""});
  write("deputy.toml", own_scene + "[deputy]\nposition_m = [1, 0]\n");
  expect_error({"motion", "deputy.toml"}, 3,
               {"deputy: not available for this model", "`hamjet transfer`, `hamjet validity`"});
}

}  // namespace
}  // namespace hamjet::test
