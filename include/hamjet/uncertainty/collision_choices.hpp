#pragma once

#include <array>
#include <string_view>

namespace hamjet {

/// How a probability of collision is found from samples of the polynomials.
enum class CollisionSampling {
  automatic,  ///< `entries`, where such deviations can be drawn; otherwise `plain`
  plain,      ///< deviations drawn from their own distribution
  entries,  ///< deviations whose linear path enters a sphere somewhat larger than the radius, with
            ///< weights
};

inline constexpr std::array<std::string_view, 3> collision_sampling_names = {"automatic", "plain",
                                                                             "entries"};

/// What counts as a collision in the window.
enum class CollisionEvent {
  nearer,  ///< the spacecraft are nearer than the radius at some time of the window
  entry,   ///< the spacecraft become nearer than the radius: a pair that is so when the window
           ///< begins must leave and return
};

inline constexpr std::array<std::string_view, 2> collision_event_names = {"nearer", "entry"};

}  // namespace hamjet
