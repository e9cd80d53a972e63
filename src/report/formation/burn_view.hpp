#pragma once

#include <string>

#include "../../store/result_table.hpp"
#include "hamjet/studies/transfer.hpp"

// What page, files and the terminal say about burns in place of impulses.

namespace hamjet::io {

/// The burns of all transfers, one row a burn, or one for a transfer that has none; no rows without
/// a thruster.
TableView burns_table(const TransferResult& result);

/// What the least of them takes, or why there is none; empty without a thruster.
std::string burns_verdict(const TransferResult& result);
/// Why there is none; empty if there is.
std::string burns_failure(const TransferResult& result);

/// Lines of the terminal's table, and a section of the page.
std::string burn_lines(const TransferResult& result);
std::string burns_section_html(const TransferResult& result);

}  // namespace hamjet::io
