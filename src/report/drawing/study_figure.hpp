#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chart.hpp"
#include "hamjet/detail/report/study_report.hpp"

namespace hamjet::io {

/// Draws the charts, fitted here, below one another as one SVG. Empty if nothing can be drawn;
/// `problem` is the reason, one line, where gnuplot could not. `program` is as ChartDrawer has it.
std::string draw_figure(std::vector<Chart> charts, std::optional<std::string>& problem,
                        const std::string& program = "gnuplot");

/// Draws the charts, fitted here, below one another into the file `figure.svg` of the report. Where
/// that cannot be done the report says why, and has no figure.
void add_figure(StudyReport& report, std::vector<Chart> charts,
                const std::string& program = "gnuplot");

}  // namespace hamjet::io
