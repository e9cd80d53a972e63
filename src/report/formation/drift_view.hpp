#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "hamjet/detail/studies/relative_drift.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/studies/scene.hpp"

// How a deputy that is left to itself moves away along the track.

namespace hamjet::io {

/// A sentence about the scene's deputy in this state, along the axes of the frame: what it drifts,
/// and the velocity that would hold it; `where` may add " at its end". Empty where there is no
/// drift to tell of.
std::string drift_text(const Scene& scene, const std::optional<RelativeDrift>& drift,
                       const RelativeState& state, RelativeFrame frame,
                       std::string_view where = "");

/// Three numbers for people, "[0, 0.286157, 0]", as a scene takes them; what is rounding beside the
/// largest of them, and beside `scale`, is 0.
std::string vector_text(const Eigen::Vector3d& vector, int digits, double scale = 0);

/// The relative orbital elements by their names in scenes, "da_m -0.5, ..."; empty where there are
/// none.
std::string elements_text(const std::optional<RelativeDrift>& drift);

/// The members of a state that tell of its drift: `drift_m_per_revolution`,
/// `period_difference_s`, `velocity_without_drift_m_s`, `relative_elements_m`; null where they were
/// not found.
void add_drift(nlohmann::ordered_json& json, const std::optional<RelativeDrift>& drift,
               const RelativeState& state);

}  // namespace hamjet::io
