#include <cmath>
#include <cstdlib>
#include <numbers>

#include "command_test.hpp"
#include "support/magnitude.hpp"

// figure.svg and along_time.csv of `hamjet run`. The times at which F1 of the harmonic oscillator
// does not exist are those of sin t = 0.

namespace hamjet::test {
namespace {

const std::string figure_scene = R"(schema = 1
title = "oscillator"
)" + oscillator_tables + R"([jet]
order = 1
duration_canonical = 20
[[integrator]]
label = "gauss"
method = "gauss"
stages = 4
step_canonical = 0.1
[[integrator]]
label = "fehlberg"
method = "fehlberg78"
step_canonical = 0.1
[generating_function]
kinds = ["F1"]
[figure]
quantity = "exactness"
)";

class Figure : public CommandTest {
 protected:
  Figure() { write("oscillator.toml", figure_scene); }

  static bool has_gnuplot() { return std::system("command -v gnuplot >/dev/null 2>&1") == 0; }
  std::filesystem::path out(const std::string& file) const { return directory_ / "o" / file; }
};

TEST_F(Figure, ShowsTheResidualAndMarksTheTimesWithoutF1) {
  if (!has_gnuplot()) GTEST_SKIP() << "no gnuplot";
  const std::string said = succeed({"run", "oscillator.toml", "-o", "o"}).out;
  EXPECT_NE(said.find("figure: o/figure.svg\n"), std::string::npos) << said;
  const std::string figure = content(out("figure.svg"));
  EXPECT_TRUE(figure.starts_with("<svg"));
  EXPECT_NE(figure.find("exactness residual"), std::string::npos);
  EXPECT_NE(figure.find("fehlberg"), std::string::npos);

  int singular = 0;
  double largest = 0;
  for (const auto& row : read_table(out("gauss/along_time.csv")).rows) {
    if (row[2] == "singular") {
      // The rule is correct to 1e-9 here; the time is interpolated over a step of 0.1.
      EXPECT_NEAR(std::stod(row[0]), ++singular * std::numbers::pi, 1e-3);
    } else if (!row[2].empty()) {
      largest = larger(largest, std::stod(row[2]));
    }
  }
  EXPECT_EQ(singular, 6);  // pi .. 6 pi lie within 20
  EXPECT_LE(largest, 1e-14);
}

TEST_F(Figure, EnergyErrorAlongTime) {
  if (!has_gnuplot()) GTEST_SKIP() << "no gnuplot";
  succeed({"run", "oscillator.toml", "-o", "o", "-q", "--set", "figure.quantity=energy-error"});
  EXPECT_NE(content(out("figure.svg")).find("energy error"), std::string::npos);
  for (const auto& row : read_table(out("gauss/along_time.csv")).rows) EXPECT_EQ(row[2], "");
}

TEST_F(Figure, IsNotMadeWhereItIsNotAskedFor) {
  succeed({"run", "oscillator.toml", "-o", "o", "-q", "--set", "figure=null"});
  EXPECT_FALSE(std::filesystem::exists(out("figure.svg")));
  EXPECT_FALSE(std::filesystem::exists(out("gauss/along_time.csv")));
}

TEST_F(Figure, OfAnEarlierRunDoesNotStayBehind) {
  if (!has_gnuplot()) GTEST_SKIP() << "no gnuplot";
  succeed({"run", "oscillator.toml", "-o", "o", "-q"});
  succeed({"run", "oscillator.toml", "-o", "o", "-q", "--set", "figure=null"});
  EXPECT_FALSE(std::filesystem::exists(out("figure.svg")));
  EXPECT_FALSE(std::filesystem::exists(out("gauss/along_time.csv")));
}

TEST_F(Figure, WithoutGnuplotThereIsOneLineAndAllElse) {
  options_.environment.emplace_back("PATH", "/nowhere");
  const CommandResult result = hamjet({"run", "oscillator.toml", "-o", "o", "-q"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("gnuplot"), std::string::npos);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_TRUE(std::filesystem::exists(out("summary.json")));
  EXPECT_TRUE(std::filesystem::exists(out("gauss/along_time.csv")));
}

TEST_F(Figure, MistakesAreNamed) {
  expect_error({"run", "oscillator.toml", "--set", "figure.quantity=error"}, 3,
               {"figure.quantity", "exactness"});
  expect_error({"run", "oscillator.toml", "--set", "figure.kind=F5"}, 3,
               {"figure.kind", "F5", "F1, F2, F3, F4"});
  expect_error({"run", "oscillator.toml", "--set", "figure.kind=auto"}, 3,
               {"figure.kind", "chosen at the final time"});
  expect_error({"run", "oscillator.toml", "--set", "figure={quantity='energy-error', kind='F1'}"},
               3, {"figure.kind", "has no key kind"});
  expect_error({"run", "oscillator.toml", "--set", "generating_function=null", "--set",
                "jet.variables=['q']"},
               3, {"figure.quantity", "jet.variables"});
  expect_error({"run", "oscillator.toml", "--set", "figure.colour=red"}, 3,
               {"figure.colour: unknown key"});
}

}  // namespace
}  // namespace hamjet::test
