#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <random>

namespace hamjet::test {

/// Writes a field of degree and order 70: the Earth's J2, and all other coefficients random, of the
/// sizes of Kaula's rule.
inline void write_made_up_field(const std::filesystem::path& file) {
  std::mt19937_64 generator(70);
  const auto draw = [&](int n) {
    const double fraction = static_cast<double>(generator() >> 11) * 0x1p-53;
    return (2 * fraction - 1) * 1e-5 / (n * n);
  };
  std::ofstream out(file);
  out << "product_type gravity_field\nmodelname MADE_UP\nearth_gravity_constant 0.3986004415E+15\n"
         "radius 0.63781363E+07\nmax_degree 70\ntide_system tide_free\nend_of_head\ngfc 0 0 1.0 "
         "0.0\ngfc 1 0 0.0 0.0\ngfc 1 1 0.0 0.0\n";
  for (int n = 2; n <= 70; ++n) {
    for (int m = 0; m <= n; ++m) {
      const double C = n == 2 && m == 0 ? -4.84165e-4 : draw(n);
      out << fmt::format("gfc {} {} {:.17g} {:.17g}\n", n, m, C, m == 0 ? 0.0 : draw(n));
    }
  }
}

}  // namespace hamjet::test
