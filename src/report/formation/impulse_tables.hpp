#pragma once

#include <string>
#include <vector>

#include "../../store/result_table.hpp"
#include "hamjet/studies/transfer.hpp"

// The tables of plans of several impulses among those of a transfer study (transfer_tables).

namespace hamjet::io {

TableView optimal_impulses_table(const TransferResult& result);
TableView least_by_time_table(const TransferResult& result);
TableView waypoint_impulses_table(const TransferResult& result);
TableView total_by_time_table(const TransferResult& result);

/// The impulses of a plan, whose object in summary.json is at `place`.
TableView impulses_table(const std::string& name, const std::string& place,
                         const std::string& meaning, const Scene& scene,
                         const std::vector<Impulse>& impulses);

}  // namespace hamjet::io
