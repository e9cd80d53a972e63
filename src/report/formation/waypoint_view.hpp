#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "hamjet/studies/transfer.hpp"

// What page, files and the terminal say about transfers through waypoints, and those whose first
// impulse waits.

namespace hamjet::io {

/// What the least of them costs, or why there is none; empty where none were asked for.
std::string waypoint_verdict(const TransferResult& result);
/// The reason why the way that was asked for was not found; empty if it was.
std::string waypoint_failure(const TransferResult& result);

/// Lines of the terminal's table, and a section of the page.
std::string waypoint_lines(const TransferResult& result);
std::string waypoint_section_html(const TransferResult& result);

nlohmann::ordered_json waypoints_json(const TransferResult& result);
/// The same texts for the least transfer whose first impulse waits.
std::string coasting_verdict(const TransferResult& result);
std::string coasting_failure(const TransferResult& result);
std::string coasting_lines(const TransferResult& result);
std::string coasting_section_html(const TransferResult& result);
nlohmann::ordered_json coasting_json(const TransferResult& result);

/// The same texts for the least transfer with another number of revolutions.
std::string revolutions_verdict(const TransferResult& result);
std::string revolutions_failure(const TransferResult& result);
std::string revolutions_lines(const TransferResult& result);
std::string revolutions_section_html(const TransferResult& result);
nlohmann::ordered_json revolutions_json(const TransferResult& result);

}  // namespace hamjet::io
