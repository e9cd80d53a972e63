#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hamjet/detail/store/report_file.hpp"
#include "hamjet/studies/transfer.hpp"

// Orbits as Orbit Ephemeris Messages: canonical states in km and km/s, canonical times on the
// calendar. The scene must have an ephemeris. The messages say in comments what they cannot hold.
// All throw Error(input_output) for a moment outside of the calendar.

namespace hamjet::io {

/// `nominal.oem` of a run: the nominal at the steps of the integrator.
std::string nominal_oem(const PropagationResult& result, const RunResult& run);

/// `chief.oem` and `deputy.oem`: one each, for a message holds a single object (CCSDS 502.0-B-3,
/// 5.1.3).
std::vector<ReportFile> transfer_oems(const TransferResult& result,
                                      const RelativeTrajectory& trajectory);

/// `ephemeris` and `nominal_file` of a summary; null where the scene has none.
nlohmann::ordered_json ephemeris_json(const Scene& scene);
nlohmann::ordered_json nominal_file_json(const Scene& scene);

}  // namespace hamjet::io
