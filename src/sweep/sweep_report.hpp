#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/report/study_report.hpp"
#include "sweep_items.hpp"

namespace hamjet::io {

/// The rows of a sweep that its folder has, and why others cannot be read.
struct SweepRows {
  std::vector<std::optional<SweepRow>> rows;  ///< one an item
  std::size_t damaged = 0;                    ///< items whose file is not whole
  std::size_t foreign = 0;                    ///< items whose file has a row of another study
};
SweepRows read_sweep_rows(const SweepStudy& study, const SweepDirectory& directory);

/// `table.csv`: one row an item, in their order, with the values of the keys, the columns, the exit
/// code and the error; an item without a row has "missing" in place of the exit code.
std::string sweep_csv(const SweepStudy& study, const SweepRows& rows);

/// `table.csv`, `map.svg` where the study asks for a map and gnuplot can draw it, `summary.json`.
/// There are no times in them: equal rows give equal files. The exit code is 1 if items are missing
/// or have failed.
StudyReport sweep_report(const SweepStudy& study, const SweepRows& rows);

}  // namespace hamjet::io
