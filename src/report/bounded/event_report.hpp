#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../../store/table_view.hpp"
#include "../../studies/bounded/event_study.hpp"
#include "hamjet/detail/report/report_origin.hpp"
#include "hamjet/detail/report/study_report.hpp"

namespace hamjet::io {

/// The first that a reader sees: when and where the event is, and how far its polynomials hold.
std::string event_verdict(const EventStudy& study);

/// The polynomials of the time and of the state's told components, in the units that are told.
FlowJet<double> told_polynomials(const EventStudy& study);

/// A row an amplitude, how far flown deputies are from their polynomials.
std::vector<TableView> event_tables(const EventStudy& study);

/// `event-map.csv`: the polynomials in the form of `jet.csv`, with the component `time`.
std::string event_map_csv(const EventStudy& study);

/// `summary.json`.
nlohmann::ordered_json event_json(const EventStudy& study);

/// The files of `hamjet poincare` of a scene with an event: `event.csv`, `event-map.csv`,
/// `report.html`, `summary.json`.
StudyReport event_report(const EventStudy& study, const ReportOrigin& origin);

}  // namespace hamjet::io
