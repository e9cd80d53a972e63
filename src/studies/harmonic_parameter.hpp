#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hamjet {

/// A coefficient of a field of spherical harmonics that may be a variable of jets: a zonal J_n, not
/// normalised, or a C_nm or S_nm, fully normalised.
struct HarmonicParameter {
  enum class Part { J, C, S };

  Part part = Part::J;
  int degree = 0;
  int order = 0;

  /// `J7`; `C22` where degree and order have one digit each, `C_10_3` otherwise.
  std::string name() const;

  /// Reads both forms of a name, also where the other one is the right one. No value for a text
  /// that is no name of a coefficient.
  static std::optional<HarmonicParameter> named(std::string_view text);

  /// The names of a field's coefficients, as in "J2 to J20".
  static std::string names_of_field(int degree, int order);
};

}  // namespace hamjet
