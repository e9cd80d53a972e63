#pragma once

#include <cstddef>

#include "../drawing/chart.hpp"
#include "hamjet/studies/comparison.hpp"

// What the plots of a comparison with one point a run have in common.

namespace hamjet::io {

/// The axis of the shown errors, and that of the times of integration.
ChartAxis error_axis(const ComparisonResult& result);
ChartAxis run_time_axis();

/// Whether the error may be shown; counts those that are the reference's as much as the run's.
bool is_claimed(double error, double smallest, std::size_t& below);

/// Says how many runs is_claimed counted.
void note_below(const ComparisonResult& result, double smallest, std::size_t below, Chart& chart);

/// A vertical line at the wanted error, where the scene has one at formation scale.
void add_wanted_error(const ComparisonResult& result, Chart& chart);

}  // namespace hamjet::io
