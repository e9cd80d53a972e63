#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "../../store/table_view.hpp"

// Tables of results as Python has them.

namespace hamjet::python {

namespace py = pybind11;

/// The tables by name, each a dict of its columns by name: read-only arrays with the table's
/// dimensions and those of a cell, float64 with NaN where there is no number, int64 or bool; texts
/// as tuples, nested likewise, with None; what holds for the whole result as one object.
py::dict columns_of_tables(const std::vector<io::TableView>& tables);

/// The tables by name, each a dict of its columns as CSV has them, with an entry for each row.
py::dict rows_of_tables(const std::vector<io::TableView>& tables);

/// What is declared of the tables: by name of table and column (unit, meaning, dimensions).
py::dict declarations();

}  // namespace hamjet::python
