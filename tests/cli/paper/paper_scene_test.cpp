#include <cmath>
#include <map>

#include "../command_test.hpp"
#include "support/magnitude.hpp"
#include "support/reference_data.hpp"

// The paper's Earth orbit as shipped, in full. What is expected is the paper's claim with its
// missing half: symplectic integrators leave no exactness residual, and that says nothing about
// their error.

namespace hamjet::test {
namespace {

using PaperScene = CommandTest;

bool has_cvode(const std::string& integrators) {
  return integrators.find("NOT BUILT") == std::string::npos;
}

double residual(const Json& run, int degree) {
  const Json& entry = run["exactness"][0];
  EXPECT_EQ(entry["kind"], "F1");
  EXPECT_EQ(entry["by_degree"][degree]["degree"], degree);
  return entry["by_degree"][degree]["absolute"];
}

double largest_error(const Json& run) {
  double largest = 0;
  for (const Json& entry : run["error_by_degree"]) {
    largest = larger(largest, entry["relative"].get<double>());
  }
  return largest;
}

double position_error(const Json& run, const Json& reference) {
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    square += std::pow(run["nominal_final"][i].get<double>() - reference[i].get<double>(), 2);
  }
  return std::sqrt(square);
}

TEST_F(PaperScene, ShowsExactnessAndErrorSideBySide) {
  const std::string scene = std::string(HAMJET_SOURCE_DIR) + "/data/scenes/paper/earth-orbit.toml";
  std::vector<std::string> arguments = {"run", scene, "-o", "results", "-q"};
  const bool with_cvode = has_cvode(succeed({"list", "integrators"}).out);
  if (!with_cvode) {
    arguments.emplace_back("--set");
    arguments.emplace_back(
        "integrator=[{label=\"midpoint\", method=\"gauss\", stages=1, step_canonical=0.01},"
        "{label=\"gauss-order4\", method=\"gauss\", stages=2, step_canonical=0.01},"
        "{label=\"fehlberg78\", method=\"fehlberg78\", tolerance=1e-12},"
        "{label=\"gauss8\", method=\"gauss\", stages=8, tolerance=1e-13}]");
  }
  options_.limit = std::chrono::seconds(800);  // sanitizers make it slow
  succeed(arguments);
  const Json summary = read_json(directory_ / "results/summary.json");
  std::map<std::string, Json> runs;
  for (const Json& run : summary["runs"]) runs[run["label"]] = run;

  // Bounds on the exactness of the symplectic runs: the purpose of the scene.
  double symplectic = 0;
  for (const char* label : {"midpoint", "gauss-order4", "gauss8"}) {
    EXPECT_LE(residual(runs.at(label), 0), 1e-11) << label;
    EXPECT_LE(residual(runs.at(label), 1), 1e-10) << label;
    symplectic = std::max(symplectic, residual(runs.at(label), 0));
  }
  if (with_cvode) {
    for (const char* label : {"cvode-adams-1e-6", "cvode-bdf-1e-6"}) {
      EXPECT_GE(residual(runs.at(label), 0), 1e3 * symplectic) << label;
    }
  }

  // The midpoint run with steps of 0.01 is wrong by 1.8e-3 of 7000 km, 12.5 km, to the digits
  // given.
  const Json& reference = summary["reference"]["nominal_final"];
  const double error = position_error(runs.at("midpoint"), reference);
  EXPECT_NEAR(error, 1.8e-3, 5e-5);
  EXPECT_NEAR(error * summary["units"]["length_km"].get<double>(), 12.5, 5e-2);
  EXPECT_LE(largest_error(runs.at("gauss8")), 2e-12);
  EXPECT_EQ(runs.at("gauss8")["error_by_degree"].size(), 5U);

  // Digits of the reference data, whose start and duration are the same binary64 numbers.
  const ReferenceOrbit& orbit = paper_orbit();
  EXPECT_EQ(summary["nominal_initial"].get<std::vector<double>>(), orbit.start);
  EXPECT_EQ(summary["duration_canonical"], orbit.duration);
  for (std::size_t i = 0; i < 6; ++i) {
    const double digits = static_cast<double>(orbit.state[i]);
    EXPECT_NEAR(runs.at("gauss8")["nominal_final"][i], digits, 1e-12) << i;
    EXPECT_NEAR(reference[i], digits, 1e-16) << i;  // rounded to binary64
  }
}

}  // namespace
}  // namespace hamjet::test
