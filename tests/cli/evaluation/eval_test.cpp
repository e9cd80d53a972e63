#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "eval_command_test.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "hamjet/formats/stored_jet.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"

// `hamjet eval`: relative states through a stored jet.

namespace hamjet::test {
namespace {

constexpr double pi = std::numbers::pi;

// mu = 7 km x (7 km/s)^2 x 1000: length 7000 km and time 1000 s, so that 1 m/s is 1 / 7000.
constexpr double length_m = 7e6;
constexpr double speed_m_s = 7000;

const std::string oscillator_scene = R"(schema = 1
title = "oscillator"
)" + oscillator_tables + R"([jet]
order = 2
duration_canonical = 1
)" + gauss8("tolerance = 1e-15");

using Eval = EvalTest;

TEST_F(Eval, KeplersJetInClosedForm) {
  // Start (1, 0) with velocity (0, 1 + d), after 2 pi.
  store("circular", circular_scene);
  for (const double d : {1e-3, -2e-3}) {
    const Json json = eval_json(
        {"circular", "--frame", "canonical", "--deviation", "0,0,0,0," + std::to_string(d) + ",0"});
    const Json& row = json["rows"][0];
    const double x = -18 * pi * pi * std::pow(d, 2) - 108 * pi * pi * std::pow(d, 3) +
                     pi * pi * (54 * pi * pi - 462) * std::pow(d, 4) +
                     pi * pi * (972 * pi * pi - 1710) * std::pow(d, 5);
    const double y = -6 * pi * d - 24 * pi * d * d + (36 * pi * pi - 68) * pi * std::pow(d, 3) +
                     (360 * pi * pi - 185) * pi * std::pow(d, 4) +
                     (2196 * pi * pi - 492 - 324 * std::pow(pi, 4) / 5) * pi * std::pow(d, 5);
    EXPECT_NEAR(row["x"].get<double>(), x, 1e-13);
    EXPECT_NEAR(row["y"].get<double>(), y, 1e-13);
    EXPECT_EQ(row["z"].get<double>(), 0);
    EXPECT_EQ(row["support"], "inside");
  }
}

TEST_F(Eval, EstimateOfTheMissIsNearTheNextTerm) {
  // The error of order 4 consists of the terms of degree 5 above, except for terms of higher
  // degree.
  store("circular", circular_scene);
  const double d = 1e-3;
  const Json json = eval_json(
      {"circular", "--frame", "canonical", "--deviation", "0,0,0,0,1e-3,0", "--degree", "4"});
  const double x5 = pi * pi * (972 * pi * pi - 1710) * std::pow(d, 5);
  const double y5 = (2196 * pi * pi - 492 - 324 * std::pow(pi, 4) / 5) * pi * std::pow(d, 5);
  const double miss_m = std::hypot(x5, y5) * length_m;
  const double estimate = json["rows"][0]["miss_estimate_m"];
  EXPECT_GT(estimate, miss_m);
  EXPECT_LT(estimate, 10 * miss_m);
  EXPECT_EQ(json["degree"], 4);
  EXPECT_EQ(json["order"], 5);
  EXPECT_EQ(json["largest_miss_estimate_m"], estimate);
}

// Expected: the jet of degree K is the beginning of that of order 5, so that its miss is what the
// degrees above it add, in closed form.
TEST_F(Eval, TheDegreesThatAreLeftOutTellTheMiss) {
  store("circular", circular_scene);
  const std::vector<std::string> deviation = {"circular", "--frame", "canonical", "--deviation",
                                              "0,0,0,0,1e-3,0"};
  const Json whole = eval_json(deviation)["rows"][0];
  for (int degree = 1; degree < 5; ++degree) {
    std::vector<std::string> arguments = deviation;
    arguments.insert(arguments.end(), {"--degree", std::to_string(degree)});
    const Json row = eval_json(arguments)["rows"][0];
    const double miss_m = std::hypot(row["x"].get<double>() - whole["x"].get<double>(),
                                     row["y"].get<double>() - whole["y"].get<double>()) *
                          length_m;
    EXPECT_GT(row["miss_estimate_m"].get<double>(), 0.8 * miss_m) << degree;
    EXPECT_LT(row["miss_estimate_m"].get<double>(), 4 * miss_m) << degree;
  }
}

// Off the radial direction the degrees of a circular orbit are alternately large and small, so that
// the degree after the last evaluated one says little. The higher degrees are stored too.
TEST_F(Eval, AllDegreesThatAreLeftOutTellTheMiss) {
  store("circular", circular_scene);
  for (const char* deviation : {"0,1e-2,0,0,0,0", "0,0,1e-2,0,0,0", "0,0,0,1e-2,0,0"}) {
    const std::vector<std::string> whole_arguments = {"circular", "--frame", "canonical",
                                                      "--deviation", deviation};
    const Json whole = eval_json(whole_arguments)["rows"][0];
    for (int degree = 1; degree < 4; ++degree) {
      std::vector<std::string> arguments = whole_arguments;
      arguments.insert(arguments.end(), {"--degree", std::to_string(degree)});
      const Json row = eval_json(arguments)["rows"][0];
      double square = 0;
      for (const char* q : {"x", "y", "z"}) {
        square += std::pow(row[q].get<double>() - whole[q].get<double>(), 2);
      }
      const double miss_m = std::sqrt(square) * length_m;
      EXPECT_GT(row["miss_estimate_m"].get<double>(), 0.99 * miss_m) << deviation << degree;
      EXPECT_LT(row["miss_estimate_m"].get<double>(), 1.1 * miss_m) << deviation << degree;
    }
  }
}

/// Where a deputy of the circular orbit ends relative to its chief, in the plane, canonical: from
/// Lagrange's f and g and Kepler's equation for the difference of the eccentric anomalies, in
/// extended precision.
std::array<double, 2> keplers_end(const std::array<double, 4>& deviation) {
  const Extended time = 6.283185307179586;  // the duration of the scene
  const Extended x = 1 + Extended(deviation[0]);
  const Extended y = deviation[1];
  const Extended u = deviation[2];
  const Extended v = 1 + Extended(deviation[3]);
  const Extended r = sqrt(x * x + y * y);
  const Extended a = 1 / (2 / r - u * u - v * v);
  const Extended mean = time / (a * sqrt(a));
  const Extended e_cos = 1 - r / a;
  const Extended e_sin = (x * u + y * v) / sqrt(a);
  Extended anomaly = mean;
  for (int k = 0; k < 12; ++k) {
    anomaly -= (anomaly - e_cos * sin(anomaly) + e_sin * (1 - cos(anomaly)) - mean) /
               (1 - e_cos * cos(anomaly) + e_sin * sin(anomaly));
  }
  const Extended f = 1 - a / r * (1 - cos(anomaly));
  const Extended g = time - a * sqrt(a) * (anomaly - sin(anomaly));
  return {static_cast<double>(Extended(f * x + g * u - cos(time))),
          static_cast<double>(Extended(f * y + g * v - sin(time)))};
}

// At some hundred metres truncation is far below rounding.
TEST_F(Eval, TheEstimateHoldsRoundingToo) {
  store("circular", circular_scene, {"--set", "reference.tolerance=1e-24"});
  const io::StoredJet jet = io::read_stored_jet(directory_ / "circular");
  ASSERT_EQ(jet.error_by_degree.size(), 6U);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int beyond = 0;
  constexpr int deputies = 40;
  for (int k = 0; k < deputies; ++k) {
    std::array<double, 4> d{};
    for (double& x : d) x = std::ldexp(std::round(std::ldexp(uniform(random), 20)), -36);
    const auto exact = keplers_end(d);
    const Json row = eval_json({"circular", "--frame", "canonical", "--deviation",
                                fmt::format("{},{},0,{},{},0", d[0], d[1], d[2], d[3])})["rows"][0];
    const double miss_m =
        std::hypot(row["x"].get<double>() - exact[0], row["y"].get<double>() - exact[1]) * length_m;
    const double estimate = row["miss_estimate_m"];
    EXPECT_LT(row["truncation_m"].get<double>(), 0.1 * estimate);
    beyond += miss_m > estimate ? 1 : 0;
    EXPECT_LT(miss_m, 10 * estimate);
    EXPECT_LT(estimate, 1e-8);
  }
  EXPECT_LE(beyond, deputies / 20);
}

TEST_F(Eval, NoTimeChangesNothing) {
  store("still", circular_scene, {"--set", "jet.duration_canonical=0"});
  for (const std::vector<std::string>& frame : std::vector<std::vector<std::string>>{
           {}, {"--derivatives", "inertial"}, {"--frame", "inertial"}, {"--frame", "canonical"}}) {
    const std::vector<double> given = {0.001, -0.002, 0.003, 0.004, 0.005, -0.006};
    const auto state = eval_one("still", "0.001,-0.002,0.003,0.004,0.005,-0.006", frame);
    ASSERT_EQ(state.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(state[i], given[i], 1e-13);
  }
}

TEST_F(Eval, FramesAreThoseOfTheChief) {
  // At the start R, T, N are x, y, z, and the axes turn once in 2 pi units of time of 1000 s.
  store("circular", circular_scene);
  const auto rotating = eval_one("circular", "100,200,300,0.1,0.2,0.3");
  const auto inertial_rates =
      eval_one("circular", "100,200,300,-0.1,0.3,0.3", {"--derivatives", "inertial"});
  const auto inertial = eval_one("circular", "100,200,300,-0.1,0.3,0.3", {"--frame", "inertial"});
  ASSERT_EQ(inertial.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(inertial[i], inertial_rates[i], 1e-8);
    // v = rho' + omega N x rho with omega = 1e-3 / s.
    const double turning[] = {0, 0, 0, -1e-3 * rotating[1], 1e-3 * rotating[0], 0};
    EXPECT_NEAR(inertial[i], rotating[i] + turning[i], 1e-8);
  }
  const auto canonical =
      eval_one("circular",
               "1.4285714285714285e-5,2.857142857142857e-5,4.2857142857142856e-5,"
               "-1.4285714285714285e-5,4.2857142857142856e-5,4.2857142857142856e-5",
               {"--frame", "canonical"});
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(canonical[i] * (i < 3 ? length_m : speed_m_s), inertial[i], 1e-7);
  }
}

TEST_F(Eval, ManyRowsAgreeWithTheJetEvaluatedInExtendedPrecision) {
  store("kepler", quick_scene());
  const io::StoredJet jet = io::read_stored_jet(directory_ / "kepler");
  const MetricUnits units{jet.units.length_km * 1000, jet.units.time_s};
  const ChiefFrame start(jet.nominal_initial, units, RelativeFrame::rtn_rotating);
  const ChiefFrame end(jet.nominal_final, units, RelativeFrame::rtn_rotating);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1e4, 1e4);
  constexpr std::size_t rows = 10007;
  // The columns are in another order, with blanks and Windows line ends.
  std::string text = "vN_m_s, R_m,T_m,N_m,vR_m_s,vT_m_s\r\n";
  std::vector<RelativeState> states(rows);
  for (RelativeState& state : states) {
    for (int i = 0; i < 3; ++i) {
      state.position_m[i] = std::round(uniform(random));
      state.velocity_m_s[i] = std::round(uniform(random)) / 1024;
    }
    const auto& r = state.position_m;
    const auto& v = state.velocity_m_s;
    std::ostringstream line;
    line.precision(17);
    line << v[2] << "," << r[0] << ", " << r[1] << " ," << r[2] << "," << v[0] << "," << v[1];
    text += line.str() + "\r\n";
  }
  write("start.csv", text);
  const CommandResult result =
      succeed({"eval", "kepler", "--deviations", "start.csv", "-o", "end.csv", "-q"});
  EXPECT_EQ(result.out, "");
  const Table table = read_table(directory_ / "end.csv");
  EXPECT_EQ(table.header, rtn_header + ",miss_estimate_m,support");
  ASSERT_EQ(table.rows.size(), rows);
  for (std::size_t j = 0; j < rows; j += 501) {
    const std::vector<double> deviation = start.deviation(states[j]);
    const std::vector<Extended> point(deviation.begin(), deviation.end());
    std::vector<double> final_deviation;
    for (Series<Extended> component : jet.jet) {
      component[0] = 0;
      final_deviation.push_back(static_cast<double>(evaluate<Extended>(component, point)));
    }
    const RelativeState expected = end.relative(final_deviation);
    for (int i = 0; i < 3; ++i) {
      const auto column = static_cast<std::size_t>(i);
      EXPECT_NEAR(std::stod(table.rows[j][column]), expected.position_m[i], 1e-8);
      EXPECT_NEAR(std::stod(table.rows[j][column + 3]), expected.velocity_m_s[i], 1e-11);
    }
    EXPECT_EQ(table.rows[j].back(), "inside");
  }
  // The same through standard output.
  EXPECT_EQ(succeed({"eval", "kepler", "--deviations", "start.csv", "-q"}).out,
            content(directory_ / "end.csv"));
}

TEST_F(Eval, SaysWhatTheEvaluationTook) {
  store("kepler", quick_scene());
  const CommandResult result = hamjet({"eval", "kepler", "--deviation", "1,2,3,0,0,0"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out.rfind(rtn_header + ",miss_estimate_m,support\n", 0), 0U);
  // A note, broken as tables are: what follows stands under the words of the first line.
  std::istringstream lines(result.err);
  int notes = 0;
  for (std::string line; std::getline(lines, line);) {
    notes += line.starts_with("hamjet: ");
    EXPECT_TRUE(line.starts_with("hamjet: ") || line.starts_with("        ")) << line;
    EXPECT_LE(widest_line(line), 80U) << line;
  }
  EXPECT_EQ(notes, 1);
  EXPECT_NE(result.err.find("hamjet: frame RTN with rotating derivatives; "), std::string::npos);
  const Json json = eval_json({"kepler", "--deviation", "1,2,3,0,0,0", "--run", "midpoint"});
  // 27 monomials of degree 1 and 2 in 6 variables, 6 components.
  EXPECT_EQ(json["evaluation"]["multiply_adds_per_point"], 162);
  EXPECT_EQ(json["run"], "midpoint");
  EXPECT_EQ(json["points"], 1);
  EXPECT_EQ(json["frame"], "RTN");
  EXPECT_EQ(json["derivatives"], "rotating");
  EXPECT_EQ(json["rows"].size(), 1U);
  const Json& evaluation = json["evaluation"];
  EXPECT_EQ(evaluation["multiply_adds_per_point"], 162);
  EXPECT_EQ(evaluation["products_per_point"], 21);
  EXPECT_GT(evaluation["seconds"], 0);
  EXPECT_GT(evaluation["nanoseconds_per_point"], 0);
  EXPECT_GT(evaluation["multiply_adds_per_second"], 0);
  EXPECT_EQ(evaluation["chart_seconds"], 0);  // in positions and momenta there is no chart
}

TEST_F(Eval, ManyRowsAreCountedInJson) {
  store("kepler", quick_scene());
  std::string text = rtn_header + "\n";
  for (int i = 0; i < 101; ++i) text += "1,2,3,0,0,0\n";
  write("start.csv", text + "\n\n");
  const Json json = eval_json({"kepler", "--deviations", "start.csv"});
  EXPECT_EQ(json["points"], 101);
  EXPECT_TRUE(json["rows"].is_null());
}

TEST_F(Eval, MarksWhatTheSeriesDoesNotSupport) {
  store("circular", circular_scene);
  // The speed is half the orbit's, and the powers of the distance overflow.
  write("start.csv", rtn_header + "\n10,0,0,0,0,0\n0,0,0,0,3500,0\n1e80,0,0,0,0,0\n");
  const CommandResult result = hamjet({"eval", "circular", "--deviations", "start.csv"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(hamjet({"eval", "circular", "--deviations", "start.csv", "--strict"}).exit_code, 1);
  EXPECT_EQ(hamjet({"eval", "circular", "--deviation", "10,0,0,0,0,0", "--strict"}).exit_code, 0);
  write("end.csv", result.out);
  const Table table = read_table(directory_ / "end.csv");
  EXPECT_EQ(table.rows[0][7], "inside");
  EXPECT_EQ(table.rows[1][7], "outside");
  EXPECT_EQ(table.rows[1][6], "");
  // Only the size, to one digit, is meaningful there.
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string digits = table.rows[1][i].substr(0, table.rows[1][i].find('e'));
    EXPECT_LE(
        std::count_if(digits.begin(), digits.end(), [](char c) { return c >= '1' && c <= '9'; }), 1)
        << table.rows[1][i];
  }
  EXPECT_EQ(table.rows[2][7], "unknown");
  EXPECT_NE(result.err.find("\nhamjet: 1 of 3 rows marked outside"), std::string::npos);
  EXPECT_NE(result.err.find("\nhamjet: 1 of 3 rows marked unknown"), std::string::npos);
  const Json json = eval_json({"circular", "--deviations", "start.csv"});
  EXPECT_EQ(json["outside"], 1);
  EXPECT_EQ(json["unknown"], 1);
  EXPECT_TRUE(json["rows"][1]["miss_estimate_m"].is_null());
  // One degree alone has no decay; in a jet of higher order the other degrees are known.
  store("linear", circular_scene, {"--set", "jet.order=1"});
  EXPECT_EQ(eval_json({"linear", "--deviations", "start.csv"})["unknown"], 3);
  const Json beginning = eval_json({"circular", "--deviations", "start.csv", "--degree", "1"});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(beginning["rows"][i]["support"], json["rows"][i]["support"]);
  }
}

// A kilometre a second more than the speed of escape, minutes after the start: the polynomials
// hold, but no elements are of a hyperbola, and no miss is told of numbers that are not there.
TEST_F(Eval, AFormThatADeputyHasNotIsNotInside) {
  store("inclined", circular_scene,
        {"--set", "jet.duration_canonical=0.06", "--set", "nominal.velocity_km_s=[0, 6, 3.6]"});
  std::vector<std::string> arguments = {"inclined", "--deviation", "0,0,0,0,4200,0",
                                        "--derivatives", "inertial"};
  EXPECT_EQ(eval_json(arguments)["rows"][0]["support"], "inside");
  arguments.insert(arguments.end(), {"--to", "relative-elements"});
  const Json json = eval_json(arguments);
  const Json& row = json["rows"][0];
  EXPECT_EQ(json["undefined"], 1);
  EXPECT_TRUE(row["a_da_m"].is_null());
  EXPECT_EQ(row["support"], "unknown");
  EXPECT_TRUE(row["miss_estimate_m"].is_null());
}

TEST_F(Eval, APlaneTakesDeviationsInItAlone) {
  store("plane", circular_scene, {"--set", "jet.variables=[\"x\",\"y\",\"px\",\"py\"]"});
  store("space", circular_scene);
  const auto plane = eval_one("plane", "10,20,0,0.01,0.02,0");
  const auto space = eval_one("space", "10,20,0,0.01,0.02,0");
  ASSERT_EQ(plane.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(plane[i], space[i], 1e-6);
  EXPECT_EQ(eval_one("plane", "1e-6,0,0,0", {"--frame", "canonical"}).size(), 4U);
  expect_error({"eval", "plane", "--deviation", "10,20,1,0,0,0"}, 2,
               {"--deviation: the deviation leaves", "x y px py"});
  write("start.csv", rtn_header + "\n1,0,0,0,0,0\n0,0,0,0,0,1\n");
  expect_error({"eval", "plane", "--deviations", "start.csv"}, 5, {"start.csv:3: the deviation"});
}

TEST_F(Eval, OneDegreeOfFreedomIsCanonical) {
  store("oscillator", oscillator_scene);
  // With mass and stiffness 1 the flow is a turn by the angle 1.
  const auto state = eval_one("oscillator", "0.5,0.25", {"--frame", "canonical"});
  ASSERT_EQ(state.size(), 2U);
  EXPECT_NEAR(state[0], 0.5 * std::cos(1) + 0.25 * std::sin(1), 1e-15);
  EXPECT_NEAR(state[1], 0.25 * std::cos(1) - 0.5 * std::sin(1), 1e-15);
  expect_error({"eval", "oscillator", "--deviation", "0.5,0.25"}, 2,
               {"harmonic-oscillator is no orbit", "--frame canonical"});
  write("q.csv", "p,q\n0.25,0.5\n");
  const Json json = eval_json({"oscillator", "--deviations", "q.csv", "--frame", "canonical"});
  EXPECT_EQ(json["rows"][0]["q"], state[0]);
  EXPECT_EQ(json["rows"][0]["truncation_m"], 0);
  EXPECT_LT(json["rows"][0]["miss_estimate_m"].get<double>(), 1e-12);
}

// Degree 4 changes this deputy of a flow box by 3.8 m of 150 km and degree 3 by 3.2 m, which is no
// decay and yet no reason not to say where it is: a flight by SciPy's DOP853 (tolerance 1e-13, the
// field written anew in Python) is 0.338 m away. Three times as far the reach is over.
TEST_F(Eval, OfSmallDegreesSaysWhereADeputyIsThoughTheyDoNotDecay) {
  const std::string scene = HAMJET_SOURCE_DIR "/data/scenes/transfer-sun-synchronous.toml";
  const auto row_of = [&](const std::string& deviation) {
    return eval_json(
        {scene, "--set", "jet.coordinates=flow-box", "--deviation", deviation})["rows"][0];
  };
  const Json row = row_of("145420.13,36705.82,2380.63,12.82,158.06,7.74");
  EXPECT_EQ(row["support"], "inside");
  const double miss =
      std::hypot(row["R_m"].get<double>() + 13713625.06221,
                 row["T_m"].get<double>() + 5725792.47831, row["N_m"].get<double>() + 2811.78968);
  EXPECT_NEAR(miss, 0.338, 0.002);
  EXPECT_GT(row["miss_estimate_m"], miss);
  EXPECT_LT(row["miss_estimate_m"], 30 * miss);
  EXPECT_EQ(row_of("436260.39,110117.46,7141.89,38.46,474.18,23.22")["support"], "outside");
}

}  // namespace
}  // namespace hamjet::test
