#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "driven_scenes.hpp"
#include "dynamics/fields/point_mass_field.hpp"
#include "studies/flights/flight_arcs.hpp"

namespace hamjet {
namespace {

using test::apart;

// Expected: circles of the radii 1 and 1.1 about a point mass, in closed form. Its polynomials in
// time end at a lower power than those of a written force.
TEST(FieldArcs, EndAtTheirPower) {
  const auto field = std::make_shared<const PointMassField>(1.0);
  const auto system = SharedSystem(make_system(
      "point mass", 3,
      [&](std::span<const Expression> q, std::span<const Expression> p, const Expression&) {
        return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / 2 -
               field_value(field, {q[0], q[1], q[2]});
      }));
  const auto on_circle = [](double radius, double time) {
    const double rate = std::pow(radius, -1.5), angle = rate * time;
    const double c = radius * std::cos(angle), s = radius * std::sin(angle);
    return std::vector<double>{c, s, 0, -rate * s, rate * c, 0};
  };
  int arcs = 0;
  fly_arcs(system, {on_circle(1, 0), on_circle(1.1, 0)}, ClockTime::epoch(), 5,
           [&](const FlightArc& arc) {
             for (const double share : {0.4, 1.0}) {
               EXPECT_LT(apart(arc.state(0, share), on_circle(1, arc.time_at(share))), 1e-12);
               EXPECT_LT(apart(arc.state(1, share), on_circle(1.1, arc.time_at(share))), 1e-12);
             }
             ++arcs;
           });
  EXPECT_GT(arcs, 1);
}

}  // namespace
}  // namespace hamjet
