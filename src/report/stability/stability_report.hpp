#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "../../studies/stability/stability.hpp"
#include "hamjet/detail/report/report_origin.hpp"
#include "hamjet/detail/report/study_report.hpp"

namespace hamjet::io {

/// Reads the cases of a folder, every file `*.toml` in the order of their names, or the one case of
/// a file. A case is a scene with a table `[case]`; see data/scenes/extreme/README.md. A scene that
/// is refused is kept as its error, for a refusal may be what is right; a mistake in `[case]`
/// itself is not kept. Throws Error(scene) for such a mistake, and Error(input_output) if nothing
/// can be read.
std::vector<StabilityCase> read_stability_suite(const std::filesystem::path& suite);

/// How a case came out, in one line for the terminal.
std::string stability_line(const StabilityResult& result, std::size_t name_width);

/// The files of `hamjet stability`: `stability.csv`, `stability.html` and `summary.json`, whose
/// list of one object a case is what --json prints. The exit code is 1 if a case is wrong.
StudyReport stability_report(const std::vector<StabilityResult>& results,
                             const ReportOrigin& origin);

}  // namespace hamjet::io
