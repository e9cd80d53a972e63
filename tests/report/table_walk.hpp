#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "../../src/store/table_view.hpp"
#include "report_tables.hpp"

namespace hamjet::io::report_tables {

/// What a column must hold in a row, as JSON has it, and its unit.
struct Expected {
  std::string unit;
  Json value;
};

/// A table of a made-up result with its report, and what all its columns hold in the rows.
struct Walk {
  TableView table;
  StudyReport report;
  std::vector<std::size_t> rows;
  std::map<std::string, Expected> columns;
};

}  // namespace hamjet::io::report_tables
