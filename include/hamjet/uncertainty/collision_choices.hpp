#pragma once

#include <array>
#include <string_view>

namespace hamjet {

/// How a probability of collision is found from samples of the polynomials.
enum class CollisionSampling {
  automatic,  ///< entries, where they can be drawn; else plain
  plain,      ///< deviations as they are distributed
  entries,    ///< deviations whose linear path enters a sphere somewhat larger, weighted
};

inline constexpr std::array<std::string_view, 3> collision_sampling_names = {"automatic", "plain",
                                                                             "entries"};

/// What counts as a collision in the window.
enum class CollisionEvent {
  nearer,  ///< that they are nearer than the radius at any time of the window
  entry,   ///< that they become nearer: those that are so when the window begins must come back
};

inline constexpr std::array<std::string_view, 2> collision_event_names = {"nearer", "entry"};

}  // namespace hamjet
