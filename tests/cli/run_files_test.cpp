#include <cmath>
#include <map>
#include <set>

#include "../../src/text/quantity_text.hpp"
#include "command_test.hpp"

// What `hamjet run` writes: files, columns and keys are those of the documentation of the results.

namespace hamjet::test {
namespace {

const Json& run_of(const Json& summary, const std::string& label) {
  for (const Json& run : summary["runs"]) {
    if (run["label"] == label) return run;
  }
  throw std::runtime_error("no run " + label);
}

using RunFiles = CommandTest;

TEST_F(RunFiles, AreThoseThatTheSceneAsksFor) {
  succeed({"run", "small.toml", "-o", "results"});
  EXPECT_EQ(files(), (std::vector<std::string>{
                         "quick.toml", "results", "results/gauss8",
                         "results/gauss8/generating_function_F1.csv",
                         "results/gauss8/generating_function_F2.csv", "results/gauss8/jet.csv",
                         "results/gauss8/nominal.csv", "results/midpoint",
                         "results/midpoint/generating_function_F1.csv",
                         "results/midpoint/generating_function_F2.csv", "results/midpoint/jet.csv",
                         "results/midpoint/nominal.csv", "results/summary.json", "small.toml"}));
}

TEST_F(RunFiles, JetHasEveryCoefficientOnce) {
  succeed({"run", "quick.toml", "-o", "results"});
  const Table jet = read_table(directory_ / "results/gauss8/jet.csv");
  EXPECT_EQ(jet.header, "component,e_x,e_y,e_z,e_px,e_py,e_pz,coefficient");
  // C(6 + 2, 2) = 28 monomials up to degree 2 in 6 variables, for each of 6 components.
  EXPECT_EQ(jet.rows.size(), 6U * 28U);
  std::set<std::vector<std::string>> monomials;
  for (const auto& row : jet.rows) {
    ASSERT_EQ(row.size(), 8U);
    EXPECT_LE(degree(row), 2);
    EXPECT_TRUE(monomials.emplace(row.begin(), row.end() - 1).second);
  }
}

TEST_F(RunFiles, RowOfDegreeZeroIsTheFinalNominal) {
  succeed({"run", "quick.toml", "-o", "results"});
  const Json summary = read_json(directory_ / "results/summary.json");
  for (const std::string label : {"gauss8", "midpoint"}) {
    std::vector<double> state;
    for (const auto& row : read_table(directory_ / "results" / label / "jet.csv").rows) {
      if (degree(row) == 0) state.push_back(std::stod(row.back()));
    }
    // 17 digits bring back the same binary64 number.
    EXPECT_EQ(state, run_of(summary, label)["nominal_final"].get<std::vector<double>>());
    const Table nominal = read_table(directory_ / "results" / label / "nominal.csv");
    ASSERT_EQ(nominal.header, "time_canonical,time_s,x,y,z,px,py,pz,energy_error");
    EXPECT_EQ(std::stod(nominal.rows.back()[0]), 1);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_EQ(std::stod(nominal.rows.front()[2 + i]), summary["nominal_initial"][i]);
      EXPECT_EQ(std::stod(nominal.rows.back()[2 + i]), state[i]);
    }
  }
}

TEST_F(RunFiles, GeneratingFunctionIsNamedByItsVariables) {
  succeed({"run", "quick.toml", "-o", "results"});
  const auto columns = [&](const std::string& kind) {
    return read_table(directory_ / "results/gauss8" / ("generating_function_" + kind + ".csv"));
  };
  EXPECT_EQ(columns("F1").header, "e_x,e_y,e_z,e_x0,e_y0,e_z0,coefficient");
  EXPECT_EQ(columns("F2").header, "e_x,e_y,e_z,e_px0,e_py0,e_pz0,coefficient");
  // Degrees 2 and 3 in 6 variables: C(7, 2) + C(8, 3).
  EXPECT_EQ(columns("F1").rows.size(), 21U + 56U);
}

TEST_F(RunFiles, OneDegreeOfFreedomHasQAndP) {
  const std::string scene =
      std::string(HAMJET_SOURCE_DIR) + "/data/scenes/paper/harmonic-oscillator.toml";
  succeed({"run", scene, "-o", "results", "--set",
           "integrator=[{label=\"gauss8\", method=\"gauss\", tolerance=1e-14}]"});
  const Table jet = read_table(directory_ / "results/gauss8/jet.csv");
  EXPECT_EQ(jet.header, "component,e_q,e_p,coefficient");
  // Order 2 in 2 variables: 6 monomials for each of q and p.
  ASSERT_EQ(jet.rows.size(), 12U);
  // The closed form of the scene at t = 100: q = q0 cos t + p0 sin t, p = p0 cos t - q0 sin t,
  // about the nominal that starts at (1, 0). Round-off grows with the 100 units of time.
  const double c = std::cos(100.0), s = std::sin(100.0);
  const std::map<std::string, double> expected = {{"q00", c},  {"q10", c},  {"q01", s},
                                                  {"p00", -s}, {"p10", -s}, {"p01", c}};
  for (const auto& row : jet.rows) {
    const auto entry = expected.find(row[0] + row[1] + row[2]);
    EXPECT_NEAR(std::stod(row[3]), entry == expected.end() ? 0 : entry->second, 1e-12) << row[0];
  }
}

TEST_F(RunFiles, SummaryHasTheDocumentedKeys) {
  succeed({"run", "small.toml", "-o", "results"});
  const Json summary = read_json(directory_ / "results/summary.json");
  EXPECT_EQ(summary["scene"], "small");
  EXPECT_TRUE(summary["version"].is_string());
  // Canonical units: the distance from the centre at a true anomaly of 30 degrees,
  // a (1 - e^2) / (1 + e cos 30), and the time that makes mu = 1.
  const double length = 10000 * (1 - 0.01) / (1 + 0.1 * std::sqrt(0.75));
  EXPECT_NEAR(summary["units"]["length_km"], length, 1e-11 * length);
  const double time = std::sqrt(length * length * length / 398600.4415);
  EXPECT_NEAR(summary["units"]["time_s"], time, 1e-11 * time);
  EXPECT_EQ(summary["exit_code"], 0);
  ASSERT_EQ(summary["runs"].size(), 2U);
  EXPECT_EQ(summary["runs"][0]["label"], "gauss8");
  EXPECT_EQ(summary["runs"][1]["label"], "midpoint");
  for (const Json& run : summary["runs"]) {
    EXPECT_EQ(run["method"], "gauss");
    for (const char* key : {"stages", "steps", "rejected_steps", "vector_field_evaluations"}) {
      EXPECT_TRUE(run[key].is_number_integer()) << key;
    }
    EXPECT_TRUE(run["wall_seconds"].is_number());
    EXPECT_GE(run["wall_seconds"], 0);
    EXPECT_TRUE(run["energy_error"].is_number());
    ASSERT_EQ(run["nominal_final"].size(), 6U);
    ASSERT_EQ(run["exactness"].size(), 2U);
    EXPECT_EQ(run["exactness"][0]["kind"], "F1");
    EXPECT_EQ(run["exactness"][1]["kind"], "F2");
    for (const Json& entry : run["exactness"]) {
      EXPECT_GE(entry["condition"], 1);
      ASSERT_EQ(entry["by_degree"].size(), 2U);  // degrees 0 to order - 1
      for (int d = 0; d < 2; ++d) {
        EXPECT_EQ(entry["by_degree"][d]["degree"], d);
        for (const char* key : {"absolute", "scaled", "at_formation_scale", "floor"}) {
          EXPECT_TRUE(entry["by_degree"][d][key].is_number()) << key;
        }
      }
    }
    ASSERT_EQ(run["symplecticity_by_degree"].size(), 2U);
    for (int d = 0; d < 2; ++d) {
      EXPECT_EQ(run["symplecticity_by_degree"][d]["degree"], d);
      EXPECT_TRUE(run["symplecticity_by_degree"][d]["absolute"].is_number());
      EXPECT_TRUE(run["symplecticity_by_degree"][d]["scaled"].is_number());
    }
    ASSERT_EQ(run["error_by_degree"].size(), 3U);  // degrees 0 to order
    for (int d = 0; d < 3; ++d) {
      EXPECT_EQ(run["error_by_degree"][d]["degree"], d);
      EXPECT_TRUE(run["error_by_degree"][d]["relative"].is_number());
      EXPECT_EQ(run["error_estimate_by_degree"][d]["degree"], d);
      // The factor by which the estimate of a single scene may be wrong; the true error comes from
      // the reference.
      EXPECT_GE(100 * run["error_estimate_by_degree"][d]["relative"].get<double>(),
                run["error_by_degree"][d]["relative"].get<double>());
    }
  }
  EXPECT_EQ(summary["runs"][1]["steps"], 100);  // a duration of 1 in steps of 0.01
}

TEST_F(RunFiles, AWarningIsInTheSummaryAndOnStandardErrorWhereThereIsNoTable) {
  // Eight steps of Verlet in a revolution at e = 0.9 do not resolve the orbit, and fixed steps
  // promise nothing.
  write("lost.toml",
        "system = { model = \"kepler\", mu_km3_s2 = 398600.4415 }\n"
        "nominal = { a_km = 70000, e = 0.9, i_deg = 0, raan_deg = 0, argp_deg = 0, ta_deg = 180 }\n"
        "jet = { order = 1, duration_orbits = 2 }\n"
        "integrator = [{ label = \"coarse\", method = \"velocity-verlet\", step_s = 23000 }]\n"
        "checks.energy = false\n");
  for (const char* quiet : {"-q", "--json"}) {
    const CommandResult result = hamjet({"run", "lost.toml", "-o", "lost", quiet});
    EXPECT_NE(in_one_line(result.err).find("hamjet: warning: coarse: not one digit of degree"),
              std::string::npos)
        << result.err;
    const Json run = read_json(directory_ / "lost/summary.json")["runs"][0];
    ASSERT_EQ(run["warnings"].size(), 1U);
    EXPECT_NE(run["warnings"][0].get<std::string>().find("not one digit"), std::string::npos);
  }
}

// The table for the terminal says nothing that is not in the file, and says times and lengths as
// all other tables and pages do.
TEST_F(RunFiles, TheTablesTimesAndPositionErrorsAreThoseOfTheSummary) {
  const CommandResult result = succeed({"run", "small.toml", "-o", "results", "--verbose"});
  const Json summary = read_json(directory_ / "results/summary.json");
  for (const Json& run : summary["runs"]) {
    std::istringstream lines(result.out);
    std::string line, row;  // the tables, one below the other
    while (std::getline(lines, line)) {
      if (line.starts_with(run["label"].get<std::string>() + " ")) row += line + "  ";
    }
    for (const std::string& text : {duration_text(run["wall_seconds"].get<double>()),
                                    length_text(run["position_error_m"].get<double>())}) {
      EXPECT_NE(row.find("  " + text + "  "), std::string::npos) << row << "\nlacks " << text;
    }
  }
  // Distance of the final positions, the nominals' digits being canonical.
  const Json& midpoint = summary["runs"][1];
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double difference = midpoint["nominal_final"][i].get<double>() -
                              summary["reference"]["nominal_final"][i].get<double>();
    square += difference * difference;
  }
  const double metres = std::sqrt(square) * summary["units"]["length_km"].get<double>() * 1000;
  EXPECT_NEAR(midpoint["position_error_m"].get<double>(), metres, 1e-6 * metres);
}

TEST_F(RunFiles, WithoutAReferenceErrorsAndFloorsAreNull) {
  succeed({"run", "quick.toml", "-o", "results"});
  const Json summary = read_json(directory_ / "results/summary.json");
  EXPECT_TRUE(summary["reference"].is_null());
  for (const Json& run : summary["runs"]) {
    EXPECT_TRUE(run["error_by_degree"].is_null());
    EXPECT_EQ(run["error_estimate_by_degree"].size(), 3U);
    for (const Json& entry : run["exactness"]) {
      for (const Json& row : entry["by_degree"]) {
        EXPECT_TRUE(row["floor"].is_null());
        EXPECT_TRUE(row["absolute"].is_number());
      }
    }
  }
}

TEST_F(RunFiles, WithoutAFormationThereIsNoResidualAtItsScale) {
  write("scene.toml", changed(quick_scene(), "[formation]\nseparation_km = 1\n", ""));
  succeed({"run", "scene.toml", "-o", "results"});
  const Json run = read_json(directory_ / "results/summary.json")["runs"][0];
  EXPECT_TRUE(run["exactness"][0]["by_degree"][0]["at_formation_scale"].is_null());
}

TEST_F(RunFiles, WithoutKindsNothingIsInverted) {
  write("scene.toml",
        changed(quick_scene(), "[generating_function]\nkinds = [\"F1\", \"F2\"]\n", ""));
  succeed({"run", "scene.toml", "-o", "results"});
  const Json summary = read_json(directory_ / "results/summary.json");
  for (const Json& run : summary["runs"]) {
    EXPECT_TRUE(run["exactness"].is_null());
    EXPECT_EQ(run["symplecticity_by_degree"].size(), 2U);
  }
  for (const std::string& file : files()) {
    EXPECT_EQ(file.find("generating_function"), std::string::npos) << file;
  }
}

TEST_F(RunFiles, AutoMayTakeAKindThatTheSceneNamesToo) {
  // The kind that `auto` takes, asked for by its letters beside it, gives the same file.
  const std::string best = [&] {
    succeed({"run", "quick.toml", "-o", "first", "--set", "generating_function.kinds=[\"auto\"]"});
    const Json summary = read_json(directory_ / "first/summary.json");
    return run_of(summary, "gauss8")["exactness"][0]["kind"].get<std::string>();
  }();
  succeed({"run", "quick.toml", "-o", "second", "--set",
           "generating_function.kinds=[\"" + best + "\", \"auto\"]"});
  const std::string file = "gauss8/generating_function_" + best + ".csv";
  EXPECT_EQ(content(directory_ / "first" / file), content(directory_ / "second" / file));
}

}  // namespace
}  // namespace hamjet::test
