#pragma once

#include <Eigen/Core>

namespace hamjet {

/// The smallest singular value of a 3 x 3 matrix, with the sign of the determinant, to rounding
/// relative to the largest one. The matrix is brought to a triangle R by columns, the largest
/// first, so that its sign is right where two singular values are below the square root of
/// rounding, and where a sum of products has lost it. The square of the value is the least root of
///
///   x^3 - |R|^2 x^2 + |cofactors of R|^2 x - (r_11 r_22 r_33)^2 = 0 ,
///
/// which Newton's method approaches from below without overshooting. Where the two smallest values
/// are nearly equal, a singular value decomposition takes its place. Throws Error(numerical) if an
/// entry is not finite.
double signed_smallest_singular_value(const Eigen::Matrix3d& matrix);

}  // namespace hamjet
