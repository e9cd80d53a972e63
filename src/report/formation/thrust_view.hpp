#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "../../store/result_table.hpp"
#include "../drawing/chart.hpp"
#include "hamjet/studies/transfer.hpp"

// What page, files and the terminal say about transfers with a thrust that lasts.

namespace hamjet::io {

/// The energy-optimal transfers, one row a time; no rows where none were asked for.
TableView energy_optimal_table(const TransferResult& result);

/// The thrust along the way of the least of them, one row a time; no rows if there is none.
TableView thrust_profile_table(const TransferResult& result);
/// A picture of it.
Chart thrust_chart(const TransferResult& result);

/// The law of feedback of the least, one row an instant and monomial; no rows where none was asked
/// for or found.
TableView feedback_table(const TransferResult& result);
/// `feedback.json`: the same polynomials, with the flight by them.
nlohmann::ordered_json feedback_json(const TransferResult& result);

/// What the least of them takes, or why there is none; empty where none were asked for.
std::string thrust_verdict(const TransferResult& result);
/// The reason why the thrust that was asked for was not found; empty if it was.
std::string thrust_failure(const TransferResult& result);

/// Lines of the terminal's table, and a section of the page.
std::string thrust_lines(const TransferResult& result);
std::string thrust_section_html(const TransferResult& result);

}  // namespace hamjet::io
