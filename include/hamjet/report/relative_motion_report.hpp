#pragma once

#include <optional>
#include <string>

#include "hamjet/detail/report/report_origin.hpp"
#include "hamjet/detail/report/study_report.hpp"
#include "hamjet/studies/assignment.hpp"
#include "hamjet/studies/transfer.hpp"
#include "hamjet/studies/validity.hpp"

// Numbers in CSV files have 17 digits; what was not computed is empty there and null in JSON.

namespace hamjet::io {

/// `transfers.csv`: one row a transfer time.
std::string transfers_csv(const TransferResult& result);
/// `singular_times.csv`: one row a kind and time at which the kind does not exist.
std::string singular_times_csv(const TransferResult& result);
/// `conditions.csv`: one row a transfer time, one column a kind; "inf" where it is singular.
std::string conditions_csv(const TransferResult& result);
/// `assignment.csv`: one row a deputy with its slot and transfer.
std::string assignment_csv(const AssignmentResult& result);
/// `costs.csv`: one row a deputy and slot.
std::string costs_csv(const AssignmentResult& result);
/// The least separation of each pair of deputies on their ways.
std::string pairs_csv(const AssignmentResult& result);

/// The files of `hamjet transfer`: the CSV files, `report.html`, `summary.json`. `trajectory` is
/// that of the best point, if there is one; `validity` is there if the scene asks for it.
StudyReport transfer_report(const TransferResult& result,
                            const std::optional<RelativeTrajectory>& trajectory,
                            const std::optional<ValidityResult>& validity,
                            const ReportOrigin& origin);
/// transfer_report with the best point's trajectory, which is flown here, and the validity that the
/// result has.
StudyReport flown_transfer_report(const TransferResult& result, const ReportOrigin& origin);
/// The files of `hamjet validity`: `validity.csv`, `report.html`, `summary.json`.
StudyReport validity_report(const ValidityResult& result, const ReportOrigin& origin);
/// The files of `hamjet validity --coordinates all`, of the same names: the reach in each of the
/// coordinates.
StudyReport coordinates_report(const ValidityInCoordinates& all, const ReportOrigin& origin);
/// The files of `hamjet assign`: `assignment.csv`, `costs.csv`, `summary.json`, which do not tell
/// of their origin.
StudyReport assignment_report(const AssignmentResult& result, const ReportOrigin& origin = {});

}  // namespace hamjet::io
