#include "hamjet/dynamics/spacecraft_forces.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "hamjet/error.hpp"
#include "orbit_axes.hpp"
#include "turned_vectors.hpp"

namespace hamjet {
namespace {

/// cos^n(psi / 2) = ((1 + e.q / |q|) / 2)^(n / 2) with the apex e of the bulge.
Expression bulge_of(const TurningAtmosphere& atmosphere, std::span<const Expression> q,
                    const Expression& t) {
  const std::vector<Expression> s = time_values(atmosphere.sun, t);
  const Expression cosine(std::cos(atmosphere.lag));
  const Expression sine(std::sin(atmosphere.lag));
  const Expression inverse_distance = pow(dot(s, s), Expression(-0.5));
  const ExpressionVector apex = {(cosine * s[0] - sine * s[1]) * inverse_distance,
                                 (sine * s[0] + cosine * s[1]) * inverse_distance,
                                 s[2] * inverse_distance};
  const Expression share = (1 + dot(apex, q) * pow(dot(q, q), Expression(-0.5))) / 2;
  Expression bulge = share;
  for (int k = 2; k < atmosphere.exponent; k += 2) bulge *= share;
  return bulge;
}

}  // namespace

Expression SpacecraftCoefficient::in(std::span<const Expression> inputs,
                                     std::size_t degrees_of_freedom) const {
  return parameter ? inputs[2 * degrees_of_freedom + *parameter] : Expression(value);
}

DynamicalSystem with_thrust(const DynamicalSystem& system, const OrbitThrust& thrust) {
  return with_force(system, [&](std::span<const Expression> z) {
    const auto q = z.first(3), p = z.subspan(3, 3);
    const std::array<ExpressionVector, 3> axes = orbit_axes(q, p);
    std::vector<Expression> force(3, Expression(0));
    for (std::size_t k = 0; k < 3; ++k) {
      const Expression size = thrust.along[k].in(z, 3) * Expression(thrust.unit);
      for (std::size_t i = 0; i < 3; ++i) force[i] += size * axes[k][i];
    }
    return force;
  });
}

DynamicalSystem with_drag(const DynamicalSystem& system,
                          const std::shared_ptr<const TimeFunction>& axes,
                          const TurningAtmosphere& atmosphere, const SpacecraftCoefficient& B) {
  if (atmosphere.least == nullptr || axes == nullptr ||
      (atmosphere.greatest != nullptr && atmosphere.sun == nullptr)) {
    throw Error(ErrorKind::usage,
                "drag: needs the axes, a density, and the Sun where it has a bulge");
  }
  if (atmosphere.exponent <= 0 || atmosphere.exponent % 2 != 0) {
    throw Error(ErrorKind::usage, "drag: the exponent of the bulge must be even and positive");
  }
  return with_force(system, [&](std::span<const Expression> z) {
    const auto q = z.first(3), p = z.subspan(3, 3);
    const Expression& t = z.back();
    const std::vector<Expression> matrix = time_values(axes, t);
    const ExpressionVector fixed = turned(matrix, q);
    Expression density = field_value(atmosphere.least, fixed);
    if (atmosphere.greatest != nullptr) {
      const Expression more = field_value(atmosphere.greatest, fixed) - density;
      density += more * bulge_of(atmosphere, q, t);
    }
    // The third row of the matrix is the axis about which the air turns.
    const ExpressionVector v = {p[0] - atmosphere.rate * (matrix[7] * q[2] - matrix[8] * q[1]),
                                p[1] - atmosphere.rate * (matrix[8] * q[0] - matrix[6] * q[2]),
                                p[2] - atmosphere.rate * (matrix[6] * q[1] - matrix[7] * q[0])};
    const Expression braking =
        Expression(-0.5) * atmosphere.factor.in(z, 3) * B.in(z, 3) * density * sqrt(dot(v, v));
    return std::vector<Expression>{braking * v[0], braking * v[1], braking * v[2]};
  });
}

}  // namespace hamjet
