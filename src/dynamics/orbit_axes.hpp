#pragma once

#include <array>
#include <span>

#include "turned_vectors.hpp"

namespace hamjet {

inline ExpressionVector cross_product(std::span<const Expression> a,
                                      std::span<const Expression> b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline ExpressionVector unit_vector(const ExpressionVector& v) {
  const Expression inverse = pow(dot(v, v), Expression(-0.5));
  return {v[0] * inverse, v[1] * inverse, v[2] * inverse};
}

/// The unit vectors R = q / |q|, T = N x R and N = q x p / |q x p| of an orbit.
inline std::array<ExpressionVector, 3> orbit_axes(std::span<const Expression> q,
                                                  std::span<const Expression> p) {
  const ExpressionVector radial = unit_vector({q[0], q[1], q[2]});
  const ExpressionVector normal = unit_vector(cross_product(q, p));
  return {radial, cross_product(normal, radial), normal};
}

/// The unit vectors T = p / |p|, N = W x T and W = q x p / |q x p| of an orbit.
inline std::array<ExpressionVector, 3> velocity_axes(std::span<const Expression> q,
                                                     std::span<const Expression> p) {
  const ExpressionVector along = unit_vector({p[0], p[1], p[2]});
  const ExpressionVector normal = unit_vector(cross_product(q, p));
  return {along, cross_product(normal, along), normal};
}

}  // namespace hamjet
