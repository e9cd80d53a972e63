#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cases.hpp"
#include "dynamics/fields/point_mass_field.hpp"
#include "dynamics/fields/spherical_harmonic_field.hpp"
#include "timing.hpp"

namespace hamjet::benchmarks {
namespace {

constexpr std::size_t points = 8;
/// A single expansion is too short for the clock.
constexpr int repeats = 100;

/// All coefficients are there, of the size that the Earth's have.
SphericalHarmonicCoefficients full_field(int degree) {
  SphericalHarmonicCoefficients coefficients(degree, degree);
  for (int n = 2; n <= degree; ++n) {
    for (int m = 0; m <= n; ++m) {
      coefficients.C(n, m) = 1e-5 / (n * n);
      if (m > 0) coefficients.S(n, m) = 1e-5 / (n * n + m);
    }
  }
  return coefficients;
}

struct Row {
  std::string name;
  std::shared_ptr<const LocalField> field;
  int degree;
};

}  // namespace

void benchmark_fields() {
  std::array<std::vector<double>, 3> r;
  for (std::size_t i = 0; i < points; ++i) {
    const double angle = 0.1 * static_cast<double>(i);
    r[0].push_back(1.08 * std::cos(angle));
    r[1].push_back(0.3 * std::sin(angle));
    r[2].push_back(1.04 * std::sin(angle));
  }
  std::vector<Row> rows;
  const auto add = [&](const std::string& name, const std::shared_ptr<const LocalField>& field) {
    for (const int degree : {2, 5, 7}) rows.push_back({name, field, degree});
  };
  add("point mass", std::make_shared<PointMassField>(1.0));
  for (const int degree : {20, 36, 70}) {
    add(fmt::format("{0} x {0}", degree),
        std::make_shared<SphericalHarmonicField>(1.0, 1.0, full_field(degree)));
  }
  std::vector<std::function<void()>> works;
  std::vector<double> out(local_field_size(7) * points);
  for (const Row& row : rows) {
    for (const std::size_t count : {points, std::size_t{1}}) {
      works.emplace_back([&r, &out, &row, count] {
        for (int i = 0; i < repeats; ++i) {
          row.field->expand(count, r[0].data(), r[1].data(), r[2].data(), row.degree, out.data());
        }
      });
    }
  }
  const auto seconds = median_seconds(works, 21);
  fmt::print("\nlocal polynomials of fields at {} points side by side, and at one\n", points);
  fmt::print("{:<12} {:>9} {:>15} {:>12} {:>16} {:>12}\n", "field", "to degree", "multiply-adds*",
             "time", "1e9 a second", "one point");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double count = static_cast<double>(points) * rows[i].field->multiply_adds(rows[i].degree);
    const double time = seconds[2 * i] / repeats;
    fmt::print("{:<12} {:>9} {:>15.0f} {:>9.2f} us {:>16.1f} {:>9.2f} us\n", rows[i].name,
               rows[i].degree, count, time * 1e6, count / time / 1e9,
               seconds[2 * i + 1] / repeats * 1e6);
  }
  fmt::print(
      "    * of the recursions and of the sums over degree and order, at all points; the rest\n"
      "      is the same for every field\n");
}

}  // namespace hamjet::benchmarks
