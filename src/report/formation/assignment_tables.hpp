#pragma once

#include <vector>

#include "../../store/table_view.hpp"
#include "hamjet/studies/assignment.hpp"

namespace hamjet::io {

/// All tables of an assignment: `assignment` with one row a deputy that has a slot, `costs` with
/// one a deputy and slot, `pairs` with one a pair of deputies that fly.
std::vector<TableView> assignment_tables(const AssignmentResult& result);

TableView assignment_table(const AssignmentResult& result);
TableView costs_table(const AssignmentResult& result);
TableView pairs_table(const AssignmentResult& result);

}  // namespace hamjet::io
