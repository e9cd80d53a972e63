#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace hamjet {

/// Extended precision: 113 significant bits (about 34 digits) with a 15-bit exponent, the format of
/// IEEE binary128, from Boost.Multiprecision. Expression templates are off: they gain nothing at
/// this size.
using Extended =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                  boost::multiprecision::et_off>;

/// Rounds to another precision. This function stands in one place because Boost's conversions are
/// explicit.
template <class To, class From>
To convert(const From& value) {
  return static_cast<To>(value);
}

}  // namespace hamjet
