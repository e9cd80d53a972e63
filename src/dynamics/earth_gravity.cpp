#include "hamjet/dynamics/earth_gravity.hpp"

#include <optional>
#include <span>
#include <vector>

#include "hamjet/error.hpp"
#include "turned_vectors.hpp"

namespace hamjet {
namespace {

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
  for (const FieldVariation& variation : gravity.variations) {
    require(variation.potential != nullptr, "a variation of the field needs its potential");
  }
  if (const auto& radiation = gravity.radiation) {
    require(radiation->potential != nullptr && radiation->sun != nullptr,
            "the radiation of the Sun needs its potential and its position");
  }
  const auto hamiltonian = [&gravity](std::span<const Expression> z) {
    const auto q = z.first(3), p = z.subspan(3, 3);
    const Expression& t = z.back();
    const std::vector<Expression> axes = time_values(gravity.axes, t);
    const ExpressionVector fixed = turned(axes, q);
    const auto seen_from = [&](const std::vector<Expression>& body) -> ExpressionVector {
      const ExpressionVector place = turned(axes, body);
      return {fixed[0] - place[0], fixed[1] - place[1], fixed[2] - place[2]};
    };
    Expression potential = field_value(gravity.potential, fixed);
    for (const FieldVariation& variation : gravity.variations) {
      const Expression change =
          variation.coefficient.in(z, 3) - Expression(variation.coefficient.value);
      potential += change * field_value(variation.potential, fixed);
    }
    potential *= gravity.scale.in(z, 3) * Expression(gravity.unit_of_scale);
    Expression others(0);
    for (const DisturbingBody& body : gravity.others) {
      const std::vector<Expression> s = time_values(body.position, t);
      potential += field_value(body.potential, seen_from(s));
      others -= Expression(body.mu) * pow(dot(s, s), Expression(-1.5)) * dot(q, s);
    }
    if (const auto& radiation = gravity.radiation) {
      Expression light = radiation->coefficient.in(z, 3);
      if (radiation->light != nullptr) light *= time_values(radiation->light, t)[0];
      potential -=
          light * field_value(radiation->potential, seen_from(time_values(radiation->sun, t)));
    }
    return std::vector<Expression>{dot(p, p) / 2 - potential - others};
  };
  DynamicalSystem system = make_system("earth", record(7 + gravity.parameters, hamiltonian, true),
                                       std::nullopt, gravity.parameters);
  system.waves_on_a_circle = gravity.potential->waves_on_a_circle();
  return system;
}

}  // namespace hamjet
