#include "bounded_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../store/columns.hpp"
#include "../../store/json_text.hpp"
#include "../../store/json_values.hpp"
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
  const bool is_kept = (!formation.box || formation.box->is_held()) &&
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
      " {}: of {} that was asked for, {} by {} is {} over the first revolution and {} to {} within "
      "the window{}.",
      held == offered
          ? "Sizes are held to a quarter"
          : fmt::format("NOT HELD are the sizes of {} of {} deputies", offered - held, offered),
      length_text(worst->wanted_m), "the one furthest from it", name_of(worst->rule),
      length_text(worst->size_m), length_text(worst->least_size_m),
      length_text(worst->largest_size_m),
      std::abs(worst->last_size_m / worst->size_m - 1) > 0.01
          ? fmt::format(", at its end {}", length_text(worst->last_size_m))
          : "");
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

std::string bounded_csv(const BoundedFormation& formation) {
  Columns<BoundedDeputy> columns;
  const auto is_there = [](const BoundedDeputy& deputy) { return deputy.failure.empty(); };
  const auto has_map = [](const BoundedDeputy& deputy) {
    return deputy.failure.empty() && is_of_map(deputy.rule);
  };
  columns.add("wanted_m", &BoundedDeputy::wanted_m);
  columns.add("rule", [](const BoundedDeputy& deputy) { return name_of(deputy.rule); });
  columns.add_if(is_there, "size_m", &BoundedDeputy::size_m);
  columns.add_if(is_there, "least_size_m", &BoundedDeputy::least_size_m);
  columns.add_if(is_there, "largest_size_m", &BoundedDeputy::largest_size_m);
  columns.add_if(is_there, "last_size_m", &BoundedDeputy::last_size_m);
  columns.add_if(is_there, "held", &BoundedDeputy::is_held);
  columns.add_if(is_there, "eccentricity_difference", &BoundedDeputy::amplitude);
  constexpr std::array<std::string_view, 3> axes = {"r", "t", "n"};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    columns.add_if(is_there, fmt::format("half_width_{}_m", axes[i]),
                   [=](const BoundedDeputy& deputy) {
                     return half_widths_m(deputy.first)[static_cast<Eigen::Index>(i)];
                   });
  }
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    const std::string when = k == 0 ? "tenth" : "window";
    const auto drift = [=](const BoundedDeputy& deputy) { return deputy.drifts[k]; };
    columns.add_if(is_there, when + "_revolutions",
                   [=](const BoundedDeputy& deputy) { return drift(deputy).revolutions; });
    columns.add_if(is_there, when + "_along_drift",
                   [=](const BoundedDeputy& deputy) { return drift(deputy).along; });
    columns.add_if(is_there, when + "_along_doubt",
                   [=](const BoundedDeputy& deputy) { return drift(deputy).along_doubt; });
    columns.add_if(is_there, when + "_cross_drift",
                   [=](const BoundedDeputy& deputy) { return drift(deputy).cross; });
    columns.add_if(is_there, when + "_along_range",
                   [=](const BoundedDeputy& deputy) { return drift(deputy).range; });
  }
  columns.add_if(has_map, "period_difference", &BoundedDeputy::energy);
  const CanonicalFactors told = told_factors(formation.scene);
  columns.add_if(has_map, "momentum_difference_canonical",
                 [=](const BoundedDeputy& deputy) { return told.told_action(deputy.momentum); });
  columns.add_if(has_map, "refinements", &BoundedDeputy::refinements);
  columns.add_if(is_there, "lowest_m", &BoundedDeputy::lowest_m);
  for (std::size_t f = 0; f < BoundedDeputy{}.forms.size(); ++f) {
    const auto form = static_cast<DeputyForm>(f);
    for (std::size_t i = 0; i < 6; ++i) {
      columns.add_if(is_there, fmt::format("{}.{}", form_key(form), components_of(form)[i].name),
                     [=](const BoundedDeputy& deputy) { return deputy.forms[f][i]; });
    }
  }
  columns.add("failure", &BoundedDeputy::failure);
  return columns.csv(formation.deputies);
}

Json bounded_json(const BoundedFormation& formation) {
  Json json = study_head_json(formation.scene, "bounded", scene_gauss_label(formation.scene));
  const BoundedSettings& settings = *formation.scene.bounded;
  json["verdict"] = bounded_verdict(formation);
  json["phase_deg"] = settings.phase_deg;
  json["cross_track"] = settings.cross_track;
  json["along_track"] = settings.along_track;
  json["revolutions"] = formation.revolutions;
  const double unit = formation.scene.units.time_s;
  json["nodal_period_s"] = formation.nodal_period * unit;
  json["mean_nodal_period_s"] = formation.mean_period * unit;
  json["node_deg_per_revolution"] = formation.mean_node * 180 / std::numbers::pi;
  json["deputies"] = Json::array();
  for (const BoundedDeputy& deputy : formation.deputies) {
    Json entry = {{"wanted_m", deputy.wanted_m},
                  {"rule", name_of(deputy.rule)},
                  {"failure", text_or_null(deputy.failure)},
                  {"size_m", nullptr},
                  {"least_size_m", nullptr},
                  {"largest_size_m", nullptr},
                  {"last_size_m", nullptr},
                  {"held", nullptr},
                  {"eccentricity_difference", nullptr},
                  {"half_widths_m", nullptr},
                  {"lowest_m", nullptr},
                  {"refinements", nullptr},
                  {"drifts", nullptr},
                  {"start", nullptr}};
    if (deputy.failure.empty()) {
      entry["size_m"] = json_number(deputy.size_m);
      entry["least_size_m"] = json_number(deputy.least_size_m);
      entry["largest_size_m"] = json_number(deputy.largest_size_m);
      entry["last_size_m"] = json_number(deputy.last_size_m);
      entry["held"] = deputy.is_held();
      entry["eccentricity_difference"] = json_number(deputy.amplitude);
      entry["half_widths_m"] = vector_json(half_widths_m(deputy.first));
      entry["lowest_m"] = json_number(deputy.lowest_m);
      if (is_of_map(deputy.rule)) entry["refinements"] = deputy.refinements;
      entry["drifts"] = Json::array();
      for (const BoundedDrift& drift : deputy.drifts) {
        entry["drifts"].push_back({{"revolutions", drift.revolutions},
                                   {"along", json_number(drift.along)},
                                   {"along_doubt", json_number(drift.along_doubt)},
                                   {"cross", json_number(drift.cross)},
                                   {"along_range", json_number(drift.range)}});
      }
      entry["start"] = Json::object();
      for (std::size_t f = 0; f < deputy.forms.size(); ++f) {
        const auto form = static_cast<DeputyForm>(f);
        Json& numbers = entry["start"][form_key(form)];
        for (std::size_t i = 0; i < 6; ++i) {
          numbers[std::string(components_of(form)[i].name)] = json_number(deputy.forms[f][i]);
        }
      }
    }
    json["deputies"].push_back(std::move(entry));
  }
  json["box"] = formation.box ? box_json(formation) : Json(nullptr);
  json["seconds"] = {{"all", formation.seconds}, {"flights", formation.flight_seconds}};
  json["exit_code"] = exit_code_of(formation);
  return json;
}

StudyReport bounded_report(const BoundedFormation& formation, const ReportOrigin& origin) {
  StudyReport report;
  ChartDrawer drawer(origin.gnuplot);
  report.files = {{"bounded.csv", bounded_csv(formation)},
                  {"report.html", page(formation, origin, drawer)}};
  if (formation.box) report.files.push_back({"box.csv", box_csv(formation)});
  report.drawing_problem = drawer.problem();
  report.files.push_back({"summary.json", json_text(bounded_json(formation)) + "\n"});
  report.exit_code = exit_code_of(formation);
  if (report.exit_code == static_cast<int>(ErrorKind::numerical)) {
    report.failure =
        "bounded: none of the sizes has a deputy: " + formation.deputies.front().failure;
  } else if (report.exit_code != 0) {
    const bool is_of_box = formation.box && !formation.box->is_held();
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
