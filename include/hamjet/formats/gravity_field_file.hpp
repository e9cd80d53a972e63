#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/astronomy/epoch.hpp"
#include "hamjet/detail/dynamics/spherical_harmonic_coefficients.hpp"
#include "hamjet/detail/dynamics/zonal_coefficients.hpp"

namespace hamjet::io {

/// Largest file that is read, in bytes; the largest existing model, of degree 5540, takes half of
/// this.
inline constexpr std::size_t largest_gravity_field_bytes = std::size_t{1} << 32;

/// What a gravity field in the format of the International Centre for Global Earth Models (ICGEM,
/// `.gfc`; E. S. Ince et al., Earth System Science Data 11, 647 (2019)) says of itself.
struct GravityModel {
  std::string model_name;   ///< `modelname` or `product_name`; empty where the file has neither
  std::string tide_system;  ///< as written; "unknown" where the file says nothing
  double mu_km3_s2 = 0;
  double radius_km = 0;
  int max_degree = 0;
  /// Epoch at which coefficients that vary with time were taken; absent if none does.
  std::optional<Epoch> epoch;
};

/// What the header of a file says; coefficients are not read. Throws as parse_gravity_field for a
/// header.
GravityModel parse_gravity_model(const std::string& name, std::string_view text);

/// The zonal part of a gravity field.
struct GravityField : GravityModel {
  ZonalCoefficients J;  ///< coefficients that were asked for, not normalised, J_n = -C_n0
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
/// the choice. Tesseral coefficients are skipped. Throws
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

/// What C(2,0) contains of the permanent tide, by which Sun and Moon deform the Earth on average:
/// in `zero_tide` it contains the potential of that deformation, in `tide_free` it does not.
enum class TideSystem { tide_free, zero_tide };

/// How a tide system is named in files and scenes.
std::string_view tide_system_name(TideSystem system);

/// Which harmonics to take from a file, and in which tide system.
struct HarmonicChoice {
  int degree = 0;  ///< at least 2
  int order = 0;   ///< at most the degree
  /// The tide system of the result; absent: the file's own.
  std::optional<TideSystem> tide_system = {};
  /// What the user says of the file; needed where the file says neither tide_free nor zero_tide.
  std::optional<TideSystem> tide_system_of_file = {};
  /// Gives the epoch. It is called once, and only if a coefficient varies with time.
  std::function<std::optional<Epoch>()> epoch = {};
};

/// A gravity field in the axes of its body.
struct HarmonicField : GravityModel {
  /// Normalised; C_00 = 1, and degree 1 is 0: the origin is the centre of mass.
  SphericalHarmonicCoefficients coefficients{0, 0};
  TideSystem tide = TideSystem::tide_free;  ///< the system of `coefficients`
  double added_to_C20 = 0;                  ///< by conversion from one tide system to the other
  /// The centre of mass in the file's own axes, sqrt(3) R (C11, S11, C10) of normalised
  /// coefficients. Absent if these vary with time and there is no epoch.
  std::optional<std::array<double, 3>> origin_offset_km = std::array<double, 3>{};
};

/// The normalised C(2,0) of the Earth's permanent deformation, A0 H0 k20, which a zero-tide C(2,0)
/// has more than a tide-free one. Source: G. Petit, B. Luzum (eds.), IERS Conventions (2010), IERS
/// Technical Note 36, section 6.2.2, equations 6.13 and 6.14.
inline constexpr double permanent_tide_C20 = 4.4228e-8 * -0.31460 * 0.30190;

/// Reads the harmonics of a gravity field file as parse_gravity_field reads zonal coefficients;
/// those of an unnormalised file are divided by their norm. Throws Error(usage) for a choice of
/// degree and order that is none, and Error(input_output), one line `name:line: ...`, also for
///  - a coefficient that is missing, such as those of a degree beyond the file's;
///  - a tide system other than tide_free and zero_tide where `tide_system_of_file` is absent, and
///  one
///    of these two where it says the other.
HarmonicField parse_harmonic_field(const std::string& name, std::string_view text,
                                   const HarmonicChoice& choice);

/// parse_harmonic_field from a file, with the errors of read_gravity_field.
HarmonicField read_harmonic_field(const std::filesystem::path& file, const HarmonicChoice& choice);

/// parse_gravity_field from a file. It also throws Error(input_output) if the file cannot be read
/// or is not regular, and Error(too_large) if it is larger than largest_gravity_field_bytes.
GravityField read_gravity_field(const std::filesystem::path& file, const ZonalChoice& choice);

}  // namespace hamjet::io
