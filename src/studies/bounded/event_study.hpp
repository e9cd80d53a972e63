#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/detail/studies/self_checks.hpp"
#include "hamjet/dynamics/expression_text.hpp"
#include "hamjet/poincare/event_map.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// How far deputies that were flown with the full equations to the time that polynomials give are
/// from where these have them: the largest of several with deviations of one size; none where one
/// of them could not be flown, or has a time far from the chief's.
struct EventMisses {
  double amplitude_m = 0;
  std::optional<double> position_m;
  std::optional<double>
      time_s;  ///< difference of the polynomials' time from that of the flown event
  // The same of the linear polynomials.
  std::optional<double> linear_position_m;
  std::optional<double> linear_time_s;
};

/// An event of a scene's chief, and those of its neighbours as polynomials.
struct EventStudy {
  Scene scene;  ///< with three coordinates, see with_free_coordinates
  EventMap<double> map;
  double position_rounding_m = 0;   ///< rounding of a flown position: a smaller miss says nothing
  int flown = 0;                    ///< deputies of each amplitude
  std::vector<EventMisses> misses;  ///< by amplitude, as in the scene
  std::vector<SelfCheck> checks = {};  ///< checks of the chief's flight to the event

  double time_s() const { return map.time[0] * scene.units.time_s; }
  std::vector<double> state() const;  ///< the chief's state at the event, canonical
  EventMap<double> told_map() const;  ///< in the units that the user is told, see told_units
};

/// The text of a condition that is an expression of a system's variables.
FunctionText event_function(const SystemSettings& system, const std::string& expression);

/// The condition of a scene's event.
EventCondition<double> event_condition(const Scene& scene);

/// Finds the scene's event and its polynomials to the scene's order, and flies deputies. Throws
/// Error(scene) where the chief does not meet that many events within the duration, and
/// Error(numerical) where its orbit only touches the surface; and as integrate_gauss.
EventStudy study_event(const Scene& scene, const ProgressCallback& progress = {});

}  // namespace hamjet
