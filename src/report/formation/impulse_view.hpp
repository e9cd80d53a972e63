#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../drawing/chart.hpp"
#include "hamjet/studies/transfer.hpp"

// What page, files and the terminal say about the number of impulses of a transfer.

namespace hamjet::io {

/// Whether a further impulse would help the least transfer of two; empty where that is not known.
std::string primer_text(const TransferResult& result);
/// What the optimal impulses cost; empty where none were asked for.
std::string optimal_impulses_verdict(const TransferResult& result);
/// Why the optimal impulses that were asked for are not there; empty if they are.
std::string optimal_impulses_failure(const TransferResult& result);

/// Lines of the terminal's table.
std::string impulse_lines(const TransferResult& result);
/// Sections of the page, without the chart.
std::string impulse_table_html(const TransferResult& result);
/// The magnitude of the primer vectors along time.
Chart primer_chart(const TransferResult& result);

nlohmann::ordered_json primer_json(const TransferResult& result);
nlohmann::ordered_json optimal_impulses_json(const TransferResult& result);
/// Impulses of any plan as lines of the terminal's table, as a table of a page, and in JSON.
std::string impulse_rows(const TransferResult& result, const std::vector<Impulse>& impulses);
std::string impulse_rows_html(const TransferResult& result, const std::vector<Impulse>& impulses,
                              const std::string& caption);
nlohmann::ordered_json impulses_json(const TransferResult& result,
                                     const std::vector<Impulse>& impulses);

}  // namespace hamjet::io
