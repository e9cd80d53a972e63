#include "hamjet/dynamics/system_text.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "hamjet/dynamics/zonal_gravity.hpp"
#include "support/errors.hpp"
#include "support/flow.hpp"

namespace hamjet {
namespace {

/// Zonal gravity to J4 as a user writes it.
SystemText written_zonals() {
  SystemText text;
  text.coordinates = {"x", "y", "z"};
  text.momenta = {"px", "py", "pz"};
  text.parameters = {{"R", "0.9"}, {"J2", "1e-3"}, {"J3", "-2e-6"}, {"J4", "-1.5e-6"}};
  text.definitions = {{"r", "sqrt(x^2 + y^2 + z^2)"},
                      {"s", "z/r"},
                      {"P2", "(3*s^2 - 1)/2"},
                      {"P3", "(5*s^3 - 3*s)/2"},
                      {"P4", "(35*s^4 - 30*s^2 + 3)/8"}};
  text.hamiltonian =
      "(px^2 + py^2 + pz^2)/2 - 1/r*(1 - J2*(R/r)^2*P2 - J3*(R/r)^3*P3 - J4*(R/r)^4*P4)";
  return text;
}

TEST(SystemText, HasTheFieldOfTheSystemByName) {
  const DynamicalSystem written = make_system("written", written_zonals());
  const DynamicalSystem named = zonal_gravity(
      {1, Extended("0.9").convert_to<double>(), {{2, 1e-3}, {3, -2e-6}, {4, -1.5e-6}}});
  EXPECT_TRUE(written.second_order);
  // Both know the rotation about z.
  EXPECT_EQ(written.rotated_planes, named.rotated_planes);
  const std::vector<std::vector<double>> states = {{1, 0.2, -0.3, 0.1, 0.9, 0.4},
                                                   {-0.2, 0.7, 0.9, 0.8, -0.1, 0.2}};
  for (const auto& state : states) {
    const auto a = test::evaluate_list(written.vector_field, state);
    const auto b = test::evaluate_list(named.vector_field, state);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 4e-15) << i;
  }
}

// The powers of 1/r and the polynomials of z/r are merged, so that the force of a system as it is
// usually written needs as many series as that of the system by name.
TEST(SystemText, CostsAsMuchAsTheSystemByName) {
  SystemText text = written_zonals();
  text.hamiltonian = "(px^2 + py^2 + pz^2)/2 - 1/r*(1 - J2*(R/r)^2*P2)";
  const DynamicalSystem written = make_system("written", text);
  const DynamicalSystem named = zonal_gravity({1, 0.9, {{2, 1e-3}}});
  EXPECT_EQ(written.evaluated_list().nonlinear_operations(),
            named.evaluated_list().nonlinear_operations());
}

// However J2 and J3 are written, what is multiplied out is the same: as many series as the force
// written by hand, and its values. Differences such as x - 1 + mu are not multiplied out: beside
// the smaller body their digits would be lost.
TEST(SystemText, CostsAsMuchHoweverItIsWritten) {
  const DynamicalSystem named =
      zonal_gravity({1, Extended("0.9").convert_to<double>(), {{2, 1e-3}, {3, -2e-6}}});
  const std::vector<double> state = {0.9, 0.2, -0.3, 0.1, 0.9, 0.4};
  const auto expected = test::evaluate_list(named.vector_field, state);
  for (const char* potential :
       {"-1/r*(1 - J2*(R/r)^2*P2 - J3*(R/r)^3*P3)",
        "-1/r*(1 - J2*(R/r)^2*(3*s^2 - 1)/2 - J3*(R/r)^3*s*(5*s^2 - 3)/2)",
        "-1/r + J2*R^2*(3*z^2 - r^2)/(2*r^5) + J3*R^3*z*(5*z^2 - 3*r^2)/(2*r^7)",
        "-1/r + J2*R^2*(3*z^2/r^2 - 1)/(2*r^3) + J3*R^3*z*(5*z^2/r^2 - 3)/(2*r^5)",
        "-1/r + J2*R^2/r^3*(3*s^2 - 1)/2 + J3*R^3/r^4*(5*s^3 - 3*s)/2"}) {
    SystemText text = written_zonals();
    text.hamiltonian = std::string("(px^2 + py^2 + pz^2)/2 + ") + potential;
    const DynamicalSystem written = make_system("written", text);
    EXPECT_EQ(written.evaluated_list().nonlinear_operations(),
              named.evaluated_list().nonlinear_operations())
        << potential;
    const auto field = test::evaluate_list(written.vector_field, state);
    for (std::size_t i = 0; i < field.size(); ++i) {
      EXPECT_NEAR(field[i], expected[i], 4e-15) << potential;
    }
  }
  SystemText text;
  text.coordinates = {"x", "y", "z"};
  text.momenta = {"px", "py", "pz"};
  text.parameters = {{"mu", "0.012"}};
  text.hamiltonian =
      "(px^2 + py^2 + pz^2)/2 + y*px - x*py - (1 - mu)/sqrt((x + mu)^2 + y^2 + z^2)"
      " - mu/sqrt((x - 1 + mu)^2 + y^2 + z^2)";
  const DynamicalSystem bodies = make_system("bodies", text);
  EXPECT_LE(bodies.evaluated_list().nonlinear_operations(), 10U);
  // The equations of motion by hand, a thousandth from the smaller body.
  const std::vector<double> near = {0.989, 1e-4, -2e-4, 0.1, 0.9, 0.4};
  const double x = near[0], y = near[1], z = near[2];
  const double a = 0.988 / std::pow(std::hypot(x + 0.012, y, z), 3);
  const double b = 0.012 / std::pow(std::hypot(x - 0.988, y, z), 3);
  const std::vector<double> by_hand = {near[3] + y,
                                       near[4] - x,
                                       near[5],
                                       near[4] - a * (x + 0.012) - b * (x - 0.988),
                                       -near[3] - (a + b) * y,
                                       -(a + b) * z};
  const auto field = test::evaluate_list(bodies.vector_field, near);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(field[i], by_hand[i], 1e-12 * (1 + std::abs(by_hand[i]))) << i;
}

// x^2 - y is -2^-40 exactly at x = 3, and so is the force; multiplied out it would be the
// difference of two numbers above a hundred.
TEST(SystemText, KeepsTheDigitsOfASquaredDifference) {
  SystemText text;
  text.coordinates = {"x", "y"};
  text.momenta = {"px", "py"};
  text.hamiltonian = "(px^2 + py^2)/2 + (x^2 - y)^2";
  const double difference = -std::ldexp(1.0, -40);
  const std::vector<double> state = {3, 9 - difference, 0, 0};
  const auto field = test::evaluate_list(make_system("valley", text).vector_field, state);
  EXPECT_EQ(field[2], -12 * difference);
  EXPECT_EQ(field[3], 2 * difference);
}

// A vector field is the part of its lift where the adjoint variables vanish.
TEST(SystemText, LiftsAVectorField) {
  SystemText text;
  text.states = {"u", "v", "w"};  // Lorenz's
  text.parameters = {{"rho", "28"}};
  text.vector_field = {{"v", "u*(rho - w) - v"}, {"u", "10*(v - u)"}, {"w", "u*v - 8/3*w"}};
  const DynamicalSystem system = make_system("Lorenz", text);
  EXPECT_EQ(system.degrees_of_freedom, 3U);
  EXPECT_EQ(text.variables(),
            (std::vector<std::string>{"u", "v", "w", "lambda_u", "lambda_v", "lambda_w"}));
  const auto slopes =
      test::evaluate_list(system.vector_field, std::vector<double>{1, 2, 3, 0, 0, 0});
  const std::vector<double> expected = {10, 23, -6, 0, 0, 0};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(slopes[i], expected[i]) << i;
}

TEST(SystemText, ComesBackFromItsOwnText) {
  const DynamicalSystem system = zonal_gravity({1, 0.9, {{2, 1e-3}, {3, -2e-6}}});
  const SystemText text = system_text(system, {"x", "y", "z"}, {"px", "py", "pz"});
  const DynamicalSystem again = make_system("again", text);
  EXPECT_TRUE(is_same_list(again.hamiltonian, system.hamiltonian));
}

void expect_refused(const std::vector<std::string>& words,
                    const std::function<void(SystemText&)>& change) {
  SystemText text = written_zonals();
  change(text);
  test::expect_error([&] { make_system("written", text); }, ErrorKind::usage, words, "");
}

TEST(SystemText, TellsMistakes) {
  expect_refused({"momenta: ", "got 2 names, must be 3"},
                 [](SystemText& t) { t.momenta.pop_back(); });
  expect_refused({"coordinates: ", "got 0 names"}, [](SystemText& t) { t.coordinates.clear(); });
  expect_refused({"coordinates: ", "given twice", "got x"},
                 [](SystemText& t) { t.coordinates[1] = "x"; });
  expect_refused({"momenta: ", "given twice", "got x"}, [](SystemText& t) { t.momenta[1] = "x"; });
  expect_refused({"coordinates: ", "t is the time"}, [](SystemText& t) { t.coordinates[0] = "t"; });
  expect_refused({"hamiltonian: ", "empty"}, [](SystemText& t) { t.hamiltonian.clear(); });
  expect_refused({"parameters.J2: ", "cut off"},
                 [](SystemText& t) { t.parameters[1].text = "1e-3*"; });
  expect_refused({"definitions.P2: ", "unknown name", "got \"S\""},
                 [](SystemText& t) { t.definitions[2].text = "3*S^2"; });
  const auto field = [](const std::vector<NamedText>& lines) {
    return [lines](SystemText& t) {
      t = SystemText{};
      t.states = {"u", "v"};
      t.vector_field = lines;
    };
  };
  expect_refused({"vector_field: ", "nothing for v"}, field({{"u", "v"}}));
  expect_refused({"vector_field.w: ", "no state"}, field({{"u", "v"}, {"v", "u"}, {"w", "1"}}));
  expect_refused({"vector_field.v: ", "unknown name"}, field({{"u", "v"}, {"v", "x"}}));
}

TEST(SystemText, TellsWhereTheStartHasNoValue) {
  const SystemText text = written_zonals();
  const DynamicalSystem system = make_system("written", text);
  test::expect_error(
      [&] {
        require_finite_at(text, system, std::vector<double>{0, 0, 0, 1, 0, 0});
      },
      ErrorKind::usage, {"definitions.s: ", "at the start", "division by zero"}, "");
  SystemText root;
  root.coordinates = {"x"};
  root.momenta = {"p"};
  root.hamiltonian = "p^2/2 + sqrt(x)";
  test::expect_error(
      [&] {
        require_finite_at(root, make_system("root", root), std::vector<double>{0, 1});
      },
      ErrorKind::usage, {"hamiltonian: ", "no finite equations of motion", "derivative of p"}, "");
}

TEST(SystemText, WarnsOfLikelyMistakes) {
  SystemText text;
  text.coordinates = {"x", "y"};
  text.momenta = {"px", "py"};
  text.parameters = {{"a", "1"}};
  text.hamiltonian = "px^2/2 + x^2 + y^2";
  const auto found = likely_mistakes(text, make_system("flat", text));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0], (std::pair<std::string, std::string>("parameters.a", "nothing uses it")));
  EXPECT_EQ(found[1].second, "does not depend on py, so that y stands still");
  text.parameters.clear();
  text.hamiltonian = "px*y + py*x";
  const auto linear = likely_mistakes(text, make_system("linear", text));
  ASSERT_EQ(linear.size(), 1U);
  EXPECT_NE(linear[0].second.find("linear in the momenta"), std::string::npos);
}

TEST(SystemText, WarnsOfMomentaThatStandAtOtherCoordinates) {
  SystemText text;
  text.coordinates = {"x", "y"};
  text.momenta = {"py", "px"};
  text.hamiltonian = "(px^2 + py^2)/2 + x^2 + y^2";
  const auto found = likely_mistakes(text, make_system("crossed", text));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].first, "momenta");
  EXPECT_EQ(found[0].second,
            "py is the momentum of x by its place, not of y: momenta are in the order of the "
            "coordinates");
}

}  // namespace
}  // namespace hamjet
