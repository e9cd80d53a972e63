#include "symplectic_powers.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hamjet/error.hpp"

namespace hamjet {

SymplecticPowers::SymplecticPowers(const AffineSymplecticMap<Extended>& map)
    : map_(map), power_(AffineSymplecticMap<Extended>::identity(map.dimension() / 2)) {}

AffineSymplecticMap<double> SymplecticPowers::operator()(long k) {
  if (k < 0) throw Error(ErrorKind::usage, "powers of a map: the exponent must not be negative");
  if (k < exponent_) {
    power_ = AffineSymplecticMap<Extended>::identity(map_.dimension() / 2);
    exponent_ = 0;
  }
  for (; exponent_ < k; ++exponent_) power_ = map_.after(power_);
  const Matrix<double> matrix = power_.matrix().cast<double>();
  const Vector<double> shift = power_.shift().cast<double>();
  // The symplecticity defect of such a large matrix would overflow.
  if (!std::isfinite(matrix.squaredNorm()) || !std::isfinite(shift.squaredNorm())) {
    throw Error(ErrorKind::numerical,
                fmt::format("powers of a map: the one of exponent {} overflows", k));
  }
  return {matrix, shift};
}

}  // namespace hamjet
