#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chart.hpp"
#include "hamjet/detail/maps/generating_function_kind.hpp"
#include "hamjet/detail/studies/run_along_time.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet::io {

/// A kind in words: "F1 (qqq-qqq)", or the notation alone.
std::string kind_text(const GeneratingFunctionKind& kind);

/// Gives x, which is a time in units of so many seconds, an axis of revolutions at the top, where
/// the nominal is an orbit that closes.
void add_revolutions(const Scene& scene, double seconds, ChartAxis& x);

/// The vertical axis of plots of the exactness residual, and what stands in place of a plot where
/// there is none.
inline constexpr const char* exactness_label = "exactness residual, degree 0, scaled";
inline constexpr const char* no_generating_function =
    "The jet is not expanded in all variables of phase space: there is no generating function.";

/// The figure of Guibout and Bloch, with the times at which the kind does not exist; the chart is
/// not fitted.
Chart exactness_along_time_chart(const Scene& scene,
                                 const std::optional<GeneratingFunctionKind>& kind,
                                 const std::vector<RunAlongTime>& runs);

/// The energy error of the nominal along time; the chart is not fitted.
Chart energy_along_time_chart(const Scene& scene, const std::vector<RunAlongTime>& runs);

}  // namespace hamjet::io
