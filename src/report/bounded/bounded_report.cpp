#include "bounded_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "../../store/json_text.hpp"
#include "../../store/result_table.hpp"
#include "../../studies/bounded/relative_orbit_extent.hpp"
#include "../../studies/bounded/scene_gauss.hpp"
#include "../../studies/checks/flight_checks.hpp"
#include "../../text/html_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/terminal_text.hpp"
#include "../drawing/report_page.hpp"
#include "../formation/transfer_json.hpp"
#include "../study_checks.hpp"
#include "bounded_charts.hpp"
#include "box_report.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

/// A form's name with what tells the two kinds of RTN apart.
std::string form_key(DeputyForm form) {
  const std::string name(name_of(form));
  if (form == DeputyForm::rtn_rotating) return name + "-rotating";
  return form == DeputyForm::rtn_inertial ? name + "-inertial" : name;
}

std::string short_number(double value) { return fmt::format("{:.2e}", value); }

std::vector<std::string> row_of(const BoundedDeputy& deputy) {
  std::vector<std::string> row = {
      fmt::format("{} {}", length_text(deputy.wanted_m), name_of(deputy.rule))};
  if (!deputy.failure.empty()) {
    row.resize(10);
    return row;
  }
  row.push_back(length_text(deputy.size_m));
  row.push_back(fmt::format("{} to {}{}", length_text(deputy.least_size_m),
                            length_text(deputy.largest_size_m),
                            deputy.is_held() ? "" : " NOT HELD"));
  const Eigen::Vector3d extent = half_widths_m(deputy.first);
  for (const double width : extent) row.push_back(length_text(width));
  for (const BoundedDrift& drift : deputy.drifts) {
    row.push_back(fmt::format("{}+-{:.0e}", short_number(drift.along), drift.along_doubt));
  }
  row.push_back(short_number(deputy.drifts.back().cross));
  row.push_back(short_number(deputy.drifts.back().range));
  return row;
}

std::vector<std::string> headings(const BoundedFormation& formation) {
  return {"size and rule",
          "size",
          "in the window",
          "R +-",
          "T +-",
          "N +-",
          fmt::format("drift ({})", std::max(1, formation.revolutions / 10)),
          fmt::format("drift ({})", formation.revolutions),
          "across",
          "range"};
}

/// Whether a deputy passes below what the scene's check `surface` allows.
bool is_inside(const BoundedFormation& formation, const BoundedDeputy& deputy) {
  const std::optional<double> limit = surface_limit(formation.scene);
  return limit && deputy.failure.empty() &&
         deputy.lowest_m < *limit * formation.scene.units.length_km * 1000;
}

/// Whether a deputy that the study offers, not one that it is compared with, is what was asked for.
bool is_as_asked(const BoundedFormation& formation, const BoundedDeputy& deputy) {
  if (!is_of_map(deputy.rule) || !deputy.failure.empty()) return true;
  return deputy.is_held() && !is_inside(formation, deputy);
}

std::string failures_text(const BoundedFormation& formation) {
  std::string text;
  for (const BoundedDeputy& deputy : formation.deputies) {
    if (!deputy.failure.empty()) {
      text += fmt::format("none of {} by {}: {}\n", length_text(deputy.wanted_m),
                          name_of(deputy.rule), deputy.failure);
    } else if (is_inside(formation, deputy)) {
      text += fmt::format(
          "{} by {}: no orbit that can be flown, its lowest point is {} from the "
          "centre, inside the body\n",
          length_text(deputy.wanted_m), name_of(deputy.rule), length_text(deputy.lowest_m));
    }
    if (deputy.failure.empty() && !deputy.is_held()) {
      text += fmt::format(
          "{} by {}: NOT HELD, it is {} in size over the first revolution, and {} to {} within the "
          "window\n",
          length_text(deputy.wanted_m), name_of(deputy.rule), length_text(deputy.size_m),
          length_text(deputy.least_size_m), length_text(deputy.largest_size_m));
    }
  }
  return text;
}

std::vector<std::vector<std::string>> table_rows(const BoundedFormation& formation) {
  std::vector<std::vector<std::string>> rows = {headings(formation)};
  for (const BoundedDeputy& deputy : formation.deputies) rows.push_back(row_of(deputy));
  return rows;
}

std::string terminal_table(const BoundedFormation& formation) {
  return fmt::format(
      "{}\n{}\norder {}; size: the largest distance from the chief over the first revolution, and "
      "over one from each look of the window on; drifts are mean ones along the track, a "
      "revolution, in parts of the size, "
      "+- what the last of the times changes; across: the same of the node; range: of the "
      "along-track difference over the window\n\n{}{}",
      formation.scene.title, bounded_verdict(formation), formation.scene.order,
      aligned_table(table_rows(formation)), failures_text(formation));
}

int exit_code_of(const BoundedFormation& formation) {
  const auto is_found = [](const BoundedDeputy& deputy) {
    return is_of_map(deputy.rule) && deputy.failure.empty();
  };
  if (std::ranges::none_of(formation.deputies, is_found)) {
    return static_cast<int>(ErrorKind::numerical);
  }
  const bool is_kept = (!formation.box || formation.box->is_kept()) &&
                       std::ranges::all_of(formation.deputies, [&](const BoundedDeputy& deputy) {
                         return is_as_asked(formation, deputy);
                       });
  return is_kept ? 0 : static_cast<int>(ErrorKind::check_failed);
}

std::string page(const BoundedFormation& formation, const ReportOrigin& origin,
                 ChartDrawer& drawer) {
  ReportPage page;
  page.title = formation.scene.title + ": bounded formations";
  page.verdict = bounded_verdict(formation);
  Chart drifts = bounded_drift_chart(formation);
  fit(drifts);
  page.first_figure = figure_html(drifts, drawer);
  page.facts =
      origin_facts_html(origin) +
      fact_html("Scene", fmt::format("{}, order {}", formation.scene.name, formation.scene.order)) +
      fact_html("Window", counted(formation.revolutions, "revolution")) +
      fact_html("Mean nodal period",
                duration_text(formation.mean_period * formation.scene.units.time_s)) +
      fact_html("Time", duration_text(formation.seconds) + ", of which " +
                            duration_text(formation.flight_seconds) + " for the flights");
  std::vector<Chart> orbits = bounded_orbit_charts(formation);
  for (Chart& chart : orbits) fit(chart);
  page.sections =
      "<section>\n<h2>Relative orbits</h2>\n" + panels_html(orbits, drawer) + "</section>\n" +
      "<section>\n<h2>Deputies</h2>\n" +
      table_html(
          "The largest distance from the chief over the first revolution, and the least and the "
          "greatest such over a revolution from each look of the window on; half widths along R, T "
          "and N; mean drifts along the track over a tenth of the "
          "window and over it, each with what the last of the times changes, and across it, a "
          "revolution, in parts of the size; the range "
          "of the along-track difference over the window. Their initial conditions, in "
          "every form in which a scene takes a deputy, are in <code>bounded.csv</code>.",
          table_rows(formation)) +
      "<p>" + escape_html(failures_text(formation)) + "</p></section>\n";
  if (formation.box) {
    Chart box = box_chart(formation);
    fit(box);
    page.sections += section_html(box, drawer);
  }
  return page_html(page, drawer);
}

/// How the sizes of the deputies that are offered compare with those that were asked for.
std::string sizes_text(const BoundedFormation& formation) {
  const BoundedDeputy* worst = nullptr;
  std::size_t offered = 0, held = 0;
  const auto miss = [](const BoundedDeputy& deputy) {
    return std::max(deputy.largest_size_m / deputy.wanted_m, deputy.wanted_m / deputy.least_size_m);
  };
  for (const BoundedDeputy& deputy : formation.deputies) {
    if (!is_of_map(deputy.rule) || !deputy.failure.empty()) continue;
    ++offered;
    held += deputy.is_held() ? 1 : 0;
    if (worst == nullptr || miss(deputy) > miss(*worst)) worst = &deputy;
  }
  if (worst == nullptr) return "";
  return fmt::format(
      " {}: where {} was asked for, {} ({}) has a size of {} over the first revolution and {} to "
      "{} within the window{}.",
      held == offered
          ? "Sizes are held to a quarter"
          : fmt::format("NOT HELD are the sizes of {} of {} deputies", offered - held, offered),
      length_text(worst->wanted_m), "the deputy furthest from it", name_of(worst->rule),
      length_text(worst->size_m), length_text(worst->least_size_m),
      length_text(worst->largest_size_m),
      std::abs(worst->last_size_m / worst->size_m - 1) > 0.01
          ? fmt::format(", at its end {}", length_text(worst->last_size_m))
          : "");
}

std::string_view unit_of_component(std::string_view name) {
  if (name.ends_with("_m_s")) return "m/s";
  if (name.ends_with("_deg")) return "deg";
  return name.ends_with("_m") ? "m" : "";
}

/// Adds what is left of a deputy's drift over one of its two spans.
void add_drifts(ResultTable<BoundedDeputy>& table, std::size_t span, const std::string& prefix,
                const std::string& told) {
  const auto add = [&](const char* name, const std::string& meaning, auto member) {
    table.add_if([](const BoundedDeputy& deputy) { return deputy.failure.empty(); },
                 prefix + "_" + name, "", meaning,
                 [=](const BoundedDeputy& deputy) { return deputy.drifts[span].*member; });
  };
  add("revolutions", "the number of revolutions of " + told, &BoundedDrift::revolutions);
  add("along_drift", "the drift along the track over " + told, &BoundedDrift::along);
  add("along_doubt",
      "by how much the drift along the track changes where " + told + " ends a look earlier",
      &BoundedDrift::along_doubt);
  add("cross_drift", "the drift across the track over " + told, &BoundedDrift::cross);
  add("along_range", "the range of the along-track difference over " + told, &BoundedDrift::range);
}

}  // namespace

std::string bounded_verdict(const BoundedFormation& formation) {
  double worst = 0;
  double worst_invariant = 0;
  std::size_t found = 0;
  for (const BoundedDeputy& deputy : formation.deputies) {
    if (!deputy.failure.empty()) continue;
    const double drift = std::abs(deputy.drifts.back().along) + deputy.drifts.back().along_doubt;
    if (deputy.rule == BoundedRule::poincare_map) {
      worst = std::max(worst, drift);
      ++found;
    }
    if (deputy.rule == BoundedRule::j2_invariant) {
      worst_invariant = std::max(worst_invariant, drift);
    }
  }
  if (found == 0) return "No deputy of these sizes has the chief's mean period and drift.";
  const auto inside = std::ranges::count_if(formation.deputies, [&](const BoundedDeputy& deputy) {
    return is_inside(formation, deputy);
  });
  std::string text = fmt::format(
      "{} with the chief's mean nodal period and drift of the node; flown over {} with the whole "
      "field, {} by at most {:.2g} of the relative orbit's size a revolution in the mean",
      counted(found, "deputy"), counted(formation.revolutions, "revolution"),
      found == 1 ? "it drifts along the track" : "they drift along the track", worst);
  if (worst_invariant > 0) {
    text += fmt::format("; those of first-order J2 invariance by up to {:.2g}", worst_invariant);
  }
  text += ".";
  text += sizes_text(formation);
  if (inside > 0) {
    text += fmt::format(" {} of the {} orbits cannot be flown: they pass inside the body.", inside,
                        formation.deputies.size());
  }
  return formation.box ? text + " " + box_verdict(formation) : text;
}

TableView bounded_table(const BoundedFormation& formation) {
  ResultTable<BoundedDeputy> table(
      "bounded", "", {"deputies"},
      "Deputies that stay with the chief, of each size by each rule. Drifts are mean ones a "
      "revolution, in parts of the size.");
  const BoundedSettings& settings = *formation.scene.bounded;
  const double unit = formation.scene.units.time_s;
  table.add_scalar("verdict", "", "the outcome in words", bounded_verdict(formation));
  table.add_scalar("phase_deg", "deg", "the direction in which eccentricity vectors differ",
                   settings.phase_deg);
  table.add_scalar("cross_track", "",
                   "how far the deputy goes across the track, in parts of the size",
                   settings.cross_track);
  table.add_scalar("along_track", "",
                   "how far the deputy is ahead of the chief in the mean, in parts of the size",
                   settings.along_track);
  table.add_scalar("revolutions", "",
                   "the number of revolutions of the window over which all deputies are flown",
                   formation.revolutions);
  table.add_scalar("nodal_period_s", "s", "the nodal period at the chief's start",
                   formation.nodal_period * unit);
  table.add_scalar("mean_nodal_period_s", "s", "the chief's mean nodal period over the window",
                   formation.mean_period * unit);
  table.add_scalar("node_deg_per_revolution", "deg a revolution",
                   "the mean drift of the chief's node over the window",
                   formation.mean_node * 180 / std::numbers::pi);
  const auto is_there = [](const BoundedDeputy& deputy) { return deputy.failure.empty(); };
  const auto has_map = [](const BoundedDeputy& deputy) {
    return deputy.failure.empty() && is_of_map(deputy.rule);
  };
  table.add("wanted_m", "m", "the size that was asked for", &BoundedDeputy::wanted_m);
  table.add("rule", "", "the rule by which the deputy was chosen",
            [](const BoundedDeputy& deputy) { return name_of(deputy.rule); });
  table.add_if(is_there, "size_m", "m",
               "the largest distance from the chief over the first revolution",
               &BoundedDeputy::size_m);
  table.add_if(
      is_there, "least_size_m", "m",
      "the least size over one revolution, of the revolutions of the window that were looked at",
      &BoundedDeputy::least_size_m);
  table.add_if(is_there, "largest_size_m", "m",
               "the largest size over one revolution, of the same revolutions",
               &BoundedDeputy::largest_size_m);
  table.add_if(is_there, "last_size_m", "m",
               "the size over the revolution that begins at the end of the window",
               &BoundedDeputy::last_size_m);
  table.add_if(is_there, "held", "",
               "whether these sizes stay within a quarter of the one that was asked for",
               &BoundedDeputy::is_held);
  table.add_if(is_there, "eccentricity_difference", "",
               "the amplitude of the difference of the eccentricity vectors",
               &BoundedDeputy::amplitude);
  table.add_array("half_widths_m", {"half_width_r_m", "half_width_t_m", "half_width_n_m"}, "m",
                  "half of the deputy's extent along R, T and N over the first revolution",
                  [=](const BoundedDeputy& deputy) -> std::optional<Eigen::Vector3d> {
                    if (!is_there(deputy)) return std::nullopt;
                    return half_widths_m(deputy.first);
                  });
  add_drifts(table, 0, "tenth", "a tenth of the window");
  add_drifts(table, 1, "window", "the window");
  table.add_if(has_map, "period_difference", "",
               "the period of Kepler's ellipse over the chief's, less 1",
               &BoundedDeputy::period_difference);
  const CanonicalFactors told = told_factors(formation.scene);
  table.add_if(
      has_map, "momentum_difference_canonical", "",
      "the angular momentum about the axis less the chief's, canonical",
      [=](const BoundedDeputy& deputy) { return told.told_action(deputy.momentum_difference); });
  table.add_if(has_map, "refinements", "", "the number of iterations of Newton's method by flying",
               &BoundedDeputy::refinements);
  table.add_if(is_there, "lowest_m", "m",
               "the least distance from the centre over the revolutions that were looked at",
               &BoundedDeputy::lowest_m);
  for (std::size_t f = 0; f < BoundedDeputy{}.forms.size(); ++f) {
    const auto form = static_cast<DeputyForm>(f);
    for (std::size_t i = 0; i < 6; ++i) {
      const DeputyComponent& component = components_of(form)[i];
      table.add_if(is_there, fmt::format("{}.{}", form_key(form), component.name),
                   std::string(unit_of_component(component.name)),
                   fmt::format("the deputy's start as a scene has it: {}", component.help),
                   [=](const BoundedDeputy& deputy) { return deputy.forms[f][i]; });
    }
  }
  table.add("failure", "", "the reason why there is no such deputy", &BoundedDeputy::failure);
  return std::move(table).view(formation.deputies, {formation.deputies.size()});
}

std::vector<TableView> bounded_tables(const BoundedFormation& formation) {
  std::vector<TableView> tables = {bounded_table(formation)};
  if (formation.box) tables.push_back(box_table(formation));
  return tables;
}

Json bounded_json(const BoundedFormation& formation) {
  Json json = study_head_json(formation.scene, "bounded", scene_gauss_label(formation.scene));
  json.update(table_json(bounded_table(formation)));
  json["box"] = formation.box ? table_json(box_table(formation)) : Json(nullptr);
  json["seconds"] = {{"all", formation.seconds}, {"flights", formation.flight_seconds}};
  json["exit_code"] = exit_code_of(formation);
  return json;
}

StudyReport bounded_report(const BoundedFormation& formation, const ReportOrigin& origin) {
  StudyReport report;
  ChartDrawer drawer(origin.gnuplot);
  report.files = {{"bounded.csv", table_csv(bounded_table(formation))},
                  {"report.html", page(formation, origin, drawer)}};
  if (formation.box) report.files.push_back({"box.csv", table_csv(box_table(formation))});
  report.drawing_problem = drawer.problem();
  report.files.push_back({"summary.json", json_text(bounded_json(formation)) + "\n"});
  report.exit_code = exit_code_of(formation);
  if (report.exit_code == static_cast<int>(ErrorKind::numerical)) {
    report.failure =
        "bounded: none of the sizes has a deputy: " + formation.deputies.front().failure;
  } else if (report.exit_code != 0) {
    const bool is_of_box = formation.box && !formation.box->is_kept();
    report.failure = is_of_box ? box_failure(*formation.box)
                               : "bounded: a deputy is not of the size that was asked for, or "
                                 "passes below the surface; see the table";
  }
  report.table = terminal_table(formation);
  report.details = fmt::format("{} in all, {} for the flights\n", duration_text(formation.seconds),
                               duration_text(formation.flight_seconds));
  add_checks(report, formation.checks);
  return report;
}

}  // namespace hamjet::io
