#pragma once

#include "hamjet/instruction_set.hpp"

// The compiler's own numbers of 128 bits, where it has them: programs with them take a third of the
// time to compile, and run two to six times as fast.
#if HAMJET_BINARY128
#include <boost/multiprecision/float128.hpp>
#ifndef BOOST_HAS_FLOAT128
// Boost says this itself where the compiler's extensions are on. Without it, its own limits and
// some of its functions do not compile with -std=c++20.
template <>
struct boost::multiprecision::number_category<__float128>
    : boost::mpl::int_<boost::multiprecision::number_kind_floating_point> {};
#endif
#else
#include <boost/multiprecision/cpp_bin_float.hpp>
#endif

namespace hamjet {

/// Extended precision: the numbers of IEEE binary128, with 113 significant bits (about 34 digits)
/// and a 15-bit exponent, by Boost.Multiprecision. Expression templates are off: they gain nothing
/// at this size.
using Extended = boost::multiprecision::number<
#if HAMJET_BINARY128
    boost::multiprecision::float128_backend,
#else
    boost::multiprecision::cpp_bin_float_quad::backend_type,
#endif
    boost::multiprecision::et_off>;

/// Rounds to another precision. This function stands in one place because Boost's conversions are
/// explicit.
template <class To, class From>
To convert(const From& value) {
  return static_cast<To>(value);
}

}  // namespace hamjet
