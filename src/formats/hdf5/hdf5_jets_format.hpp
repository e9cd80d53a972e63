#pragma once

#include <cstddef>
#include <string>
#include <vector>

// Constants that the writer and the reader of `jets.h5` share.

namespace hamjet::io::hdf5 {

inline const std::string format = "hamjet jets";
inline constexpr int format_version = 1;
/// The version of files whose jet is in coordinates other than Cartesian, which version 1 does not
/// have.
inline constexpr int charted_format_version = 2;
/// The version of files whose jet is between flow boxes, in other variables than those of the
/// state.
inline constexpr int flow_box_format_version = 3;

/// Attribute of a run: relative errors of the coefficients of each degree, where they are known.
inline constexpr const char* error_attribute = "coefficient_error_by_degree";

/// Attribute of a run: see content_checksum.
inline constexpr const char* checksum_attribute = "content_crc32";

/// Names of the precisions, in the order of the enumeration Precision.
inline const std::vector<std::string> precision_names = {"double", "extended"};

/// Bytes of a number of 36 digits with sign, point and exponent, filled up with zero bytes.
inline constexpr std::size_t decimal_width = 48;

}  // namespace hamjet::io::hdf5
