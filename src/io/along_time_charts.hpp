#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chart.hpp"
#include "hamjet/maps/generating_function_kind.hpp"
#include "hamjet/studies/run_along_time.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet::io {

/// "F1 (qqq-qqq)", or the notation alone.
std::string kind_text(const GeneratingFunctionKind& kind);

/// The figure of Guibout and Bloch, with the times at which the kind does not exist. Not fitted.
Chart exactness_along_time_chart(const Scene& scene,
                                 const std::optional<GeneratingFunctionKind>& kind,
                                 const std::vector<RunAlongTime>& runs);

/// The energy error of the nominal along time. Not fitted.
Chart energy_along_time_chart(const Scene& scene, const std::vector<RunAlongTime>& runs);

}  // namespace hamjet::io
