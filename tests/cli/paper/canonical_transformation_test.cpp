#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <vector>

#include "../command_test.hpp"

// The study of the paper's discrete canonical transformations, as a user runs it.

namespace hamjet::test {
namespace {

const std::string transformed_scene = R"(schema = 1
study = "canonical-transformation"
title = "double well"
)" + double_well_tables + R"([canonical_transformation]
steps_canonical = [0.1, 0.2]
duration_canonical = 20
rotation_cosine = 0.99
)";

constexpr const char* orbit_scene = R"(schema = 1
study = "canonical-transformation"
title = "orbit"
[system]
model = "kepler"
mu_km3_s2 = 398600.4415
[nominal]
position_km = [7000, 0, 0]
velocity_km_s = [0, 7.5, 1]
[canonical_transformation]
steps_canonical = [0.05]
duration_canonical = 6
)";

/// How far two runs of the midpoint scheme on the double well may be apart after each step, by
/// rounding alone: the sum over all steps so far of what a rounding in one becomes by the steps
/// after it, whose matrices are (I - h/2 A)^-1 (I + h/2 A) with A = [0 1; 1 - 6 q^2 0] at the
/// midpoint. Each run rounds a number of size 1 or less at most 16 times in a step.
std::vector<double> rounding_bounds(const Table& trajectory, double step) {
  constexpr double rounding = 2 * 16 * 0x1p-53;
  std::vector<Eigen::Matrix2d> since;  // the matrix from each earlier step until now
  std::vector<double> bounds = {rounding};
  for (std::size_t k = 0; k + 1 < trajectory.rows.size(); ++k) {
    const double q = (std::stod(trajectory.rows[k][2]) + std::stod(trajectory.rows[k + 1][2])) / 2;
    Eigen::Matrix2d half;
    half << 0, step / 2, (1 - 6 * q * q) * step / 2, 0;
    const Eigen::Matrix2d identity = Eigen::Matrix2d::Identity();
    since.push_back(identity);
    double sum = 1;
    for (Eigen::Matrix2d& matrix : since) {
      matrix = (identity - half).inverse() * (identity + half) * matrix;
      sum += matrix.norm();
    }
    bounds.push_back(rounding * sum);
  }
  return bounds;
}

class CanonicalTransformationCommand : public CommandTest {
 protected:
  /// The scene with one text replaced must be refused.
  void expect_scene_error(const std::string& text, const std::vector<std::string>& words,
                          int exit_code = 3) {
    write("bad.toml", text);
    expect_error({"run", "bad.toml", "-o", "bad"}, exit_code, words);
  }
};

TEST_F(CanonicalTransformationCommand, GoodRun) {
  write("well.toml", transformed_scene);
  const CommandResult result = succeed({"run", "well.toml", "-o", "results"});
  EXPECT_NE(result.out.find("crosses"), std::string::npos);
  const Json summary = read_json(directory_ / "results/summary.json");
  EXPECT_EQ(summary["study"], "canonical-transformation");
  EXPECT_EQ(summary["scene"], "well");
  EXPECT_EQ(summary["model"], "double-well");
  EXPECT_EQ(summary["exit_code"], 0);
  EXPECT_NEAR(summary["matrix"][0][0].get<double>(), 0.99, 1e-16);
  ASSERT_EQ(summary["runs"].size(), 2U);
  for (const Json& run : summary["runs"]) {
    EXPECT_TRUE(run["error"].is_null());
    EXPECT_GT(run["largest_energy_error"], 1e-4);
    EXPECT_LE(run["hamilton_jacobi"]["largest_residual"], 2e-15);
    // The extrema of the summary are those of the trajectory, which is stored in full here.
    const Table table = read_table(directory_ / "results" / run["trajectory"].get<std::string>());
    EXPECT_EQ(table.header,
              "step,time_canonical,q,p,transformed_q,transformed_p,energy_error,"
              "transformed_energy_error,difference");
    ASSERT_EQ(table.rows.size(), run["steps"].get<std::size_t>() + 1);
    double largest = 0;
    double largest_difference = 0;
    const std::vector<double> bounds = rounding_bounds(table, run["step_canonical"]);
    for (std::size_t k = 0; k < table.rows.size(); ++k) {
      const auto& row = table.rows[k];
      const double q = std::stod(row[2]);
      const double p = std::stod(row[3]);
      const double energy = p * p / 2 + (q * q * q * q - q * q) / 2;
      EXPECT_NEAR(std::stod(row[6]), energy - 0.00125, 1e-15);
      // A rotation keeps the distance from the origin.
      EXPECT_NEAR(std::hypot(q, p), std::hypot(std::stod(row[4]), std::stod(row[5])), bounds[k]);
      // The gradient of H, (2 q^3 - q, p), times the difference of the states.
      const double slope = std::hypot(2 * q * q * q - q, p);
      EXPECT_LE(std::abs(std::stod(row[8])), 1e-15 + slope * bounds[k]);
      largest_difference = std::max(largest_difference, std::abs(std::stod(row[8])));
      largest = std::max(largest, std::abs(std::stod(row[6])));
    }
    EXPECT_EQ(run["largest_energy_error"].get<double>(), largest);
    EXPECT_EQ(run["largest_energy_difference"].get<double>(), largest_difference);
  }
  EXPECT_EQ(summary["runs"][0]["crosses_barrier"], true);
  EXPECT_EQ(summary["runs"][1]["crosses_barrier"], false);
  const std::string figure = content(directory_ / "results/figure.svg");
  for (const char* place : {"<svg y=\"40\" width=\"900\" height=\"500\">", "<svg y=\"1660\"",
                            "aria-label=\"Trajectory in the transformed coordinates\""}) {
    EXPECT_NE(figure.find(place), std::string::npos) << place;
  }
  EXPECT_EQ(succeed({"run", "well.toml", "-o", "results", "--json"}).out,
            content(directory_ / "results/summary.json"));

  // The results of a run with other steps are not mixed with the new ones.
  succeed({"run", "well.toml", "-o", "results", "-q", "--set",
           "canonical_transformation.steps_canonical=[0.05]"});
  EXPECT_TRUE(std::filesystem::exists(directory_ / "results/trajectory_step_0.05.csv"));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "results/trajectory_step_0.1.csv"));
}

// The same rotation as a matrix, and by its angle: cos 0.5 and sin 0.5 to 17 digits.
TEST_F(CanonicalTransformationCommand, FormsOfATransformationAgree) {
  const std::string angle =
      changed(transformed_scene, "rotation_cosine = 0.99", "rotation_angle_rad = 0.5");
  const std::string matrix = changed(transformed_scene, "rotation_cosine = 0.99",
                                     "matrix = [[0.87758256189037271, -0.47942553860420300],"
                                     "[0.47942553860420300, 0.87758256189037271]]\n"
                                     "shift = [0, 0]");
  write("angle.toml", angle);
  write("matrix.toml", matrix);
  succeed({"run", "angle.toml", "-o", "angle", "-q"});
  succeed({"run", "matrix.toml", "-o", "matrix", "-q"});
  const Table a = read_table(directory_ / "angle/trajectory_step_0.1.csv");
  const Table b = read_table(directory_ / "matrix/trajectory_step_0.1.csv");
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    EXPECT_NEAR(std::stod(a.rows[i][4]), std::stod(b.rows[i][4]), 1e-12);
  }
}

// An orbit in three dimensions: the first and the second pair (q, p) turn against each other, which
// is the exchange of x with y for positions and momenta alike, and B_k moves the origin.
TEST_F(CanonicalTransformationCommand, OrbitInThreeDimensions) {
  write("orbit.toml", std::string(orbit_scene) +
                          "matrix = [[0.6,-0.8,0,0,0,0],[0.8,0.6,0,0,0,0],[0,0,1,0,0,0],"
                          "[0,0,0,0.6,-0.8,0],[0,0,0,0.8,0.6,0],[0,0,0,0,0,1]]\n"
                          "shift = [0.1, 0, 0, 0, -0.2, 0]\nrequire_invariance = 1e-12\n");
  succeed({"run", "orbit.toml", "-o", "results", "-q"});
  const Json run = read_json(directory_ / "results/summary.json")["runs"][0];
  EXPECT_GT(run["largest_energy_error"], 1e-6);
  EXPECT_LE(run["largest_energy_difference"], 1e-13);
  EXPECT_TRUE(run["crosses_barrier"].is_null());
  // dQ/dp vanishes at every k.
  EXPECT_EQ(run["hamilton_jacobi"]["first_kind"]["steps_where_it_exists"], 0);
  EXPECT_TRUE(run["hamilton_jacobi"]["first_kind"]["largest_residual"].is_null());
  EXPECT_LE(run["hamilton_jacobi"]["largest_residual"], 1e-13);
}

TEST_F(CanonicalTransformationCommand, MatrixThatIsNotSymplectic) {
  const auto with_matrix = [](const std::string& matrix) {
    return changed(transformed_scene, "rotation_cosine = 0.99", "matrix = " + matrix);
  };
  expect_scene_error(with_matrix("[[1, 0], [0, -1]]"),
                     {"bad.toml:12:10: canonical_transformation.matrix: not symplectic",
                      "2 as the largest entry of A J A^T - J", "must be at most 1.1e-13"});
  // The cosine and sine of the paper to three digits: 0.99^2 + 0.141^2 = 0.999981.
  expect_scene_error(with_matrix("[[0.99, -0.141], [0.141, 0.99]]"),
                     {"not symplectic", "1.9e-05 as the largest entry"});
  expect_scene_error(with_matrix("[[1, 0, 0], [0, 1, 0]]"),
                     {"matrix.0: wrong size, got 3 elements", "2 arrays of 2 finite numbers"});
  expect_scene_error(with_matrix("[[1, 0]]"), {"matrix: wrong size, got 1 row,"});
  expect_scene_error(with_matrix("[1, 0]"), {"matrix.0: wrong size, got 1, the matrix must be"});
  expect_scene_error(with_matrix("[[1, 0], [0, \"1\"]]"),
                     {"matrix.1.1: wrong type, got the string \"1\""});
  expect_scene_error(with_matrix("[[1, inf], [0, 1]]"), {"matrix.0.1: not finite"});
  expect_scene_error(with_matrix("3"), {"matrix: wrong type, got 3"});
  expect_scene_error(with_matrix("[[1, 0], [0, 1]]\nshift = [1]"),
                     {"shift: wrong length, got 1 element,", "2 finite numbers"});
  expect_scene_error(std::string(orbit_scene) + "matrix = [[1, 0], [0, 1]]\n",
                     {"matrix: wrong size, got 2 rows", "6 arrays of 6"});
}

TEST_F(CanonicalTransformationCommand, OtherBadInput) {
  const auto change = [&](const std::string& from, const std::string& to,
                          const std::vector<std::string>& words, int exit_code = 3) {
    expect_scene_error(changed(transformed_scene, from, to), words, exit_code);
  };
  change("rotation_cosine = 0.99", "", {"canonical_transformation: missing, got none of a choice"});
  change("rotation_cosine = 0.99", "rotation_cosine = 0.99\nrotation_angle_rad = 1",
         {"more than one key of a choice"});
  change("rotation_cosine = 0.99", "rotation_cosine = 1.01", {"rotation_cosine: out of range"});
  change("rotation_cosine = 0.99", "rotation_cosine = 0.99\nshift = [0, 0]",
         {"shift: without a matrix"});
  change("rotation_cosine", "rotation_cos", {"unknown key", "did you mean rotation_cosine?"});
  change("[0.1, 0.2]", "[]", {"bad.toml:10:19: canonical_transformation.steps_canonical: empty"});
  change("[0.1, 0.2]", "[0.1, 0]", {"steps_canonical.1: not positive, got 0"});
  change("[0.1, 0.2]", "[0.1, -0.2]", {"steps_canonical.1: not positive, got -0.2"});
  change("[0.1, 0.2]", "[0.1, 0.1]", {"steps_canonical.1: duplicate step size"});
  change("[0.1, 0.2]", "[1,2,3,4,5,6,7,8,9]", {"too many step sizes, got 9, must be at most 8"});
  change("[0.1, 0.2]", "[1e-6]", {"steps_canonical: too many steps, got 2e+07"}, 6);
  change("[0.1, 0.2]", "[1e-300]", {"steps_canonical: too many steps"}, 6);
  change("duration_canonical = 20", "duration_canonical = 0", {"not positive, got 0"});
  change("duration_canonical = 20", "", {"duration_canonical: missing"});
  change("rotation_cosine = 0.99", "rotation_cosine = 0.99\nrequire_invariance = 0",
         {"require_invariance: not positive"});
  change("[canonical_transformation]", "[jet]", {"jet: unknown key"});
  change("model = \"double-well\"", "model = \"double-well\"\nmass_kg = 1",
         {"the model double-well has no key mass_kg"});
  change("position_m = [1]", "position_m = [1, 2]", {"position_m: wrong length"});
  change("canonical-transformation\"", "canonical\"",
         {"study: unknown value", "flow-jet, canonical-transformation"});
  expect_scene_error(
      std::string(orbit_scene) + "rotation_cosine = 0.99\n",
      {"rotation_cosine: a rotation of the plane (q, p), got a model with 3 degrees"});
  write("well.toml", transformed_scene);
  expect_error({"compare", "well.toml", "-o", "bad"}, 3, {"study: has no flow jet"});
  EXPECT_NE(succeed({"check", "well.toml"}).out.find("the scene is good"), std::string::npos);
}

TEST_F(CanonicalTransformationCommand, CheckThatFails) {
  write("well.toml", changed(transformed_scene, "rotation_cosine = 0.99",
                             "rotation_cosine = 0.99\nrequire_invariance = 1e-19"));
  const CommandResult result = hamjet({"run", "well.toml", "-o", "results"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("the energy errors differ by"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("require_invariance is 1e-19"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("CHECK FAILED"), std::string::npos);
  const Json summary = read_json(directory_ / "results/summary.json");
  EXPECT_EQ(summary["exit_code"], 1);
  EXPECT_EQ(summary["require_invariance"], 1e-19);
}

// diag(2, 1/2) to the power k has the condition 4^k; on the barrier a step of 2.5 is too long.
TEST_F(CanonicalTransformationCommand, RunsThatStop) {
  write("growing.toml",
        changed(transformed_scene, "rotation_cosine = 0.99", "matrix = [[2, 0], [0, 0.5]]"));
  CommandResult result = hamjet({"run", "growing.toml", "-o", "growing"});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("the condition of A_20"), std::string::npos) << result.err;
  Json summary = read_json(directory_ / "growing/summary.json");
  EXPECT_NE(summary["runs"][0]["error"].get<std::string>().find("condition"), std::string::npos);
  write("long.toml", changed(changed(transformed_scene, "[0.1, 0.2]", "[2.5]"), "[1]", "[0.01]"));
  result = hamjet({"run", "long.toml", "-o", "long"});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("midpoint: a step of 2.5 has no solution"), std::string::npos)
      << result.err;
  EXPECT_NE(result.out.find("FAILED"), std::string::npos);
}

}  // namespace
}  // namespace hamjet::test
