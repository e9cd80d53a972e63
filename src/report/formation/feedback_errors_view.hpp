#pragma once

#include <string>

#include "../../store/result_table.hpp"
#include "hamjet/studies/transfer.hpp"

// What files, page and terminal say about the flights by a law of feedback under errors.

namespace hamjet::io {

/// The flights in closed and in open loop under errors, one row a sample; no rows where none were
/// asked for or no law was found.
TableView feedback_samples_table(const TransferResult& result);
/// Their misses and costs, one row a loop.
TableView feedback_errors_table(const TransferResult& result);

/// Lines of the terminal's table, and a table of the page; empty where there are no such flights.
std::string feedback_errors_lines(const TransferResult& result);
std::string feedback_errors_html(const TransferResult& result);

/// `feedback.c`: the law as a function in C99 without dependencies.
std::string feedback_c_text(const TransferResult& result);

}  // namespace hamjet::io
