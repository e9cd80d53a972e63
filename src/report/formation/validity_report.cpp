#include <fmt/format.h>

#include <functional>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/json_text.hpp"
#include "../../store/json_values.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/terminal_text.hpp"
#include "../centre_columns.hpp"
#include "../drawing/chart_drawer.hpp"
#include "../own_units_text.hpp"
#include "../study_checks.hpp"
#include "frame_columns.hpp"
#include "hamjet/report/relative_motion_report.hpp"
#include "transfer_json.hpp"
#include "transfer_page.hpp"
#include "transfer_view.hpp"
#include "validity_table.hpp"
#include "validity_view.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

std::string terminal_table(const ValidityResult& result) {
  const double unit = result.scene.units.time_s;
  const TimeAxis axis = time_axis(result.points.empty() ? 0 : result.points.back().time * unit);
  std::vector<std::vector<std::string>> rows = {{fmt::format("time ({})", axis.name)}};
  for (int order = 1; order <= result.scene.order; ++order) {
    rows[0].push_back(fmt::format("order {}", order));
  }
  bool has_limit = false;
  for (const ValidityPoint& point : result.points) {
    rows.push_back({fmt::format("{:.6g}", point.time * unit / axis.seconds)});
    for (const ValidityEntry& entry : point.entries) {
      has_limit |= entry.is_at_limit;
      rows.back().push_back((entry.is_at_limit ? ">" : "") + length_text(entry.proved_m));
    }
  }
  const std::string limit = reach_limit_text(result);
  const std::string units = own_units_text(result.scene);
  return fmt::format(
             "{}\n{}\nframe {}{}\n\n{}", result.scene.title, validity_verdict(result),
             frame_text(result.scene.validity->frame) + coordinates_text(result.coordinates),
             units.empty() ? "" : "; " + units, aligned_table(rows)) +
         (has_limit ? "> still right at the largest separation tried\n" : "") +
         (limit.empty() ? "" : limit + "\n");
}

std::string terminal_details(const ValidityResult& result) {
  return fmt::format("{}; {} for the jets, {} to fly (floor {})\n",
                     counted(result.flights, "flight"), duration_text(result.propagation_seconds),
                     duration_text(result.proof_seconds), length_text(result.flight_floor_m));
}

/// An order at a time.
struct ReachRow {
  const ValidityPoint& point;
  const ValidityEntry& entry;
};

/// A member of what limits a reach, which may be missing.
template <class Value>
auto of_limit(Value ReachLimit::*member) {
  return [member](const ReachRow& row) {
    return row.entry.limit ? std::optional((*row.entry.limit).*member) : std::nullopt;
  };
}

template <class Value>
auto of_entry(Value ValidityEntry::*member) {
  return [member](const ReachRow& row) { return row.entry.*member; };
}

}  // namespace

TableView validity_table(const ValidityResult& result) {
  const ValiditySettings& settings = *result.scene.validity;
  const double unit = result.scene.units.time_s;
  ResultTable<ReachRow> table(
      "validity", "/validity", {"times", "orders"},
      "How far from the chief the polynomials of each order are right to the tolerance.");
  table.add_scalar("verdict", "", "the outcome in words", validity_verdict(result));
  table.add_scalar("tolerance_m", "m", "the largest miss that counts as right",
                   settings.tolerance_m);
  table
      .add("time_canonical", "", "since the start, in the scene's canonical unit of time",
           [&](const ReachRow& row) { return told_time(result.scene, row.point.time); })
      .level = 1;
  table
      .add("time_s", "s", "since the start",
           [=](const ReachRow& row) { return row.point.time * unit; })
      .level = 1;
  table.add("order", "", "the order of the polynomials", of_entry(&ValidityEntry::order));
  table.add("predicted_m", "m", "the separation expected from the decay of the jet's degrees",
            of_entry(&ValidityEntry::predicted_m));
  table.add("proved_m", "m",
            "the largest separation found right by flying sampled deputies; 0 where none was",
            of_entry(&ValidityEntry::proved_m));
  table.add("miss_m", "m", "the worst miss of the sampled deputies at that separation",
            of_entry(&ValidityEntry::miss_m));
  table.add("at_limit", "",
            "whether nothing further away was tried, so that the separation is a lower bound",
            of_entry(&ValidityEntry::is_at_limit));
  add_frame(table, result.scene.system, settings.frame, result.coordinates, true);
  table.add("limit_degree", "",
            "d log(miss) / d log(separation) of the worst deputy; nothing where nothing limits",
            of_limit(&ReachLimit::degree));
  table.add("limit_start_coordinate", "",
            "the coordinate of that deputy's deviation with the largest part of the degree",
            of_limit(&ReachLimit::start_coordinate));
  table.add(
      "limit_start_degree", "",
      "that coordinate's part of the degree; above the degree where parts of others are below 0",
      of_limit(&ReachLimit::start_degree));
  table.add("limit_end_coordinate", "", "the coordinate in which the polynomials miss most",
            of_limit(&ReachLimit::end_coordinate));
  table.add(
      "limit_end_share", "",
      "that coordinate's part of the miss, 1 for all of it; above 1 where parts of others are "
      "below 0",
      of_limit(&ReachLimit::end_share));
  table.add_scalars(
      "semi_axes", "",
      "the semi-axes of the ellipsoid of deviations along the axes, in parts of the separation",
      settings.semi_axes);
  table.add_scalar("samples", "", "the number of random deputies of each ellipsoid",
                   settings.samples);
  table.add_scalar("flights", "", "the number of deputies that were flown with the full equations",
                   result.flights);
  const auto of_domains = [&](auto member) {
    return result.domains ? std::optional(std::invoke(member, *result.domains)) : std::nullopt;
  };
  using Domains = ValidityDomains;
  table.add_scalar("domains", "",
                   "the number of domains, with polynomials of the highest order about centres of "
                   "their own, that deputies within `separation_m` take at the last time; nothing "
                   "where the scene does not ask",
                   of_domains(&Domains::count));
  table.add_scalar("separation_m", "m", "the largest semi-axis of the set that was split",
                   of_domains(&Domains::separation_m));
  table.add_scalar("domains_split_across", "",
                   "the coordinate across which most domains were halved; empty for one domain",
                   of_domains(&Domains::split_across));
  table.add_scalar("domain_deputies", "", "the number of deputies of that set, all flown",
                   of_domains(&Domains::deputies));
  table.add_scalar("domain_miss_m", "m", "the largest miss of these", of_domains(&Domains::miss_m));
  table.add_scalar("deputies_not_right", "",
                   "the number of them beyond the tolerance, where the limit on domains was met",
                   of_domains(&Domains::not_right));
  table.add_scalar("domain_maps", "",
                   "the number of maps that were integrated, those of domains that were split too",
                   of_domains(&Domains::maps));
  table.add_scalar("flight_floor_m", "m", "misses below this say nothing", result.flight_floor_m);
  std::vector<ReachRow> rows;
  for (const ValidityPoint& point : result.points) {
    for (const ValidityEntry& entry : point.entries) rows.push_back({point, entry});
  }
  return std::move(table).view(
      rows, {result.points.size(), static_cast<std::size_t>(result.scene.order)});
}

TableView split_domains_table(const ValidityResult& result) {
  ResultTable<ValidityDomain> table("split_domains", "/validity", {"split_domains"},
                                    "The domains that deputies within `separation_m` were split "
                                    "into, each with polynomials about "
                                    "its centre.");
  add_centre(table, result.scene.validity->frame, "the chief", [](const ValidityDomain& domain) {
    Eigen::Matrix<double, 6, 1> centre;
    centre << domain.centre.position_m, domain.centre.velocity_m_s;
    return centre;
  });
  table.add("deputies", "", "the number of deputies in it, all flown", &ValidityDomain::deputies);
  table.add("miss_m", "m", "the largest miss of these", &ValidityDomain::miss_m);
  const std::vector<ValidityDomain>& domains = result.domains.value().parts;
  return std::move(table).view(domains, {domains.size()});
}

Json validity_json(const ValidityResult& result) {
  Json json = table_json(validity_table(result));
  if (result.domains) json.update(table_json(split_domains_table(result)));
  add_chosen_by(json, result.coordinates);
  json["seconds"] = {{"propagation", result.propagation_seconds}, {"proof", result.proof_seconds}};
  return json;
}

Json validity_report_json(const ValidityResult& result) {
  Json summary = study_head_json(result.scene, "validity", result.integrator);
  summary["validity"] = validity_json(result);
  summary["exit_code"] = 0;
  return summary;
}

StudyReport validity_report(const ValidityResult& result, const ReportOrigin& origin) {
  StudyReport report;
  ChartDrawer drawer(origin.gnuplot);
  report.files = {{"validity.csv", table_csv(validity_table(result))},
                  {"report.html", validity_page(result, origin, drawer)}};
  if (result.domains) {
    report.files.push_back({"split_domains.csv", table_csv(split_domains_table(result))});
  }
  report.drawing_problem = drawer.problem();
  report.files.push_back({"summary.json", json_text(validity_report_json(result)) + "\n"});
  report.table = terminal_table(result);
  report.details = terminal_details(result);
  add_checks(report, result.checks);
  return report;
}

}  // namespace hamjet::io
