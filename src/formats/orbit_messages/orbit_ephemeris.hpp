#pragma once

#include <string>
#include <vector>

#include "hamjet/detail/store/report_file.hpp"
#include "hamjet/studies/transfer.hpp"

// Orbits as Orbit Ephemeris Messages, and their ends as Orbit Parameter Messages: canonical states
// in km and km/s, canonical times on the calendar. The scene must have an ephemeris. Comments in
// the messages name what these cannot hold. All functions throw Error(input_output) for a moment
// outside the calendar.

namespace hamjet::io {

struct OutputFormat;

/// `nominal.oem` of each run.
extern const OutputFormat oem_format;
/// `nominal.oem.xml`, the same ephemeris in XML.
extern const OutputFormat oem_xml_format;

/// `start.opm` and `end.opm` of each run: the nominal's state at both ends. The two are requested
/// together.
extern const OutputFormat start_opm_format;
extern const OutputFormat end_opm_format;
/// `start.opm.xml` and `end.opm.xml`, the same states in XML.
extern const OutputFormat start_opm_xml_format;
extern const OutputFormat end_opm_xml_format;

/// `nominal.oem` of a run: the nominal at the steps of the integrator.
std::string nominal_oem(const PropagationResult& result, const RunResult& run);

/// `chief.oem` and `deputy.oem`, in KVN, XML or both, as the scene asks. There is one file for each
/// spacecraft, because a message holds a single object (CCSDS 502.0-B-3, 5.1.3).
std::vector<ReportFile> transfer_oems(const TransferResult& result,
                                      const RelativeTrajectory& trajectory);

/// `chief.opm` and `deputy.opm`, in KVN, XML or both, as the scene asks: both spacecraft at one
/// moment, and in the deputy's the manoeuvres of the transfer: the burns of the thruster if there
/// are any, otherwise the impulses of the optimal plan, otherwise the two of the best time. The
/// moment is the start, or where a burn begins before it.
std::vector<ReportFile> transfer_opms(const TransferResult& result);

}  // namespace hamjet::io
