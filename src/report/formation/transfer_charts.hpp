#pragma once

#include <string>
#include <vector>

#include "../drawing/chart.hpp"
#include "hamjet/studies/transfer.hpp"
#include "hamjet/studies/validity.hpp"

namespace hamjet::io {

// None of these charts is fitted.

/// Velocity changes against transfer time, with the margins around F1's singular times.
Chart velocity_change_chart(const TransferResult& result);
/// Where the deputies of each order come to, against transfer time.
Chart miss_chart(const TransferResult& result);
/// Conditions of F1..F4 and of the best kind along time.
Chart condition_chart(const TransferResult& result);

/// The trajectory relative to the chief, projected on three planes that show the same span, its
/// colour the time; `time_s` is a canonical unit of time. How to read them stands with the first.
/// `axes` names the coordinates of an own system, if there are fewer than three: two have one
/// plane, and one is drawn against the time.
std::vector<Chart> relative_trajectory_charts(const RelativeTrajectory& trajectory, double time_s,
                                              std::vector<std::string> axes = {});

/// The flown transfer beside the same deputy that makes no velocity changes, in the plane of the
/// first two axes, of which `axes` has the names if they are an own system's.
Chart rendezvous_chart(const RelativeTrajectory& trajectory,
                       const std::vector<std::string>& axes = {});

/// The largest separation at which each order is right, along time.
Chart validity_time_chart(const ValidityResult& result);
/// The largest separation at which an order is right, against the order, for some of the times.
Chart validity_order_chart(const ValidityResult& result);

}  // namespace hamjet::io
