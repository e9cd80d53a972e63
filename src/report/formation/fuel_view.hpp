#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "../../store/result_table.hpp"
#include "../drawing/chart.hpp"
#include "hamjet/studies/transfer.hpp"

// What page, files and the terminal say about transfers with a thrust of least fuel.

namespace hamjet::io {

/// The fuel-optimal transfers, one row a time; no rows where none were asked for.
TableView fuel_optimal_table(const TransferResult& result);
/// Their burns at full thrust, one row a burn.
TableView fuel_optimal_burns_table(const TransferResult& result);
/// Thrust and primer vector along the way of the least, one row a time; no rows if there is none.
TableView primer_profile_table(const TransferResult& result);
/// A picture of both.
Chart fuel_chart(const TransferResult& result);

/// All three tables; null where none were asked for.
nlohmann::ordered_json fuel_optimal_json(const TransferResult& result);

/// What the least of them takes, or why there is none; empty where none were asked for.
std::string fuel_verdict(const TransferResult& result);
/// The reason why the thrust that was asked for was not found; empty if it was.
std::string fuel_failure(const TransferResult& result);

/// Lines of the terminal's table, and a section of the page.
std::string fuel_lines(const TransferResult& result);
std::string fuel_section_html(const TransferResult& result);

}  // namespace hamjet::io
