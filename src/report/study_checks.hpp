#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "hamjet/detail/report/study_report.hpp"
#include "hamjet/detail/studies/self_checks.hpp"

namespace hamjet::io {

/// Self-checks as summary.json has them.
nlohmann::ordered_json checks_json(const std::vector<SelfCheck>& checks);

/// Tells a study's self-checks in its finished report: all in `checks` of summary.json; those that
/// failed in `failed_checks` there, on the terminal, above the page's verdict and in the exit code,
/// which is 1 unless it tells of something worse.
void add_checks(StudyReport& report, const std::vector<SelfCheck>& checks);

}  // namespace hamjet::io
