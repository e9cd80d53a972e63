#pragma once

#include <optional>
#include <string>
#include <vector>

#include "attacked_run.hpp"
#include "drawn_scene.hpp"

namespace hamjet::attack {

/// A wrong result without a mark.
struct Finding {
  std::string rule;  ///< the rule that is broken
  int degree = -1;   ///< -1 if the finding does not belong to a degree
  double value = 0;  ///< for example a relative error
  double allowed = 0;
  std::string words;  ///< a description of what the numbers do not say
};

/// The outcome for one scene.
struct Verdict {
  enum class Outcome {
    right,
    wrong,
    marked,   ///< a check or the computation failed
    refused,  ///< refused with a message, before any work
    skipped,  ///< too slow for hamjet or for the reference
  };
  Outcome outcome = Outcome::right;
  std::vector<Finding> findings;
  std::string
      message;  ///< message of hamjet's failure or refusal, or the reason why the scene was skipped
  double largest_error = 0;
  /// The largest ratio of a degree's error to hamjet's own estimate of it.
  std::optional<double> estimate_ratio;
  /// A marked run of an adaptive Gauss method whose errors keep the promise.
  bool is_false_alarm = false;
  double largest_uncertainty = 0;  ///< largest relative uncertainty of the reference
  double hamjet_seconds = 0;
  double reference_seconds = 0;
  std::string variation;  ///< the variation that was run, if any
  double variation_seconds = 0;
};

struct JudgeSettings {
  int directions = 2;
  double most_seconds = 20;  ///< time limit of one run of hamjet
  double variations = 0.5;   ///< fraction of the scenes for which a variation is run too
  std::string command = {};  ///< path of the hamjet program; if empty, the program is not run
  bool is_talkative = false;
};

/// Runs a scene and compares it, degree by degree, with the independent integration. For some
/// scenes it then runs a variation that should not change the result, see variations.hpp.
Verdict judge(const DrawnScene& drawn, const JudgeSettings& settings);

/// Whether a relative error is promised. It is promised for adaptive Gauss methods up to an
/// eccentricity of 0.95. Beyond, an error that hamjet estimates itself is not a silent one.
bool has_promise(const DrawnScene& drawn);

/// The promise of adaptive Gauss methods: the relative error of every degree is at most 100 times
/// the tolerance in each revolution, plus ten floors of the scene's precision with as many
/// roundings as the run has steps.
double promised_error(const DrawnScene& drawn, const AttackedRun& attacked,
                      const LineReference& reference, double floor);

/// A floor is a sample with one rounding in each step of the reference. Roundings add up as a
/// random walk does, so that the rounding of a run with more steps is larger by this factor.
double rounding_walk(const AttackedRun& attacked, const LineReference& reference);

/// An estimate may be below the error by this factor in one of a hundred scenes, and may be below
/// it by `worst_estimate` in no scene.
inline constexpr double good_estimate = 10;
inline constexpr double worst_estimate = 100;

/// The floor of a scene's precision from that of double precision.
double floor_of(const DrawnScene& drawn, double floor);

}  // namespace hamjet::attack
