#pragma once

#include <optional>

#include "hamjet/uncertainty/collision_choices.hpp"
#include "relative_paths.hpp"
#include "sampled_paths.hpp"

namespace hamjet {

/// The path of a deviation to first order.
void take_linear_path(const RelativePaths& paths, const EncounterDeviation& deviation,
                      SampledPath& path);

/// When a path first has what counts as a collision, if it ever has.
std::optional<double> first_event(const RelativePaths& paths, const SampledPath& path,
                                  double radius, CollisionEvent event);

/// What is known of a path whose distances are right to an error.
struct Judgement {
  std::optional<double> first;  ///< when it first has the event, as it is told
  bool is_sure = false;         ///< it has it for a radius that is smaller by the error, too
  bool is_possible = false;     ///< it has it for one that is larger
};
Judgement judge_path(const RelativePaths& paths, const SampledPath& path, double radius,
                     double error, CollisionEvent event);

}  // namespace hamjet
