#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "app/deputy_evaluation.hpp"
#include "app/eval_coordinates.hpp"
#include "app/jet_evaluation.hpp"
#include "formats/jet_description.hpp"
#include "hamjet/error.hpp"
#include "poincare/independent_flight.hpp"
#include "studies/estimated_jets.hpp"
#include "support/kepler_ellipse.hpp"

// Random deputies, in all coordinates of polynomials and frames of positions and in any units,
// whose estimated misses are compared with true ones: on ellipses from their closed form, about
// oblate bodies from flights in long double through an acceleration that is written by hand. Frames
// are written by hand too.

namespace hamjet::test {

using Numbers = std::array<Extended, 6>;

struct DrawnDeputy {
  Scene scene;
  cli::EvalFrames frames;
  bool is_stored = false;       ///< by the results of a run
  std::array<double, 6> row{};  ///< the deviation in the frame, metres and m/s
};

/// Axes R, T, N by rows, of a state.
inline std::array<std::array<Extended, 3>, 3> axes_of(const Numbers& z) {
  const Extended r = sqrt(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
  std::array<Extended, 3> h = {z[1] * z[5] - z[2] * z[4], z[2] * z[3] - z[0] * z[5],
                               z[0] * z[4] - z[1] * z[3]};
  const Extended size = sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
  for (Extended& x : h) x /= size;
  const std::array<Extended, 3> radial = {z[0] / r, z[1] / r, z[2] / r};
  const std::array<Extended, 3> along = {h[1] * radial[2] - h[2] * radial[1],
                                         h[2] * radial[0] - h[0] * radial[2],
                                         h[0] * radial[1] - h[1] * radial[0]};
  return {radial, along, h};
}

/// |r x v| / r^2 of a state.
inline Extended rate_of(const Numbers& z) {
  const Extended x = z[1] * z[5] - z[2] * z[4];
  const Extended y = z[2] * z[3] - z[0] * z[5];
  const Extended w = z[0] * z[4] - z[1] * z[3];
  return sqrt(x * x + y * y + w * w) / (z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
}

inline bool is_in_axes_of_chief(const cli::EvalFrames& frames) { return frames.frame == "RTN"; }

/// The deputy's state at the start, from the row.
inline Numbers deputy_at_start(const DrawnDeputy& drawn, const Numbers& chief) {
  const Extended length_m = Extended(drawn.scene.units.length_km) * 1000;
  const Extended speed_m_s = length_m / Extended(drawn.scene.units.time_s);
  Numbers x;
  for (std::size_t i = 0; i < 6; ++i) x[i] = drawn.row[i] / (i < 3 ? length_m : speed_m_s);
  Numbers z = chief;
  if (!is_in_axes_of_chief(drawn.frames)) {
    for (std::size_t i = 0; i < 6; ++i) z[i] += x[i];
    return z;
  }
  if (drawn.frames.derivatives == "rotating") {
    const Extended rate = rate_of(chief);
    x[3] -= rate * x[1];
    x[4] += rate * x[0];
  }
  const auto axes = axes_of(chief);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      z[i] += axes[k][i] * x[k];
      z[i + 3] += axes[k][i] * x[k + 3];
    }
  }
  return z;
}

/// Where a state comes to; flown in units of the start's distance.
inline Numbers true_end(const Scene& scene, const Numbers& z) {
  if (scene.system.model == SystemModel::kepler) {
    return along_ellipse(z, Extended(scene.duration));
  }
  const double r = std::hypot(scene.nominal[0], scene.nominal[1], scene.nominal[2]);
  const auto length = static_cast<long double>(r);
  const long double speed = 1 / std::sqrt(length);
  ZonalGravity field{1, 0, scene.system.J};
  field.radius = scene.canonical_radius / r;
  IndependentFlight::State state;
  for (std::size_t i = 0; i < 6; ++i) {
    state[i] = static_cast<long double>(z[i]) / (i < 3 ? length : speed);
  }
  state = IndependentFlight(field, 2e-18L)(
      state, static_cast<long double>(scene.duration) / (length * std::sqrt(length)));
  Numbers end;
  for (std::size_t i = 0; i < 6; ++i) end[i] = Extended(state[i] * (i < 3 ? length : speed));
  return end;
}

/// The final position in the frame, metres.
inline std::array<double, 3> true_position(const DrawnDeputy& drawn) {
  Numbers chief;
  for (std::size_t i = 0; i < 6; ++i) chief[i] = drawn.scene.nominal[i];
  const Numbers end = true_end(drawn.scene, deputy_at_start(drawn, chief));
  const Numbers chief_end = true_end(drawn.scene, chief);
  const auto axes = axes_of(chief_end);
  std::array<double, 3> result{};
  for (std::size_t k = 0; k < 3; ++k) {
    Extended sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Extended unit = is_in_axes_of_chief(drawn.frames) ? axes[k][i] : Extended(i == k);
      sum += unit * (end[i] - chief_end[i]);
    }
    result[k] = static_cast<double>(sum * Extended(drawn.scene.units.length_km) * 1000);
  }
  return result;
}

/// The deputy of a seed.
inline DrawnDeputy drawn_deputy(std::uint64_t seed) {
  Draw draw(seed);
  DrawnDeputy drawn;
  Scene& scene = drawn.scene;
  scene.name = scene.title = "deputy-" + std::to_string(seed);
  const bool is_kepler = !draw.one_in(3);
  const double period = draw_orbit(draw, scene, is_kepler);
  scene.order = draw.whole(2, 5);
  scene.duration = period * draw.decades(0.02, is_kepler ? 30 : 3);
  if (draw.one_in(8)) scene.duration = -scene.duration;
  constexpr JetCoordinates all[] = {JetCoordinates::cartesian,   JetCoordinates::spherical,
                                    JetCoordinates::cylindrical, JetCoordinates::poincare,
                                    JetCoordinates::nodal,       JetCoordinates::flow_box,
                                    JetCoordinates::flow_box};
  scene.coordinates = draw.of(all);
  if (draw.one_in(12)) scene.coordinates = JetCoordinates::automatic;
  draw_gauss(draw, scene, period, false);
  if (draw.one_in(2)) scene.integrators[0].tolerance = 1e-13;
  drawn.is_stored = draw.one_in(3) && scene.coordinates != JetCoordinates::automatic;
  const int frame = draw.whole(0, 2);
  drawn.frames.frame = frame == 2 ? "inertial" : "RTN";
  if (frame != 2) drawn.frames.derivatives = frame == 0 ? "rotating" : "inertial";
  const double length_m = scene.units.length_km * 1000;
  const double r = std::hypot(scene.nominal[0], scene.nominal[1], scene.nominal[2]) * length_m;
  const double v = std::hypot(scene.nominal[3], scene.nominal[4], scene.nominal[5]) * length_m /
                   scene.units.time_s;
  const double size = draw.decades(1e-8, 0.3);
  const int kind = draw.whole(0, 2);  // position alone, velocity alone, both
  for (std::size_t i = 0; i < 6; ++i) {
    const double x = draw.between(-1, 1) * size;
    if (i < 3 && kind != 1) drawn.row[i] = r * x;
    if (i >= 3 && kind != 0) drawn.row[i] = v * x;
  }
  return drawn;
}

struct JudgedDeputy {
  double error_m = 0;
  cli::MissEstimate estimate;
  std::string coordinates;

  double ratio() const { return error_m / estimate.miss_m(); }
};

/// What is told of a deputy by polynomials of an integrated scene, or of a stored jet.
template <class Evaluation>
JudgedDeputy told(const DrawnDeputy& drawn, const io::StoredJet& chief, Evaluation& evaluation) {
  const cli::EvalCoordinates coordinates(chief, drawn.frames);
  evaluation.add(coordinates.variables(drawn.row));
  JudgedDeputy judged;
  judged.coordinates = name_of(chief.coordinates);
  evaluation.run([&](const std::vector<double>& deviation, cli::MissEstimate estimate) {
    estimate.integration_m += coordinates.turned_m(deviation, evaluation.chief_error());
    judged.estimate = estimate;
    const std::vector<double> row = coordinates.final_state(deviation);
    const std::array<double, 3> right = true_position(drawn);
    judged.error_m = std::hypot(row[0] - right[0], row[1] - right[1], row[2] - right[2]);
  });
  return judged;
}

inline std::optional<io::StoredJet> stored_of(const Scene& scene) {
  const PropagationResult result = propagate(scene);
  const RunResult& run = result.runs.front();
  if (!run.failure.empty()) return std::nullopt;
  if (scene.coordinates == JetCoordinates::cartesian) {
    io::StoredJet stored = io::describe_jet(result, run);
    stored.jet = run.jet;
    return stored;
  }
  if (!run.charted || !run.charted->failure.empty()) return std::nullopt;
  io::StoredJet stored = io::describe_charted_jet(result, run);
  stored.jet = run.charted->jet;
  return stored;
}

/// A deputy's miss beside the estimate; none where an end has not such coordinates, or where no
/// estimate is made: beyond the polynomials' reach.
inline std::optional<JudgedDeputy> judged_deputy(const DrawnDeputy& drawn) {
  std::optional<JudgedDeputy> judged;
  try {
    if (!drawn.is_stored) {
      const cli::EvaluatedScene scene = cli::evaluated_scene(drawn.scene);
      cli::DeputyEvaluation evaluation(scene, drawn.scene.order, 1);
      judged = told(drawn, scene.chief, evaluation);
      judged->coordinates = name_of(scene.coordinates);
    } else if (const auto stored = stored_of(drawn.scene)) {
      if (stored->coordinates == JetCoordinates::cartesian) {
        cli::JetEvaluation evaluation(*stored, std::nullopt);
        judged = told(drawn, *stored, evaluation);
      } else {
        const cli::EvaluatedScene scene = cli::evaluated_jet(*stored);
        cli::DeputyEvaluation evaluation(scene, drawn.scene.order, 1);
        judged = told(drawn, scene.chief, evaluation);
      }
    }
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::usage) throw;
    return std::nullopt;
  }
  if (!judged || !judged->estimate.is_inside()) return std::nullopt;
  return judged;
}

/// A line that says which deputy it was.
inline std::string description(const DrawnDeputy& drawn, const JudgedDeputy& judged) {
  return drawn.scene.name + ": " + std::string(model_name(drawn.scene.system.model)) + ", order " +
         std::to_string(drawn.scene.order) + ", " + judged.coordinates +
         (drawn.is_stored ? " stored, " : ", ") + drawn.frames.frame + " " +
         drawn.frames.derivatives.value_or("");
}

}  // namespace hamjet::test
