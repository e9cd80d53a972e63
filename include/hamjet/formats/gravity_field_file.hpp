#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/astronomy/epoch.hpp"
#include "hamjet/detail/dynamics/zonal_coefficients.hpp"

namespace hamjet::io {

/// Largest file that is read, in bytes; the largest existing model, of degree 5540, takes half of
/// this.
inline constexpr std::size_t largest_gravity_field_bytes = std::size_t{1} << 32;

/// The zonal part of a gravity field in the format of the International Centre for Global Earth
/// Models (ICGEM, `.gfc`; E. S. Ince et al., Earth System Science Data 11, 647 (2019)).
struct GravityField {
  std::string model_name;   ///< `modelname` or `product_name`; empty where the file has neither
  std::string tide_system;  ///< as written; "unknown" where the file says nothing
  double mu_km3_s2 = 0;
  double radius_km = 0;
  int max_degree = 0;
  ZonalCoefficients J;  ///< coefficients that were asked for, not normalised, J_n = -C_n0
  /// Epoch at which coefficients that vary with time were taken; absent if none does.
  std::optional<Epoch> epoch;
  /// The distance along the axis from the origin to the centre of mass, towards positive z: sqrt(3)
  /// R C10 with the normalised C(1,0). Absent if C(1,0) varies with time and there is no epoch.
  std::optional<double> origin_offset_km = 0;
};

/// The zonal coefficients to take from a file: those of `degrees` or, if that is empty, all from 2
/// to `highest`. All degrees are between ZonalCoefficients::lowest and ZonalCoefficients::highest.
struct ZonalChoice {
  int highest = 0;
  std::vector<int> degrees = {};
  /// Gives the epoch. It is called once, and only if a coefficient varies with time.
  std::function<std::optional<Epoch>()> epoch = {};
};

/// Reads the text of a gravity field file (ICGEM, formats 1.0 and 2.0); `name` is the file's, for
/// messages. Coefficients with the norm `fully_normalized`, which is the default, are multiplied by
/// sqrt(2n + 1) in extended precision, and every number is rounded once. Exponents may be Fortran's
/// (D). Coefficients that vary with time (gfct, trnd, dot, asin, acos) are taken at the epoch of
/// the choice. Tesseral coefficients are skipped, because the field of a scene has none. Throws
/// Error(input_output), one line `name:line: ...`, for
///  - a header without end_of_head, a gravity constant, a radius or max_degree, a keyword that is
///    there twice, a product_type other than gravity_field, another norm or format;
///  - a record with an unknown key, another number of columns than it has, or degree and order that
///    are not valid numbers;
///  - a coefficient that is asked for and is missing, there twice, no finite number, beyond 1 in
///    magnitude, or varies with time while there is no epoch, or none at which it is given;
///  - C(0,0) that is not 1.
GravityField parse_gravity_field(const std::string& name, std::string_view text,
                                 const ZonalChoice& choice);

/// parse_gravity_field from a file. It also throws Error(input_output) if the file cannot be read
/// or is not regular, and Error(too_large) if it is larger than largest_gravity_field_bytes.
GravityField read_gravity_field(const std::filesystem::path& file, const ZonalChoice& choice);

}  // namespace hamjet::io
