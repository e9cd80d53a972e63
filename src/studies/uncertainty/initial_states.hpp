#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/studies/scene.hpp"
#include "hamjet/uncertainty/covariance.hpp"
#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet {

/// One spacecraft's distribution at the start.
struct InitialState {
  std::string name;     ///< "chief", "deputy", "deputy 2", ...
  Vector<double> mean;  ///< canonical deviation from the chief's nominal
  /// Covariance of linear canonical deviations from the mean and, behind them, of parameters from
  /// their nominal values.
  Covariance covariance;
  /// For a start that is Gaussian in elements: the deviations to which linear ones belong.
  std::optional<StraightDeviations> straight = {};
  std::string why_straight = {};  ///< why `auto` chose elements, as a sentence for people
  /// The parameters behind the six numbers: first those that all spacecraft share, of which each
  /// has a column of its own at the beginning of the covariance's factor.
  std::vector<std::string> parameters = {};
  Eigen::Index common = 0;  ///< number of parameters that all spacecraft share

  bool is_chief() const { return name == "chief"; }
  /// The deviation from the chief's nominal that belongs to a linear one from the mean, with that
  /// of the parameters, if there are some.
  Vector<double> deviation(const Vector<double>& linear) const;
};

/// The distributions of the chief and of the deputy, as far as the scene has them, with the errors
/// of the burn in the one that it belongs to. If a burn ended early, only a fraction was done: the
/// rest of its velocity change is missing, and its errors are smaller in proportion. Throws
/// Error(scene) for a start that is to be Gaussian in elements and has none.
std::vector<InitialState> initial_states(const Scene& scene, double burn_share = 1);

/// A spacecraft relative to the chief in the frame of the scene's deputy, with the uncertainty of
/// that deputy, without a burn.
InitialState initial_deputy(const Scene& scene, const RelativeState& start);

/// The equations of motion of the chief, and those of deputies with other C_D A / m or C_R A / m,
/// which are made once for all encounters of a scene.
struct EncounterSystems {
  explicit EncounterSystems(const Scene& scene);

  SharedSystem chief;
  SharedSystem unlike_deputies;  ///< none where deputies are like the chief
};

/// An encounter in the chief's field and at the scene's order, still without its spacecraft; the
/// window and the radius are canonical. The jets of both spacecraft have a tolerance of their own,
/// whatever integrates the scene's.
EncounterProblem empty_encounter(const Scene& scene, const SharedSystem& chief, double from,
                                 double to, double radius);

/// The spacecraft of this start as one of the two of an encounter.
UncertainSpacecraft uncertain_spacecraft(const Scene& scene, const EncounterSystems& systems,
                                         const InitialState& start);

}  // namespace hamjet
