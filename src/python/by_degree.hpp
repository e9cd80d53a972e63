#pragma once

#include <cstdint>
#include <vector>

#include "arrays.hpp"

namespace hamjet::python {

/// One row of the structured arrays that Python gets of defects and residuals.
struct DegreeRow {
  std::int64_t degree;
  double absolute;
  double scaled;
};

/// An array of DegreeRow from entries with these members; its type is left open, for the help would
/// show that of C++.
template <class Entry>
py::array by_degree(const std::vector<Entry>& entries) {
  std::vector<DegreeRow> rows;
  for (const Entry& entry : entries) rows.push_back({entry.degree, entry.absolute, entry.scaled});
  return array_of(std::move(rows));
}

}  // namespace hamjet::python
