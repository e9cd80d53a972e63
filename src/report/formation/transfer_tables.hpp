#pragma once

#include <string>
#include <vector>

#include "../../store/result_table.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet::io {

/// The columns of one transfer, along the axes of the scene's frame.
ResultTable<TransferPoint> transfer_columns(const Scene& scene);

/// All tables of a transfer study: `transfers` with one row a transfer time, whose columns without
/// dimension are those of the whole result; `singular_times` with one a kind and time at which the
/// kind does not exist; `conditions` of all kinds along time; `budget_windows`; `impulses` of the
/// optimal plan and `least_by_time`, what these cost in other times; `waypoints`, impulses of the
/// best way through them, and `total_by_time`; `energy_optimal` and `thrust_profile`;
/// `fuel_optimal`, `fuel_optimal_burns` and `primer_profile`; and `burns`.
std::vector<TableView> transfer_tables(const TransferResult& result);

TableView transfers_table(const TransferResult& result);
TableView singular_times_table(const TransferResult& result);
TableView conditions_table(const TransferResult& result);
TableView budget_windows_table(const TransferResult& result);

}  // namespace hamjet::io
