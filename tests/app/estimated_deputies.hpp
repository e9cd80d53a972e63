#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/deputy_evaluation.hpp"
#include "app/deputy_states.hpp"
#include "app/eval_coordinates.hpp"
#include "app/jet_evaluation.hpp"
#include "formats/jet_description.hpp"
#include "hamjet/error.hpp"
#include "studies/estimates/estimated_jets.hpp"

// Random deputies, in all coordinates of polynomials and frames of positions and in any units,
// whose estimated misses are compared with true ones; see deputy_states.hpp.

namespace hamjet::test {

struct DrawnDeputy {
  Scene scene;
  cli::EvalFrames frames;
  bool is_stored = false;       ///< whether a run's results are used
  std::array<double, 6> row{};  ///< the deviation in the frame, metres and m/s
};

/// The form of a deputy's numbers that the words of a frame mean.
inline DeputyFrame frame_of(const cli::EvalFrames& frames, const std::string& name) {
  return {name, frames.derivatives.value_or("rotating") == "rotating"};
}

/// Distance in metres between a final row and the deputy's true final state.
inline double true_miss_m(const DrawnDeputy& drawn, std::span<const double> row) {
  Numbers chief;
  for (std::size_t i = 0; i < 6; ++i) chief[i] = drawn.scene.nominal[i];
  const auto state_of = [&](const Numbers& about, const std::string& frame,
                            std::span<const double> numbers) {
    return deputy_state(frame_of(drawn.frames, frame), drawn.scene.units, about, numbers);
  };
  const Numbers deputy = state_of(chief, drawn.frames.frame, drawn.row);
  const Numbers end = true_end(drawn.scene, deputy);
  const Numbers told = state_of(true_end(drawn.scene, chief), drawn.frames.final_frame(), row);
  const Place miss = combined(1, position_of(told), -1, position_of(end));
  return convert<double>(sqrt(dot(miss, miss))) * drawn.scene.units.length_km * 1000;
}

/// A draw of words for frames; `row` is a deviation along inertial axes and becomes the deputy's
/// numbers in the frame.
inline void draw_frames(Draw& draw, DrawnDeputy& drawn) {
  constexpr const char* all[] = {"RTN",
                                 "RTN",
                                 "inertial",
                                 "curvilinear",
                                 "canonical",
                                 "relative-elements",
                                 "element-differences"};
  cli::EvalFrames& frames = drawn.frames;
  frames.frame = draw.of(all);
  if (frames.frame != "canonical" && draw.one_in(2)) {
    do {
      frames.to = draw.of(all);
    } while (*frames.to == "canonical");
  }
  if (frames.frame == "RTN" || frames.final_frame() == "RTN") {
    frames.derivatives = draw.one_in(2) ? "rotating" : "inertial";
  }
  // The numbers that a frame gives for the deviation are a draw too, because any numbers describe a
  // deputy.
  io::StoredJet chief;
  chief.model = drawn.scene.system.model;
  chief.units = drawn.scene.units;
  chief.nominal_initial = chief.nominal_final = drawn.scene.nominal;
  chief.variables = chief.components = drawn.scene.variables;
  const double length_m = drawn.scene.units.length_km * 1000;
  std::array<double, 6> canonical = drawn.row;
  for (std::size_t i = 0; i < 6; ++i) {
    canonical[i] /= i < 3 ? length_m : length_m / drawn.scene.units.time_s;
  }
  try {
    const auto row = cli::EvalCoordinates(chief, frames).initial_row(canonical);
    std::copy_n(row.begin(), 6, drawn.row.begin());
  } catch (const Error&) {  // some deviations have none
    frames = {"inertial", {}, {}};
  }
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
  draw_frames(draw, drawn);
  return drawn;
}

struct JudgedDeputy {
  double error_m = 0;
  cli::MissEstimate estimate;
  std::string coordinates;

  double ratio() const { return error_m / estimate.miss_m(); }
};

/// The numbers that polynomials of an integrated scene, or of a stored jet, give for a deputy.
template <class Evaluation>
JudgedDeputy told(const DrawnDeputy& drawn, const io::StoredJet& chief, Evaluation& evaluation) {
  const cli::EvalCoordinates coordinates(chief, drawn.frames);
  evaluation.add(coordinates.variables(drawn.row));
  JudgedDeputy judged;
  judged.coordinates = name_of(chief.coordinates);
  evaluation.run([&](const std::vector<double>& deviation, cli::MissEstimate estimate) {
    const auto end = coordinates.final_state(deviation, evaluation.chief_error(), estimate);
    judged.estimate = estimate;
    judged.error_m = true_miss_m(drawn, end);
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

/// A deputy's miss beside the estimate. There is no value if an end does not have the coordinates,
/// if no estimate is made because the deputy is beyond the polynomials' reach, or if the truth
/// cannot be followed.
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
  if (!judged || !judged->estimate.is_inside() || !std::isfinite(judged->error_m)) {
    return std::nullopt;
  }
  return judged;
}

/// A line that identifies the deputy.
inline std::string description(const DrawnDeputy& drawn, const JudgedDeputy& judged) {
  return drawn.scene.name + ": " + std::string(model_name(drawn.scene.system.model)) + ", order " +
         std::to_string(drawn.scene.order) + ", " + judged.coordinates +
         (drawn.is_stored ? " stored, " : ", ") + drawn.frames.frame +
         (drawn.frames.to ? " to " + *drawn.frames.to : "") + " " +
         drawn.frames.derivatives.value_or("");
}

}  // namespace hamjet::test
