#pragma once

#include <optional>

#include "hamjet/uncertainty/collision_choices.hpp"
#include "relative_paths.hpp"
#include "sampled_paths.hpp"

namespace hamjet {

/// The path of a deviation to first order.
void take_linear_path(const RelativePaths& paths, const EncounterDeviation& deviation,
                      SampledPath& path);

/// Whether a path counts as a collision.
bool has_event(const RelativePaths& paths, const SampledPath& path, double radius,
               CollisionEvent event);

/// The judgement of a path whose distances have a known error.
struct Judgement {
  std::optional<double> first;  ///< time of the first event, with the distances as computed
  bool is_sure = false;      ///< the event also happens with a radius that is smaller by the error
  bool is_possible = false;  ///< the event happens with a radius that is larger by the error
};
Judgement judge_path(const RelativePaths& paths, const SampledPath& path, double radius,
                     double error, CollisionEvent event);

}  // namespace hamjet
