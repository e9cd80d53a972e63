#include "hamjet/dynamics/earth_gravity.hpp"

#include <array>
#include <span>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

using Vector3 = std::array<Expression, 3>;

/// The product of a matrix, row after row, and a vector.
Vector3 turned(const std::vector<Expression>& matrix, std::span<const Expression> v) {
  Vector3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = matrix[3 * i] * v[0] + matrix[3 * i + 1] * v[1] + matrix[3 * i + 2] * v[2];
  }
  return result;
}

Expression dot(std::span<const Expression> a, std::span<const Expression> b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void require(bool is_right, const char* problem) {
  if (!is_right)
    throw Error(ErrorKind::usage, std::string("gravity of a turning body: ") + problem);
}

}  // namespace

DynamicalSystem earth_gravity(const GravityOfTurningBody& gravity) {
  require(
      gravity.potential != nullptr && gravity.axes != nullptr && gravity.axes->components() == 9,
      "needs a potential and the nine components of its axes");
  for (const DisturbingBody& body : gravity.others) {
    require(
        body.potential != nullptr && body.position != nullptr && body.position->components() == 3,
        "a disturbing body needs a potential and the three components of its position");
  }
  const auto hamiltonian = [&gravity](std::span<const Expression> q, std::span<const Expression> p,
                                      const Expression& t) {
    const std::vector<Expression> axes = time_values(gravity.axes, t);
    const Vector3 fixed = turned(axes, q);
    Expression potential = field_value(gravity.potential, fixed);
    Expression others(0);
    for (const DisturbingBody& body : gravity.others) {
      const std::vector<Expression> s = time_values(body.position, t);
      const Vector3 place = turned(axes, s);
      potential += field_value(body.potential,
                               {fixed[0] - place[0], fixed[1] - place[1], fixed[2] - place[2]});
      others -= Expression(body.mu) * pow(dot(s, s), Expression(-1.5)) * dot(q, s);
    }
    return dot(p, p) / 2 - potential - others;
  };
  DynamicalSystem system = make_system("earth", 3, hamiltonian);
  system.waves_on_a_circle = gravity.potential->waves_on_a_circle();
  return system;
}

}  // namespace hamjet
