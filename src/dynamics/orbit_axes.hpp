#pragma once

#include <array>
#include <span>

#include "turned_vectors.hpp"

namespace hamjet {

/// The unit vectors R = q / |q|, T = N x R and N = q x p / |q x p| of an orbit.
inline std::array<ExpressionVector, 3> orbit_axes(std::span<const Expression> q,
                                                  std::span<const Expression> p) {
  const auto cross = [](std::span<const Expression> a, std::span<const Expression> b) {
    return ExpressionVector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                            a[0] * b[1] - a[1] * b[0]};
  };
  const auto unit = [](const ExpressionVector& v) {
    const Expression inverse = pow(dot(v, v), Expression(-0.5));
    return ExpressionVector{v[0] * inverse, v[1] * inverse, v[2] * inverse};
  };
  const ExpressionVector radial = unit({q[0], q[1], q[2]});
  const ExpressionVector normal = unit(cross(q, p));
  return {radial, cross(normal, radial), normal};
}

}  // namespace hamjet
