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

/// Of entries with these three members. As an array of no type, for the help would show C++'s.
template <class Entry>
py::array by_degree(const std::vector<Entry>& entries) {
  std::vector<DegreeRow> rows;
  for (const Entry& entry : entries) rows.push_back({entry.degree, entry.absolute, entry.scaled});
  return array_of(std::move(rows));
}

}  // namespace hamjet::python
