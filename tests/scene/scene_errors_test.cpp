#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene_samples.hpp"

// Every rule of the scene's schema, broken once. What is expected is the rule itself: the kind of
// error, and the words without which the user could not mend the scene.

namespace hamjet::io {
namespace {

struct Change {
  const char* from;
  const char* to;
  std::vector<std::string> words;
  ErrorKind kind = ErrorKind::scene;
};

void expect_errors(const std::string& scene, const std::vector<Change>& changes) {
  ASSERT_NO_THROW(parse_scene(scene, "file.toml"));
  for (const Change& change : changes) {
    SCOPED_TRACE(std::string(change.to).substr(0, 200));
    expect_scene_error(changed(scene, change.from, change.to), change.words, change.kind);
  }
}

TEST(SceneErrors, Top) {
  expect_errors(
      orbit,
      {{"schema = 1", "schema = 2", {"file.toml:1:10: schema: ", "got 2", "must be the integer 1"}},
       {"schema = 1", "schema = 1.0", {"schema: wrong type", "1.0"}},
       {"schema = 1", "shema = 1", {"file.toml:1:1: shema: unknown key", "did you mean schema?"}},
       {"title = \"orbit\"", "title = 3", {":2:9: title: wrong type, got 3, must be a string"}},
       {"title",
        "precision = \"extnded\"\ntitle",
        {"precision: unknown value", "\"extnded\"", "double, extended", "did you mean extended?"}},
       {"title",
        "precision = 2\ntitle",
        {"precision: wrong type, got 2, must be one of: double, extended"}},
       {"title",
        "zzz = 1\ntitle",
        {":2:1: zzz: unknown key",
         "must be one of: schema, title, precision, system, units, nominal"}},
       {"[reference]", "[refrence]", {":27:2: refrence: unknown key", "did you mean reference?"}},
       {"[reference]", "[methd]", {"methd: unknown key", "integrator"}},
       {"[jet]", "[jet.jet]", {":11:6: jet.jet: unknown key"}},
       {"title = \"orbit\"", "title = \"orbit\"\nsystem = 3", {"file.toml:4:1"}},
       {"[formation]\nseparation_km = 10",
        "[[formation]]\nseparation_km = 10",
        {"formation: wrong type, got an array, must be a table [formation]"}}});
}

TEST(SceneErrors, MissingTables) {
  const std::string head = "schema = 1\ntitle = \"t\"\n";
  const std::string system = "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 1\n";
  const std::string nominal = "[nominal]\nposition_km = [1, 0, 0]\nvelocity_km_s = [0, 1, 0]\n";
  const std::string jet = "[jet]\norder = 1\nduration_s = 1\n";
  expect_scene_error(head + nominal + jet, {"system: missing, must be a table"});
  expect_scene_error(head + system + jet, {"nominal: missing"});
  expect_scene_error(head + system + nominal, {"jet: missing"});
  expect_scene_error("integrator = []\n" + head + system + nominal + jet, {"integrator: empty"});
  expect_scene_error("integrator = [1]\n" + head + system + nominal + jet,
                     {"file.toml:1:15: integrator.0: wrong type, got 1, must be a table"});
  expect_scene_error(head + system + nominal + jet + "[integrator]\nlabel = \"a\"\n",
                     {":12:1: integrator: wrong type, got a table", "[[integrator]]"});
}

TEST(SceneErrors, System) {
  expect_errors(
      orbit, {{"model = \"zonal-gravity\"",
               "",
               {":3:1: system.model: missing", "zonal-gravity, kepler, harmonic-oscillator"}},
              {"model = \"zonal-gravity\"", "modl = \"zonal-gravity\"", {"did you mean model?"}},
              {"zonal-gravity",
               "zonal",
               {":4:9: system.model: unknown value, got \"zonal\"",
                "zonal-gravity, kepler, harmonic-oscillator"}},
              {"mu_km3_s2 = 398600.4415", "", {"system.mu_km3_s2: missing"}},
              {"mu_km3_s2", "mu", {"system.mu: unknown key", "did you mean mu_km3_s2?"}},
              {"398600.4415", "0", {"mu_km3_s2: not positive, got 0, must be a number above 0"}},
              {"398600.4415", "-1.5", {"mu_km3_s2: not positive, got -1.5"}},
              {"398600.4415", "nan", {"mu_km3_s2: not finite, got nan"}},
              {"398600.4415", "inf", {"mu_km3_s2: not finite, got inf"}},
              {"398600.4415", "true", {"mu_km3_s2: wrong type, got true"}},
              {"398600.4415", "2020-01-01", {"mu_km3_s2: wrong type, got a date or time"}},
              {"398600.4415", "\"4\"", {"mu_km3_s2: wrong type, got the string \"4\""}},
              {"398600.4415", "1e400", {":5:13: mu_km3_s2: number out of range, got 1e400"}},
              {"398600.4415", "1e-400", {":5:13: mu_km3_s2: number out of range, got 1e-400"}},
              {"398600.4415", "9223372036854775808", {"mu_km3_s2: integer out of range"}},
              {"radius_km = 6378", "", {"radius_km: missing"}},
              {"radius_km = 6378\nJ2 = 1e-3", "J3 = 0", {"radius_km: missing"}},
              {"radius_km = 6378", "radius_km = -6378", {"radius_km: not positive"}},
              {"J2 = 1e-3", "J2 = 10", {"J2: out of range, got 10, must be a number from -1 to 1"}},
              {"J2 = 1e-3", "J3 = -1.1", {"J3: out of range, got -1.1"}},
              {"J2 = 1e-3", "J20 = 2", {"J20: out of range, got 2, must be a number from -1"}},
              {"J2 = 1e-3", "J1 = 1", {"J1: unknown key, got J1, must be one of J2 to J20"}},
              {"J2 = 1e-3", "J21 = 1", {":7:7: system.J21: unknown key, got J21, must be one"}},
              {"J2 = 1e-3", "\"J2.5\" = 1", {":7:1: system.J2.5: unknown key", "one of: model"}},
              {"J2 = 1e-3", "J2.5 = 1e-6", {"system.J2: wrong type, got a table"}},
              {"J2 = 1e-3", "j4 = 1e-6", {":7:1: system.j4: unknown key, got j4"}},
              {"J2 = 1e-3", "mass_kg = 1", {"mass_kg: the model zonal-gravity has no key mass_kg"}},
              {"zonal-gravity\"\nmu_km3_s2 = 398600.4415\nradius_km = 6378",
               "kepler\"\nmu_km3_s2 = 398600.4415",
               {"the model kepler has no key J2", "mu_km3_s2"}}});
  expect_errors(oscillator,
                {{"[nominal]", "mass_kg = 0\n[nominal]", {"system.mass_kg: not positive"}},
                 {"[nominal]", "stiffness_N_per_m = -1\n[nominal]", {"not positive, got -1"}},
                 {"[nominal]",
                  "J2 = 1\n[nominal]",
                  {"system.J2: the model harmonic-oscillator has no key J2"}}});
}

TEST(SceneErrors, Nominal) {
  const char* cartesian = "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.5, 1]\n";
  const auto elements = [](const std::string& e) {
    return "a_km = 7000\ne = " + e + "\ni_deg = 1\nraan_deg = 0\nargp_deg = 0\nta_deg = 0\n";
  };
  const auto with = [&](const std::string& nominal) { return changed(orbit, cartesian, nominal); };
  ASSERT_NO_THROW(parse_scene(with(elements("0.9")), "x"));
  expect_scene_error(with(""), {":8:1: nominal: no orbit", "position_km", "ta_deg"});
  expect_scene_error(with(cartesian + elements("0")), {"nominal.a_km: both forms", "either"});
  expect_scene_error(with(cartesian + std::string("ta_deg = 1\n")), {"ta_deg: both forms"});
  expect_scene_error(with("velocity_km_s = [0, 7.5, 1]\na_km = 1\n"), {"both forms"});
  expect_scene_error(with("position_km = [7000, 0, 0]\n"), {"velocity_km_s: missing"});
  expect_scene_error(with("velocity_km_s = [7000, 0, 0]\n"), {"position_km: missing"});
  expect_scene_error(with("a_km = 7000\ne = 0\nraan_deg = 0\nargp_deg = 0\nta_deg = 0\n"),
                     {"nominal.i_deg: missing"});
  expect_scene_error(with(elements("1")), {"nominal.e: out of range, got 1", "below 1"});
  expect_scene_error(with(elements("1.5")), {"got 1.5", "position_km and velocity_km_s"});
  expect_scene_error(with(elements("-0.1")), {"e: out of range, got -0.1"});
  expect_scene_error(changed(with(elements("0")), "a_km = 7000", "a_km = -7000"),
                     {"a_km: not positive"});
  expect_scene_error(changed(with(elements("0")), "i_deg = 1", "i_deg = inf"), {"not finite"});
  expect_errors(orbit,
                {{"[7000, 0, 0]", "[0, -0.0, 0]", {"position_km: at the centre of attraction"}},
                 {"[7000, 0, 0]", "[7000, 0]", {"position_km: wrong length, got 2", "array of 3"}},
                 {"[7000, 0, 0]", "[7000, 0, 0, 0]", {"wrong length, got 4"}},
                 {"[7000, 0, 0]", "7000", {"wrong type, got 7000, must be an array of 3"}},
                 {"[7000, 0, 0]",
                  "[7000, \"0\", 0]",
                  {":9:22: nominal.position_km.1: wrong type, got the string \"0\""}},
                 {"[7000, 0, 0]", "[7000, nan, 0]", {"position_km.1: not finite, got nan"}},
                 {"[7000, 0, 0]", "[1e-400, 0, 1]", {":9:16: position_km: number out of range"}},
                 {"[7000, 0, 0]", "[1e300, 0, 0]", {"nominal: out of range in canonical units"}},
                 {"position_km", "postion_km", {"did you mean position_km?"}},
                 {"position_km", "position", {"did you mean position_km?"}},
                 {"position_km", "position_m", {"the model zonal-gravity has no key position_m"}}});
  // A value that is not an angle is refused.
  const auto refuse_angle = [&](const std::string& from, const std::string& to,
                                const std::string& word) {
    expect_scene_error(changed(with(elements("0")), from, to), {word});
  };
  refuse_angle("i_deg = 1", "i_deg = 200",
               "nominal.i_deg: out of range, got 200, must be a number from 0 to 180");
  refuse_angle("i_deg = 1", "i_deg = -1", "nominal.i_deg: out of range, got -1");
  for (const std::string key : {"raan_deg", "argp_deg", "ta_deg"}) {
    refuse_angle(key + " = 0", key + " = 361",
                 "nominal." + key + ": out of range, got 361, must be a number from -360 to 360");
    EXPECT_NO_THROW(parse_scene(changed(with(elements("0")), key + " = 0", key + " = -90"), "x"));
  }
  expect_errors(oscillator,
                {{"[1]", "[1, 2]", {"position_m: wrong length", "array of 1 finite number"}},
                 {"position_m = [1]", "", {"position_m: missing"}},
                 {"position_m", "a_km", {"the model harmonic-oscillator has no key a_km"}}});
}

// A suggestion never leads to other physics: a key that differs in a digit or in a symbol is
// another quantity, and names of other programs are explained in words.
TEST(SceneErrors, NoSuggestionIsOtherPhysics) {
  const char* cartesian = "position_km = [7000, 0, 0]\nvelocity_km_s = [0, 7.5, 1]\n";
  const auto message = [](const std::string& scene) -> std::string {
    try {
      parse_scene(scene, "file.toml");
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  const auto with_element = [&](const std::string& key) {
    return message(
        changed(orbit, cartesian,
                "a_km = 7000\ne = 0.1\ni_deg = 1\nraan_deg = 0\nargp_deg = 0\n" + key + " = 1\n"));
  };
  const std::pair<const char*, const char*> foreign[] = {
      {"mean_anomaly_deg", "must be ma_deg, the mean anomaly"},
      {"E_deg", "must be ea_deg, the eccentric anomaly"},
      {"aol_deg", "must be u_deg, the argument of latitude"},
      {"altitude_km", "must be height_km of a circle, or perigee_height_km with apogee_height_km"},
      {"ra_km", "must be perigee_height_km and apogee_height_km, above radius_km"},
      {"period_min", "must be period_s"}};
  for (const auto& [key, remedy] : foreign) {
    EXPECT_NE(with_element(key).find(remedy), std::string::npos) << with_element(key);
  }
  for (const char* key : {"w_deg", "o_deg", "a_m", "ba_deg", "ta_rad"}) {
    EXPECT_EQ(with_element(key).find("did you mean"), std::string::npos) << with_element(key);
    EXPECT_NE(with_element(key).find("unknown key"), std::string::npos) << with_element(key);
  }
  EXPECT_NE(with_element("agrp_deg").find("did you mean argp_deg?"), std::string::npos);
  const auto with_zonal = [&](const std::string& key) {
    return message(changed(orbit, "J2 = 1e-3", key + " = 1e-3"));
  };
  EXPECT_NE(with_zonal("C20").find("C_n0 is not read, must be J_n = -C_n0"), std::string::npos)
      << with_zonal("C20");
  for (const char* key : {"K2", "j2", "S20", "J22", "j20"}) {
    EXPECT_EQ(with_zonal(key).find("did you mean"), std::string::npos) << with_zonal(key);
  }
}

TEST(SceneErrors, Jet) {
  expect_errors(
      orbit,
      {{"order = 4", "ordre = 4", {":12:1: jet.ordre: unknown key", "did you mean order?"}},
       {"order = 4", "order = 0", {":12:9: jet.order: out of range, got 0", "from 1 to 20"}},
       {"order = 4", "order = -1", {"got -1"}},
       {"order = 4", "order = 4.0", {"wrong type, got 4.0", "integer"}},
       {"order = 4", "order = 4.5", {"wrong type, got 4.5"}},
       {"order = 4", "order = \"4\"", {"got the string \"4\", must be an integer"}},
       {"order = 4",
        "order = 9223372036854775808",
        {":12:9: order: integer out of range, got 9223372036854775808"}},
       // C(105, 6) = 1 609 344 100, times 8 bytes.
       {"order = 4",
        "order = 99",
        {"jet.order", "1609344100", "12.9 GB", "20"},
        ErrorKind::too_large},
       // C(27, 6) = 296 010.
       {"order = 4", "order = 21", {"296010", "2.37 MB"}, ErrorKind::too_large},
       {"order = 4", "order = 4\nvariables = []", {"variables: empty"}},
       {"order = 4", "order = 4\nvariables = \"x\"", {"variables: wrong type"}},
       {"order = 4", "order = 4\nvariables = [1]", {"variables.0: wrong type, got 1"}},
       {"order = 4",
        "order = 4\nvariables = [\"x\", \"q\"]",
        {":13:19: jet.variables.1: unknown variable, got \"q\"", "x, y, z, px, py, pz"}},
       {"order = 4", "order = 4\nvariables = [\"x\", \"x\"]", {"variables.1: duplicate"}},
       {"duration_canonical = 31.4", "", {":11:1: jet: missing", "duration_orbits"}},
       {"duration_canonical", "duration", {"jet.duration: unknown key", "did you mean duration_"}},
       {"duration_canonical",
        "duration_s = 1\nduration_canonical",
        {"more than one", "duration_s, duration_canonical", "exactly one of"}},
       {"31.4", "nan", {"duration_canonical: not finite"}},
       {"31.4", "-inf", {"duration_canonical: not finite"}},
       {"duration_canonical = 31.4", "duration_orbits = 1e308", {"duration_orbits: out of range"}},
       {"duration_canonical = 31.4", "duration_s = 5e-324", {"duration_s: out of range"}}});
  const std::string orbits = changed(orbit, "duration_canonical = 31.4", "duration_orbits = 1");
  expect_scene_error(changed(orbits, "[0, 7.5, 1]", "[0, 17.5, 1]"),
                     {"jet.duration_orbits: no period", "not elliptic", "duration_s"});
  expect_scene_error(changed(orbits, "[0, 7.5, 1]", "[0, 0, 0]"), {"not elliptic"});
  expect_errors(oscillator,
                {{"duration_canonical",
                  "duration_orbits",
                  {"the model harmonic-oscillator has no key duration_orbits"}},
                 {"order = 1", "order = 1\nvariables = [\"x\"]", {"must be one of: q, p"}},
                 // C(101, 2) = 5050 coefficients.
                 {"order = 1", "order = 99", {"5050"}, ErrorKind::too_large}});
}

TEST(SceneErrors, Integrators) {
  const char* size = "tolerance = 1e-14";
  const char* step = "step_canonical = 0.01";
  expect_errors(
      orbit,
      {{"\"gauss8\"", "\"\"", {"integrator.0.label: not usable", "got \"\""}},
       {"\"gauss8\"", "\"..\"", {"label: not usable"}},
       {"\"gauss8\"", "\".a\"", {"label: not usable"}},
       {"\"gauss8\"", "\"a/b\"", {"label: not usable", "A-Z a-z 0-9 . _ -"}},
       {"\"gauss8\"", "\"a b\"", {"label: not usable"}},
       {"\"gauss8\"", "\"summary.json\"", {"label: not usable"}},
       {"\"gauss8\"", "\"a\\u0007\\nb\"", {"got \"a\\x07\\x0ab\""}},
       {"\"other\"",
        "\"gauss8\"",
        {":20:9: integrator.1.label: duplicate", "\"gauss8\"", "file.toml:15:9"}},
       {"method = \"gauss\"",
        "",
        {"method: missing", "newmark, fehlberg78, cvode-adams, cvode-bdf"}},
       {"method = \"gauss\"", "metod = \"gauss\"", {"did you mean method?"}},
       {"\"gauss\"",
        "\"gaus\"",
        {"method: unknown value, got \"gaus\"", "newmark, fehlberg78, cvode-adams, cvode-bdf",
         "did you mean gauss?"}},
       {"stages = 8",
        "stages = 0",
        {"stages: out of range, got 0, must be an integer from 1 to 12"}},
       {"stages = 8", "stages = 1000", {"stages: out of range, got 1000"}},
       {"stages = 8", "stages = 8.0", {"stages: wrong type, got 8.0"}},
       {step,
        "step_s = 1\nstages = 2",
        {"integrator.1.stages: the method fehlberg78 has no key stages", "step_canonical"}},
       {size, "", {":14:1: integrator.0: missing", "step_canonical, step_s, tolerance"}},
       {size, "tolerance = 1e-9\nstep_s = 1", {"more than one", "exactly one of"}},
       {step, "step_s = 1\nstep_canonical = 1", {"more than one"}},
       {size, "tol = 1e-14", {"integrator.0.tol: unknown key"}},
       {size, "tolerance = 0", {"tolerance: out of range, got 0", "from 1e-15 to 0.1"}},
       {size, "tolerance = -1e-3", {"out of range, got -0.001"}},
       {size, "tolerance = 1e-20", {"out of range, got 1e-20"}},
       {size, "tolerance = 1", {"out of range, got 1"}},
       {size, "tolerance = nan", {"not finite"}},
       {step, "step_canonical = 0", {"step_canonical: not positive, got 0"}},
       {step, "step_canonical = -0.01", {"not positive"}},
       {step, "step_s = inf", {"integrator.1.step_s: not finite"}},
       {step, "step_s = 5e-324", {"step_s: out of range"}},
       // 31.4 * 2^-52 = 6.97e-15, and 31.4 / 1e8 = 3.14e-7.
       {step, "step_canonical = 6e-15", {"too small", "at least 6.97e-15", "3.14e-07"}},
       {step,
        "step_canonical = 1e-14",
        {"3.14e+15 steps", "at least 3.14e-07"},
        ErrorKind::too_large},
       {step, "step_canonical = 3.13e-7", {"too many steps"}, ErrorKind::too_large},
       {"method = \"gauss\"\nstages = 8",
        "method = \"stormer\"",
        {"method stormer has no key tolerance"}},
       {"method = \"gauss\"\nstages = 8\ntolerance = 1e-14",
        "method = \"velocity-verlet\"\norder = 5\nstep_s = 1",
        {"integrator.0.order: out of range, got 5, must be 2, 4, 6 or 8"}},
       {"method = \"gauss\"\nstages = 8\ntolerance = 1e-14",
        "method = \"newmark\"\nbeta = 0.6\nstep_s = 1",
        {"integrator.0.beta: out of range, got 0.6, must be a number from 0 to 0.5"}},
       {"stages = 8", "beta = 0.25", {"method gauss has no key beta"}},
       {size, "tolerance = 1e-14\nrequire_relative_error = 0", {"require_relative_error: not pos"}},
       {size,
        "tolerance = 1e-14\nrequire_symplecticity = -1",
        {"require_symplecticity: not pos"}}});
  const std::string cvode = changed(orbit, "method = \"fehlberg78\"", "method = \"cvode-adams\"");
  expect_scene_error(cvode, {"the method cvode-adams has no key step_canonical", "tolerance"});
  expect_scene_error(changed(cvode, step, ""), {"integrator.1.tolerance: missing"});
  const std::string extended =
      changed(changed(cvode, step, "tolerance = 1e-9"), "title", "precision = \"extended\"\ntitle");
  expect_scene_error(extended, {":22:10: integrator.1.method: not available", "double precision"});
  expect_scene_error(changed(changed(extended, size, "tolerance = 1e-31"), "cvode-adams", "gauss"),
                     {"from 1e-30 to 0.1"});
}

TEST(SceneErrors, LargestStepsAndToleranceInRange) {
  for (const char* step : {"3.15e-7", "100"}) {
    EXPECT_NO_THROW(parse_scene(changed(orbit, "0.01", step), "x")) << step;
  }
  for (const char* tolerance : {"1e-15", "0.1"}) {
    EXPECT_NO_THROW(parse_scene(changed(orbit, "1e-14", tolerance), "x")) << tolerance;
  }
}

TEST(SceneErrors, OtherTables) {
  const char* kinds = "[\"F1\"]";
  expect_errors(
      orbit,
      {{"separation_km = 10", "", {":23:1: formation.separation_km: missing"}},
       {"separation_km = 10", "separation_km = 0", {"separation_km: not positive"}},
       {"separation_km = 10", "separation_m = 10", {"has no key separation_m", "separation_km"}},
       {"separation_km = 10", "distance = 10", {"formation.distance: unknown key"}},
       {"kinds = [\"F1\"]", "", {"generating_function.kinds: missing"}},
       {"kinds", "kind", {"did you mean kinds?"}},
       {kinds, "[]", {"kinds: empty"}},
       {kinds, "\"F1\"", {"kinds: wrong type"}},
       {kinds, "[1]", {"kinds.0: wrong type, got 1"}},
       {kinds, "[\"auto\", \"F5\"]", {":26:18: generating_function.kinds.1: unknown kind", "F4"}},
       {kinds, "[\"QQQ-ppp\"]", {"unknown kind"}},
       {kinds, "[\"qq-pp\"]", {"unknown kind, got \"qq-pp\"", "3 letters", "qqq-ppp"}},
       {kinds, "[\"qqqqppp\"]", {"unknown kind"}},
       {kinds, "[\"qqqq-ppp\"]", {"unknown kind"}},
       {kinds, "[\"F1\", \"F1\"]", {"kinds.1: duplicate kind"}},
       {kinds, "[\"F2\", \"qqq-ppp\"]", {"duplicate kind, got \"qqq-ppp\", which is the same as"}},
       {"order = 4",
        "order = 4\nvariables = [\"x\"]",
        {"kinds: not defined", "got x, must be all"}},
       // The orbit is inclined.
       {"order = 4",
        "order = 4\nvariables = [\"x\", \"y\", \"px\", \"py\"]",
        {"kinds: not defined", "equatorial orbit without odd J_n"}},
       {"[reference]", "[reference]\ntolerance = 1e-29", {"tolerance: out of range", "1e-28"}},
       {"[reference]", "[reference]\ntolerance = 1e-15", {"to 1e-16"}},
       {"[reference]", "[reference]\nprecision = 50", {"reference.precision: unknown key"}}});
  const std::string plane =
      changed(changed(orbit, "order = 4", "order = 4\nvariables = [\"x\", \"y\", \"px\", \"py\"]"),
              "[0, 7.5, 1]", "[0, 7.5, 0]");
  ASSERT_NO_THROW(parse_scene(plane, "x"));
  for (const char* odd : {"J3 = 1e-9", "J19 = 1e-9"}) {
    expect_scene_error(changed(plane, "J2 = 1e-3", odd), {"kinds: not defined"});
  }
  ASSERT_NO_THROW(parse_scene(changed(plane, "J2 = 1e-3", "J2 = 1e-3\nJ20 = 1e-9"), "x"));
  expect_scene_error(changed(plane, "[7000, 0, 0]", "[7000, 0, 1e-300]"), {"kinds: not defined"});
  expect_scene_error(changed(plane, kinds, "[\"qqq-ppp\"]"), {"unknown kind", "2 letters"});
  expect_scene_error(oscillator + "[generating_function]\nkinds = [\"qq\"]\n",
                     {"unknown kind", "1 letter q or p", "q-p"});
  expect_scene_error(oscillator + "[formation]\nseparation_km = 1\n",
                     {"the model harmonic-oscillator has no key separation_km", "separation_m"});
}

}  // namespace
}  // namespace hamjet::io
