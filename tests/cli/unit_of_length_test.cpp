#include <cmath>

#include "eval_command_test.hpp"

// What the program says of its errors must not depend on the unit of length that a scene asks for:
// the expected values are those of the default unit.

namespace hamjet::test {
namespace {

/// The unit of momentum is rounded to a power of two, so that degree d may differ by this factor.
double allowed_factor(int degree) { return std::pow(2, 0.5 * (degree + 1)) * 1.01; }

void expect_near(double value, double wanted, double factor) {
  EXPECT_LE(value, wanted * factor);
  EXPECT_GE(value, wanted / factor);
}

class UnitOfLength : public EvalTest {
 protected:
  Json run_in(const std::string& name, const std::string& units) const {
    std::string scene = changed(small_scene, "order = 2", "order = 3");
    scene = changed(scene, "[generating_function]\nkinds = [\"F1\", \"F2\"]\n", "");
    scene = changed(scene, "duration_canonical = 1", "duration_s = 1500");
    scene = changed(scene, "step_canonical = 0.01", "step_s = 15");
    scene = changed(scene, "stages = 8\ntolerance = 1e-13", "stages = 2\ntolerance = 1e-7");
    store(name, scene + units);
    return read_json(directory_ / name / "summary.json");
  }
};

TEST_F(UnitOfLength, ChangesNoErrorNoEstimateAndNoLimit) {
  const Json usual = run_in("usual", "")["runs"][0];
  for (const char* length_km : {"0.001", "1", "1e8"}) {
    SCOPED_TRACE(length_km);
    const std::string name = "unit" + std::string(length_km);
    const Json other = run_in(name, "[units]\nlength_km = " + std::string(length_km) + "\n");
    const Json& run = other["runs"][0];
    EXPECT_EQ(run["steps"], usual["steps"]);
    for (const char* key : {"error_by_degree", "error_estimate_by_degree"}) {
      // Degree 0 is a position in one unit or another, to rounding.
      for (int d = 1; d <= 3; ++d) {
        SCOPED_TRACE(key + std::to_string(d));
        expect_near(run[key][d]["relative"], usual[key][d]["relative"], allowed_factor(d));
      }
    }
    const auto limit = [](const Json& checks) {
      for (const Json& check : checks) {
        if (check["name"] == "error-estimate") return check["limit"].get<double>();
      }
      return 0.0;
    };
    expect_near(limit(run["checks"]), limit(usual["checks"]), 1.01);
  }
}

TEST_F(UnitOfLength, ChangesNoMissThatEvalEstimates) {
  run_in("usual", "");
  const auto miss = [&](const std::string& directory) {
    const Json result = eval_json({directory, "--deviation", "10,-2000,30,0.1,-0.2,0.3"});
    return result["rows"][0]["miss_estimate_m"].get<double>();
  };
  const double wanted = miss("usual");
  for (const char* length_km : {"0.001", "1", "1e8"}) {
    SCOPED_TRACE(length_km);
    const std::string name = "unit" + std::string(length_km);
    run_in(name, "[units]\nlength_km = " + std::string(length_km) + "\n");
    expect_near(miss(name), wanted, 4);
  }
}

}  // namespace
}  // namespace hamjet::test
