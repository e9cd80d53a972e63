#pragma once

#include <string>
#include <vector>

#include "attacked_run.hpp"
#include "judge.hpp"

// Two scenes that should give the same result: the same motion in another unit of length, in one
// piece, to a lower order, in fewer variables, with its rotation integrated, with zeros written
// out, in another precision, and by the command instead of the library.

namespace hamjet::attack {

struct Variation {
  enum class Kind { none, unit, unsplit, order, variables, symmetry, zeros, precision, command };
  Kind kind = Kind::none;
  std::string name;
  DrawnScene drawn;  ///< the other scene
};

/// Draws a variation that the scene admits; no value if the scene admits none of the drawn ones.
Variation draw_variation(const DrawnScene& drawn, RandomNumbers& random);

/// A line along which a run was compared with its reference.
struct JudgedLine {
  std::vector<double> direction;
  LineReference reference;
  JetAlongLine jet;
  RelativeErrors errors;
};

std::vector<Finding> judge_variation(const Variation& variation, const DrawnScene& drawn,
                                     const AttackedRun& attacked,
                                     const std::vector<JudgedLine>& lines,
                                     const JudgeSettings& settings);

}  // namespace hamjet::attack
