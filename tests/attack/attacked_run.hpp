#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drawn_scene.hpp"
#include "hamjet/studies/propagation.hpp"
#include "line_reference.hpp"

namespace hamjet::attack {

/// What hamjet made of a scene, through its reader and its runner as the command does.
struct AttackedRun {
  int exit_code = 0;
  std::string message;  ///< of a refusal or a failure
  bool is_too_slow = false;
  double seconds = 0;
  std::optional<Scene> scene;  ///< as read
  std::optional<PropagationResult> result;

  const RunResult& run() const { return result->runs.at(0); }
  /// Whether there is a jet that nothing was said against.
  bool is_unmarked() const { return exit_code == 0 && !is_too_slow; }
};

/// Gives up after `most_seconds`.
AttackedRun run_hamjet(const std::string& toml, double most_seconds);

/// The model in the canonical numbers of a scene that was read.
Model canonical_model(const Scene& scene, const Model& drawn);

/// A difference of what was read from what the attack itself makes of the scene's numbers; empty if
/// there is none beyond the rounding.
std::string misread(const DrawnScene& drawn, const Scene& scene);

/// A direction in the variables that the jet is expanded in, its positions of the size of the
/// nominal's position and its momenta of that of the nominal's momentum (or the motion's own, where
/// the nominal is at rest): then every variable counts alike, in every unit.
std::vector<double> draw_direction(const Scene& scene, const Model& model, RandomNumbers& random);

/// A direction whose components are of size 1 in the scene's canonical units.
std::vector<double> draw_unit_direction(const Scene& scene, RandomNumbers& random);

/// A jet along a direction: by degree the sum of c_a d^a over the monomials of that degree.
struct JetAlongLine {
  std::vector<std::vector<DoubleDouble>> coefficients;  ///< [component of the model][degree]
  /// By degree, in the sizes of the reference, the root of the sum of the squares of the terms of a
  /// component: what their sum is along a line where they neither cancel nor agree.
  std::vector<double> independent_sum;
  /// By degree, in the same sizes, the largest coefficient of a component times the largest
  /// position and momentum of the direction to the powers of its monomial.
  std::vector<double> largest_term;
};
JetAlongLine along_line(const FlowJet<Extended>& jet, const ComputedProblem& problem,
                        const std::vector<double>& direction, const LineReference& reference);

/// Of several directions that `draw` gives, the one along which the terms of the highest degree
/// agree most. Errors that grow along the flow have one pattern in all coefficients, and where
/// these cancel along a line, they do too.
std::vector<double> aligned_direction(const FlowJet<Extended>& jet, const ComputedProblem& problem,
                                      const std::function<std::vector<double>()>& draw);

/// By degree, relative to the largest of the reference's coefficient, the jet's independent sum, as
/// the error along the line is a sum of the errors of the terms, and its largest term, as an error
/// is promised relative to the largest coefficient of its degree, which a direction may hardly see;
/// 0 where all vanish.
struct RelativeErrors {
  std::vector<double> error;
  std::vector<double> uncertainty;  ///< of the reference
  /// Of double precision, see LineReference; larger where the terms of a jet cancel along the line,
  /// for each is rounded by itself.
  std::vector<double> floor;
};
RelativeErrors relative_errors(const JetAlongLine& jet, const LineReference& reference);

}  // namespace hamjet::attack
