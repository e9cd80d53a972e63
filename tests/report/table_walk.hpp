#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "../../src/store/table_view.hpp"
#include "report_tables.hpp"

namespace hamjet::io::report_tables {

/// What a column must hold in a row, as JSON has it, and its unit; and what in further rows.
struct Expected {
  std::string unit;
  Json value;
  std::vector<Json> further = {};
};

using ExpectedColumns = std::map<std::string, Expected>;  ///< by name

/// A table of a made-up result with its report, and what all its columns hold in the rows.
struct Walk {
  TableView table;
  StudyReport report;
  std::vector<std::size_t> rows;  ///< the first, and the further ones
  ExpectedColumns columns;
  /// The object whose members are arrays over the last dimension, where summary.json has no rows.
  std::string place_of_arrays = {};
  double rounding = 0;  ///< by which numbers may differ that the report computes
};

}  // namespace hamjet::io::report_tables
