#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "../algebra/signed_fraction.hpp"
#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

using Numbers = std::vector<Extended>;

/// The vector field at a point and time.
Numbers field_at(const DynamicalSystem& system, const Numbers& z, const Extended& time) {
  SliceEvaluator<Extended, Extended> field(system.vector_field, SeriesSpace::create(1, 0), 0);
  field.set_time(time);
  for (std::size_t i = 0; i < z.size(); ++i) *field.input(i) = z[i];
  field.evaluate_constant_terms();
  Numbers result;
  for (std::size_t i = 0; i < z.size(); ++i) result.push_back(*field.output(i));
  return result;
}

Numbers rotated(Numbers z, const std::vector<std::array<std::size_t, 2>>& planes,
                const Extended& cosine, const Extended& sine) {
  for (const auto& [i, j] : planes) {
    const Extended first = cosine * z[i] - sine * z[j];
    z[j] = sine * z[i] + cosine * z[j];
    z[i] = first;
  }
  return z;
}

bool are_finite(const Numbers& z) {
  return std::all_of(z.begin(), z.end(), [](const Extended& x) { return isfinite(x); });
}

/// A rotation by an angle, during which some time passes.
struct Turn {
  Extended angle;
  Extended time_before;
  Extended time_after;
};

/// The largest change of the field when the points and the field are rotated together, relative to
/// the field; no value where the field is not finite.
std::optional<Extended> largest_change(const DynamicalSystem& system,
                                       const std::vector<std::array<std::size_t, 2>>& planes,
                                       const Numbers& z, const Turn& turn) {
  const Extended cosine = cos(turn.angle);
  const Extended sine = sin(turn.angle);
  const Numbers first = rotated(field_at(system, z, turn.time_before), planes, cosine, sine);
  const Numbers last = field_at(system, rotated(z, planes, cosine, sine), turn.time_after);
  if (!are_finite(first) || !are_finite(last)) return std::nullopt;
  Extended change = 0;
  Extended size = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    change = std::max(change, Extended(abs(first[i] - last[i])));
    size = std::max(size, Extended(abs(first[i])));
  }
  return size > 0 ? Extended(change / size) : change;
}

/// The planes of positions, and those of their momenta. Throws Error(usage) for indices that are
/// out of range or repeated.
std::vector<std::array<std::size_t, 2>> planes_of_phase_space(
    const DynamicalSystem& system, const std::vector<std::array<std::size_t, 2>>& positions) {
  const std::size_t n = system.degrees_of_freedom;
  std::vector<bool> is_turned(n, false);
  std::vector<std::array<std::size_t, 2>> planes = positions;
  for (const auto& [i, j] : positions) {
    for (const std::size_t k : {i, j}) {
      if (k >= n || is_turned[k]) {
        throw Error(ErrorKind::usage,
                    fmt::format("rotation of system '{}': the position {} is out of range or "
                                "stands twice, must be from 0 to {} and there once",
                                system.name, k, n - 1));
      }
      is_turned[k] = true;
    }
    planes.push_back({n + i, n + j});
  }
  return planes;
}

/// Tries a rotation at a few random points; `draw_turn(draw)` makes a rotation from random numbers.
template <class DrawTurn>
void try_rotation(const DynamicalSystem& system,
                  const std::vector<std::array<std::size_t, 2>>& planes,
                  const DrawTurn& draw_turn) {
  constexpr int wanted_points = 4;
  constexpr int most_points = 100;
  // Rounding in a field of some hundred operations is smaller than this. A field whose asymmetry
  // shows in a double at all changes by far more.
  const Extended allowed = 1e4 * std::numeric_limits<Extended>::epsilon();
  std::mt19937_64 random(20261123);
  const auto draw = [&] { return Extended(signed_fraction(random)); };
  int points = 0;
  for (int i = 0; i < most_points && points < wanted_points; ++i) {
    Numbers z(system.dimension());
    for (Extended& x : z) x = draw();
    const auto change = largest_change(system, planes, z, draw_turn(draw));
    if (!change) continue;
    ++points;
    if (*change > allowed) {
      throw Error(ErrorKind::usage,
                  fmt::format("rotation of system '{}': its vector field changes by {:.2g} of "
                              "itself at a random point, must stay as it is",
                              system.name, static_cast<double>(*change)));
    }
  }
  if (points < wanted_points) {
    throw Error(ErrorKind::usage,
                fmt::format("rotation of system '{}': its vector field is not finite at most "
                            "random points between -1 and 1, so that it cannot be judged",
                            system.name));
  }
}

}  // namespace

DynamicalSystem with_rotation(DynamicalSystem system,
                              std::vector<std::array<std::size_t, 2>> planes_of_positions) {
  system.rotated_planes = planes_of_phase_space(system, planes_of_positions);
  try_rotation(system, system.rotated_planes, [&](const auto& draw) {
    const Extended time = system.is_autonomous() ? Extended(0) : draw();
    return Turn{1, time, time};
  });
  return system;
}

DynamicalSystem with_uniform_rotation(DynamicalSystem system, UniformRotation rotation) {
  const auto planes = planes_of_phase_space(system, rotation.planes);
  try_rotation(system, planes, [&](const auto& draw) {
    // The field turns by about a radian.
    const Extended time = draw();
    const Extended angle = draw();
    return Turn{angle, time, rotation.rate == 0 ? time : Extended(time + angle / rotation.rate)};
  });
  system.uniform_rotation = std::move(rotation);
  return system;
}

}  // namespace hamjet
