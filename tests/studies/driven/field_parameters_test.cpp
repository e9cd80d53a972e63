#include <erfa.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "hamjet/detail/dynamics/spherical_harmonic_coefficients.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/propagation.hpp"
#include "studies/earth_system.hpp"
#include "studies/harmonic_parameter.hpp"
#include "support/errors.hpp"
#include "support/line_of_flights.hpp"

// Coefficients of the Earth's field as variables of jets, against differences of flights in fields
// with other coefficients: Cunningham's recursion, ERFA's axes and extrapolated steps.

namespace hamjet {
namespace {

using test::Numbers;

constexpr int field_degree = 12;
constexpr double duration_s = 2500;

std::string text_of(const std::string& variable) {
  return fmt::format(R"(schema = 1
[system]
model = "earth"
gravity_degree = {}
sun = false
moon = false
[nominal]
epoch_tt = "2026-03-01T06:00:00"
height_km = 400
i_deg = 63
raan_deg = 30
u_deg = 20
[jet]
order = 3
duration_s = {}
variables = ["x", "y", "z", "px", "py", "pz", "{}"]
)",
                     field_degree, duration_s, variable);
}

/// The matrix from GCRF to ITRF at seconds after the scene's epoch, with UT1 = UTC and no polar
/// motion. Over the flight the pole is a line in the time to 1e-14.
class EarthAxes {
 public:
  EarthAxes() {
    for (std::size_t end = 0; end < 2; ++end) {
      double* v = pole_[end].data();
      eraXys06a(day, second(end == 0 ? 0 : duration_s), v, v + 1, v + 2);
    }
    sp_ = eraSp00(day, second(0));
  }
  std::array<std::array<double, 3>, 3> at(double time_s) const {
    double now[3];
    const double part = time_s / duration_s;
    for (std::size_t i = 0; i < 3; ++i) now[i] = (1 - part) * pole_[0][i] + part * pole_[1][i];
    double celestial[3][3], motion[3][3], all[3][3];
    eraC2ixys(now[0], now[1], now[2], celestial);
    eraPom00(0, 0, sp_, motion);
    // TT is 69.184 s ahead of UTC in 2026.
    eraC2tcio(celestial, eraEra00(day, second(time_s - 69.184)), motion, all);
    std::array<std::array<double, 3>, 3> result;
    for (std::size_t i = 0; i < 3; ++i) std::copy(all[i], all[i] + 3, result[i].begin());
    return result;
  }

 private:
  static constexpr double day = 2461100.5;  // 2026-03-01
  static double second(double time_s) { return 0.25 + time_s / 86400; }
  std::array<std::array<double, 3>, 2> pole_{};
  double sp_ = 0;
};

using Real = Extended;
using Triangle = std::array<std::array<Real, field_degree + 2>, field_degree + 2>;

/// Coefficients that are not normalised, of mu = 1.
struct Field {
  Real radius = 1;
  Triangle C{}, S{};
};

Real norm_of(int n, int m) {
  Real square = (m == 0 ? 1 : 2) * (2 * n + 1);
  for (int k = n - m + 1; k <= n + m; ++k) square /= k;
  return sqrt(square);
}

/// The acceleration along the fixed axes. Source: Montenbruck and Gill, Satellite Orbits, sections
/// 3.2.4 and 3.2.5.
std::array<Real, 3> acceleration(const Field& field, const std::array<Real, 3>& r) {
  const Real square = r[0] * r[0] + r[1] * r[1] + r[2] * r[2], R = field.radius;
  const Real x = R * r[0] / square, y = R * r[1] / square, z = R * r[2] / square;
  const Real fall = R * R / square;
  Triangle V{}, W{};
  V[0][0] = R / sqrt(square);
  for (int m = 0; m <= field_degree + 1; ++m) {
    if (m > 0) {
      V[m][m] = (2 * m - 1) * (x * V[m - 1][m - 1] - y * W[m - 1][m - 1]);
      W[m][m] = (2 * m - 1) * (x * W[m - 1][m - 1] + y * V[m - 1][m - 1]);
    }
    for (int n = m + 1; n <= field_degree + 1; ++n) {
      const Real before = Real(n + m - 1) / (n - m) * fall;
      const Real ahead = Real(2 * n - 1) / (n - m) * z;
      V[n][m] = ahead * V[n - 1][m] - (n > m + 1 ? Real(before * V[n - 2][m]) : Real(0));
      W[n][m] = ahead * W[n - 1][m] - (n > m + 1 ? Real(before * W[n - 2][m]) : Real(0));
    }
  }
  std::array<Real, 3> a{};
  for (int n = 0; n <= field_degree; ++n) {
    for (int m = 0; m <= n; ++m) {
      const Real C = field.C[n][m], S = field.S[n][m];
      if (m == 0) {
        a[0] -= C * V[n + 1][1];
        a[1] -= C * W[n + 1][1];
      } else {
        const Real f = Real(n - m + 1) * (n - m + 2);
        a[0] += (-C * V[n + 1][m + 1] - S * W[n + 1][m + 1]) / 2 +
                f * (C * V[n + 1][m - 1] + S * W[n + 1][m - 1]) / 2;
        a[1] += (-C * W[n + 1][m + 1] + S * V[n + 1][m + 1]) / 2 +
                f * (-C * W[n + 1][m - 1] + S * V[n + 1][m - 1]) / 2;
      }
      a[2] += (n - m + 1) * (-C * V[n + 1][m] - S * W[n + 1][m]);
    }
  }
  for (Real& component : a) component /= R * R;
  return a;
}

Field field_of(const Scene& scene) {
  Field field;
  const auto& coefficients = *scene.system.earth->field;
  field.radius = Real(scene.system.radius_km) / scene.units.length_km;
  for (int n = 0; n <= field_degree; ++n) {
    for (int m = 0; m <= n; ++m) {
      field.C[n][m] = coefficients.C(n, m) * norm_of(n, m);
      field.S[n][m] = coefficients.S(n, m) * norm_of(n, m);
    }
  }
  return field;
}

/// The end of a flight, all in canonical units.
Numbers flown(const Scene& scene, const Field& field, const EarthAxes& axes, const Numbers& start) {
  const double time_s = scene.units.time_s;
  const auto rates = [&](const Numbers& state, Extended t) {
    const auto matrix = axes.at(static_cast<double>(t) * time_s);
    std::array<Real, 3> place{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) place[i] += matrix[i][k] * state[k];
    }
    const auto a = acceleration(field, place);
    Numbers result(6, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = state[3 + i];
      for (std::size_t k = 0; k < 3; ++k) result[3 + i] += matrix[k][i] * a[k];
    }
    return result;
  };
  return test::extrapolated_flight(rates, start, 0, scene.duration, 6);
}

// Degrees 1 to 3, along a line of the coefficients alone and along one of all variables.
TEST(FieldParameters, DerivativesAreThoseOfFlightsInFieldsWithOtherCoefficients) {
  const Scene scene = io::parse_scene(text_of(R"(J12", "C22", "S31", "C_10_3)"), "earth.toml");
  const RunResult run = propagate(scene).runs.at(0);
  ASSERT_EQ(run.failure, "");
  const EarthAxes axes;
  const std::vector<double> of_coefficients = {0.01, -0.02, 0.015, 0.02};
  for (const double of_state : {0.0, 0.01}) {
    std::vector<double> direction = {2 * of_state, -3 * of_state, of_state,
                                     2 * of_state, -of_state,     3 * of_state};
    direction.insert(direction.end(), of_coefficients.begin(), of_coefficients.end());
    const auto end = [&](Extended s) {
      Field field = field_of(scene);
      field.C[12][0] -= s * of_coefficients[0];
      field.C[2][2] += norm_of(2, 2) * s * of_coefficients[1];
      field.S[3][1] += norm_of(3, 1) * s * of_coefficients[2];
      field.C[10][3] += norm_of(10, 3) * s * of_coefficients[3];
      Numbers start;
      for (std::size_t i = 0; i < 6; ++i) start.push_back(scene.nominal[i] + s * direction[i]);
      return flown(scene, field, axes, start);
    };
    const auto right = test::coefficients_by_differences(end, Extended(0.002));
    EXPECT_LT(test::largest_difference(run.jet, direction, right, 6), 1e-9) << of_state;
  }
}

TEST(FieldParameters, NamesAreReadInBothForms) {
  using Part = HarmonicParameter::Part;
  const auto name_of = [](Part part, int n, int m) { return HarmonicParameter{part, n, m}.name(); };
  EXPECT_EQ(name_of(Part::J, 20, 0), "J20");
  EXPECT_EQ(name_of(Part::S, 9, 9), "S99");
  EXPECT_EQ(name_of(Part::C, 10, 3), "C_10_3");
  for (const char* text : {"J20", "C22", "S31", "C_10_3", "S_70_70"}) {
    ASSERT_TRUE(HarmonicParameter::named(text)) << text;
    EXPECT_EQ(HarmonicParameter::named(text)->name(), text);
  }
  EXPECT_EQ(HarmonicParameter::named("C_2_2")->name(), "C22");
  for (const char* text : {"", "J", "J02", "J-2", "C2", "C222", "C_2", "C_2_", "C__2", "D22", "C2a",
                           "J1000", "C_02_1", "mu"}) {
    EXPECT_FALSE(HarmonicParameter::named(text)) << text;
  }
}

TEST(FieldParameters, CoefficientsThatTheFieldLacksAreRefused) {
  const auto refuse = [](const std::string& name, const std::vector<std::string>& parts) {
    test::expect_error([&] { io::parse_scene(text_of(name), "earth.toml"); }, ErrorKind::scene,
                       parts, name);
  };
  refuse("J13",
         {":16:", "beyond the field of degree 12, got \"J13\"", "gravity_degree = 13"});
  refuse("C_13_1", {"beyond the field of degree 12", "gravity_degree = 13"});
  refuse("C34", {"of order 4 above its degree 3"});
  refuse("C20", {"zonal, got \"C20\"", "or J2, which is -sqrt(5) times it"});
  refuse("S30", {"always zero, got \"S30\""});
  refuse("J1", {"0 about the centre of mass, got \"J1\"", "degree 2 or more"});
  refuse("C_2_2", {"got \"C_2_2\", must be \"C22\""});
  refuse("C123", {"unknown variable, got \"C123\"", "J2 to J12, C21 to C_12_12, S21 to S_12_12"});
}

}  // namespace
}  // namespace hamjet
