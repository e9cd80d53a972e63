#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drawn_scene.hpp"
#include "hamjet/studies/propagation.hpp"
#include "line_reference.hpp"

namespace hamjet::attack {

/// The results of hamjet for a scene, through its reader and its runner as the command uses them.
struct AttackedRun {
  int exit_code = 0;
  std::string message;  ///< the message of a refusal or a failure
  bool is_too_slow = false;
  double seconds = 0;
  std::optional<Scene> scene;  ///< the scene as it was read
  std::optional<PropagationResult> result;

  const RunResult& run() const { return result->runs.at(0); }
  /// Whether there is a jet to which the program raised no objection.
  bool is_unmarked() const { return exit_code == 0 && !is_too_slow; }
};

/// Gives up after `most_seconds`.
AttackedRun run_hamjet(const std::string& toml, double most_seconds);

/// The model in the canonical numbers of a scene that was read.
Model canonical_model(const Scene& scene, const Model& drawn);

/// A difference between the scene that was read and the attack's own reading of the scene's
/// numbers; empty if there is no difference beyond rounding.
std::string misread(const DrawnScene& drawn, const Scene& scene);

/// A direction in the variables of the jet's expansion. Its positions have the size of the
/// nominal's position, and its momenta that of the nominal's momentum (or of the motion's own
/// momentum if the nominal is at rest). In this way every variable counts alike in every unit.
std::vector<double> draw_direction(const Scene& scene, const Model& model, RandomNumbers& random);

/// A direction whose components are of size 1 in the scene's canonical units.
std::vector<double> draw_unit_direction(const Scene& scene, RandomNumbers& random);

/// A jet along a direction: for each degree, the sum of c_a d^a over the monomials of the degree.
struct JetAlongLine {
  std::vector<std::vector<DoubleDouble>> coefficients;  ///< [component of the model][degree]
  /// For each degree, the root of the sum of the squares of the terms of a component, in the sizes
  /// of the reference. It is the expected size of their sum along a line along which the terms
  /// neither cancel nor agree.
  std::vector<double> independent_sum;
  /// For each degree, in the same sizes, the largest product of a coefficient of a component and
  /// the largest position and momentum of the direction to the powers of the coefficient's
  /// monomial.
  std::vector<double> largest_term;
};
JetAlongLine along_line(const FlowJet<Extended>& jet, const ComputedProblem& problem,
                        const std::vector<double>& direction, const LineReference& reference);

/// Among several directions that `draw` gives, the one along which the terms of the highest degree
/// agree most. Errors that grow along the flow have one pattern in all coefficients: if the
/// coefficients cancel along a line, the errors do too.
std::vector<double> aligned_direction(const FlowJet<Extended>& jet, const ComputedProblem& problem,
                                      const std::function<std::vector<double>()>& draw);

/// Errors for each degree, relative to the largest of three numbers: the reference's coefficient;
/// the jet's independent sum, because the error along the line is a sum of the errors of the terms;
/// and the jet's largest term, because an error is promised relative to the largest coefficient of
/// its degree, which may contribute hardly anything along a direction. An error is 0 if all three
/// vanish.
struct RelativeErrors {
  std::vector<double> error;
  std::vector<double> uncertainty;  ///< uncertainty of the reference
  /// Rounding floor of double precision, see LineReference. It is larger if the terms of a jet
  /// cancel along the line, because each term is rounded separately.
  std::vector<double> floor;
};
RelativeErrors relative_errors(const JetAlongLine& jet, const LineReference& reference);

}  // namespace hamjet::attack
