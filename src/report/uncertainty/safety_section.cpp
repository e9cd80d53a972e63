#include "safety_section.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../../store/csv_values.hpp"
#include "../../store/json_values.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/terminal_text.hpp"
#include "../drawing/report_page.hpp"

namespace hamjet::io {
namespace {

std::string burn_text(const SafetyPair& pair) {
  if (!pair.burn_share) return "no part in it";
  if (*pair.burn_share == 0) return "not done";
  if (*pair.burn_share == 1) return "done";
  return fmt::format("{:g} % done", 100 * *pair.burn_share);
}

std::string pair_text(const SafetyPair& pair) { return pair.first + " and " + pair.second; }

/// Whether the flight with the deviation that is told does not touch the ellipsoid.
bool is_in_doubt(const SafetyPair& pair) {
  return pair.margin && pair.margin->deviations.value_or(0) > 0 && !pair.margin->is_confirmed();
}

std::string margin_text(const SafetyPair& pair) {
  if (pair.margin) {
    return pair.margin->deviations ? fmt::format("{:.3g} sigma at {}{}", *pair.margin->deviations,
                                                 duration_text(pair.margin->time),
                                                 is_in_doubt(pair) ? ", in doubt" : "")
                                   : "any";
  }
  return pair.refusal.empty() ? "-" : "not found";
}

double nearer_share(const SafetyPair& pair) {
  return static_cast<double>(pair.separations.nearer) /
         static_cast<double>(pair.separations.samples);
}

bool has_burn(const SafetyResult& result) {
  for (const SafetyPair& pair : result.pairs) {
    if (pair.burn_share) return true;
  }
  return false;
}

/// Of the checks that the scene asks for, a sentence for each pair that fails one.
std::vector<std::string> failed_checks(const SafetyResult& result) {
  const SafetyWatch& watch = result.watch;
  std::vector<std::string> failed;
  for (const SafetyPair& pair : result.pairs) {
    const std::string whose =
        pair_text(pair) + (pair.burn_share ? ", burn " + burn_text(pair) : "");
    const double surely = pair.separations.lower[0];
    if (watch.least_separation_m && !(surely >= *watch.least_separation_m)) {
      failed.push_back(fmt::format(
          "{}: {:g} % of cases stay beyond {:.4g} m, at {:g} % confidence, must be {:g} m "
          "(uncertainty.safety.least_separation_m)",
          whose, 100 * watch.share, surely, 100 * watch.confidence, *watch.least_separation_m));
    }
    if (!watch.least_deviations || pair.first != "chief") continue;
    // Without a deviation that leads into it the ellipsoid is free up to any.
    if (pair.margin && !is_in_doubt(pair) &&
        (!pair.margin->deviations || *pair.margin->deviations >= *watch.least_deviations)) {
      continue;
    }
    failed.push_back(fmt::format(
        "{}: {}, must be {:g} sigma (uncertainty.safety.least_deviations)", whose,
        pair.margin
            ? fmt::format("the ellipsoid stays free up to {:.4g} sigma{}", *pair.margin->deviations,
                          is_in_doubt(pair) ? ", which its flight does not confirm" : "")
            : "how far the ellipsoid stays free was not found",
        *watch.least_deviations));
  }
  return failed;
}

/// A sentence for each pair whose numbers are not to be trusted; what a share of the burn does not
/// change is said once.
std::vector<std::string> warnings_of(const SafetyResult& result) {
  std::vector<std::string> warnings;
  const auto add = [&](const std::string& warning) {
    if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) {
      warnings.push_back(warning);
    }
  };
  for (const SafetyPair& pair : result.pairs) {
    if (pair.warning) add(pair_text(pair) + ": " + *pair.warning);
    if (is_in_doubt(pair)) {
      add(
          fmt::format("{}: the flight with the {:.3g} sigma that are told comes to {:.3g} of the "
                      "ellipsoid, not to its surface",
                      pair_text(pair), *pair.margin->deviations, pair.margin->flown_ratio));
    }
  }
  return warnings;
}

nlohmann::ordered_json pair_json(const SafetyPair& pair) {
  const LeastSeparations& s = pair.separations;
  nlohmann::ordered_json json = {{"first", pair.first},
                                 {"second", pair.second},
                                 {"burn_share", nullptr},
                                 {"mean_separation_m", pair.mean_separation_m},
                                 {"separation_m", s.separations[0]},
                                 {"separation_interval_m", {s.lower[0], json_number(s.upper[0])}},
                                 {"separation_error_m", s.errors[0]},
                                 {"samples", s.samples},
                                 {"nearer", s.nearer},
                                 {"probability_nearer", nearer_share(pair)},
                                 {"probability_nearer_interval", {s.lower_nearer, s.upper_nearer}},
                                 {"flights", s.flights},
                                 {"flight_difference_m", s.flight_difference}};
  if (pair.burn_share) json["burn_share"] = *pair.burn_share;
  if (pair.margin) {
    nlohmann::ordered_json margin = {{"deviations", nullptr}};
    if (pair.margin->deviations) {
      margin = {{"deviations", *pair.margin->deviations},
                {"time_s", pair.margin->time},
                {"flown_ratio", pair.margin->flown_ratio},
                {"in_doubt", is_in_doubt(pair)}};
    }
    json["keep_out"] = margin;
  } else if (!pair.refusal.empty()) {
    json["no_keep_out"] = pair.refusal;
  }
  return json;
}

nlohmann::ordered_json safety_json(const SafetyResult& result) {
  nlohmann::ordered_json json = {{"keep_apart_m", result.watch.keep_apart_m},
                                 {"window_s", {result.from_s, result.to_s}},
                                 {"share", result.watch.share},
                                 {"confidence", result.watch.confidence},
                                 {"order", result.order}};
  if (result.watch.keep_out_m) {
    const Eigen::Vector3d& axes = *result.watch.keep_out_m;
    json["keep_out_m"] = {axes[0], axes[1], axes[2]};
  }
  if (const auto& least = result.watch.least_separation_m) json["least_separation_m"] = *least;
  if (const auto& least = result.watch.least_deviations) json["least_deviations"] = *least;
  json["warnings"] = warnings_of(result);
  json["failed_checks"] = failed_checks(result);
  json["pairs"] = nlohmann::ordered_json::array();
  for (const SafetyPair& pair : result.pairs) json["pairs"].push_back(pair_json(pair));
  json["seconds"] = result.seconds;
  return json;
}

std::vector<std::vector<std::string>> safety_rows(const SafetyResult& result) {
  const bool with_burn = has_burn(result);
  std::vector<std::vector<std::string>> rows = {{"pair"}};
  if (with_burn) rows[0].emplace_back("burn");
  rows[0].emplace_back("least of means (m)");
  rows[0].push_back(fmt::format("{:g} % beyond (m)", 100 * result.watch.share));
  rows[0].push_back(fmt::format("{:g} % interval", 100 * result.watch.confidence));
  rows[0].push_back(fmt::format("nearer than {:g} m", result.watch.keep_apart_m));
  if (result.watch.keep_out_m) rows[0].emplace_back("keeps out up to");
  for (const SafetyPair& pair : result.pairs) {
    const LeastSeparations& s = pair.separations;
    rows.push_back({pair_text(pair)});
    if (with_burn) rows.back().push_back(burn_text(pair));
    rows.back().push_back(fmt::format("{:.4g}", pair.mean_separation_m));
    rows.back().push_back(fmt::format("{:.4g}", s.separations[0]));
    rows.back().push_back(fmt::format("{:.4g} to {:.4g}", s.lower[0], s.upper[0]));
    rows.back().push_back(fmt::format("{:.3g} to {:.3g}", s.lower_nearer, s.upper_nearer));
    if (result.watch.keep_out_m) rows.back().push_back(margin_text(pair));
  }
  return rows;
}

std::string notes_of(const SafetyResult& result) {
  double difference = 0;
  long flights = 0;
  std::string text;
  for (const SafetyPair& pair : result.pairs) {
    difference = std::max(difference, pair.separations.flight_difference);
    flights += pair.separations.flights;
    if (!pair.refusal.empty()) text += fmt::format("  {}: {}\n", pair_text(pair), pair.refusal);
  }
  return text + fmt::format("  least separations are within {:.1e} m of {} flights\n", difference,
                            flights);
}

std::string safety_table_text(const SafetyResult& result) {
  return fmt::format(
      "passive safety, {} to {} after the start, polynomials of order {}, {} samples a row\n{}{}",
      duration_text(result.from_s), duration_text(result.to_s), result.order,
      result.pairs.front().separations.samples, aligned_table(safety_rows(result)),
      notes_of(result));
}

std::string safety_verdict(const SafetyResult& result) {
  const SafetyPair& least = least_safe_pair(result);
  return fmt::format(
      "In {:g} % of cases {} stay beyond {:.4g} m of each other ({:g} % from {:.4g} to {:.4g}){}, "
      "{} the {:g} m to be kept.",
      100 * result.watch.share, pair_text(least), least.separations.separations[0],
      100 * result.watch.confidence, least.separations.lower[0], least.separations.upper[0],
      least.burn_share ? fmt::format(" with the burn {}", burn_text(least)) : "",
      least.separations.separations[0] < result.watch.keep_apart_m ? "less than" : "at least",
      result.watch.keep_apart_m);
}

/// How many cases come nearer than a separation.
Chart separations_chart(const SafetyResult& result) {
  Chart chart;
  chart.name = "safety";
  chart.title = "Least separations";
  chart.x.label = "least separation (m)";
  chart.y.label = "share of cases that come nearer";
  chart.reading =
      "The least separation of each pair in the window, as its samples are distributed.";
  chart.rules.push_back({true, result.watch.keep_apart_m, "to be kept", false});
  std::size_t style = 0;
  for (const SafetyPair& pair : result.pairs) {
    ChartCurve curve;
    curve.title = pair_text(pair);
    if (pair.burn_share) curve.title += ", burn " + burn_text(pair);
    curve.style = style++;
    curve.has_markers = false;
    for (std::size_t k = 1; k < pair.separations.shares.size(); ++k) {
      curve.points.emplace_back(pair.separations.separations[k], pair.separations.shares[k]);
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

std::string safety_csv(const SafetyResult& result) {
  std::string csv =
      "first,second,burn_share,mean_separation_m,separation_m,separation_lower_m,"
      "separation_upper_m,samples,nearer,probability_lower,probability_upper,"
      "flight_difference_m,keep_out_deviations,keep_out_time_s,keep_out_flown_ratio\n";
  for (const SafetyPair& pair : result.pairs) {
    const LeastSeparations& s = pair.separations;
    const bool touches = pair.margin && pair.margin->deviations;
    const auto of_margin = [&](double value) { return touches ? csv_number(value) : ""; };
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", pair.first, pair.second,
                       csv_number(pair.burn_share), csv_number(pair.mean_separation_m),
                       csv_number(s.separations[0]), csv_number(s.lower[0]), csv_number(s.upper[0]),
                       s.samples, s.nearer, csv_number(s.lower_nearer), csv_number(s.upper_nearer),
                       csv_number(s.flight_difference),
                       of_margin(touches ? *pair.margin->deviations : 0),
                       of_margin(touches ? pair.margin->time : 0),
                       of_margin(touches ? pair.margin->flown_ratio : 0));
  }
  return csv;
}

}  // namespace

UncertaintySection safety_section(const SafetyResult& result) {
  UncertaintySection section;
  section.key = "safety";
  section.json = safety_json(result);
  section.verdict = safety_verdict(result);
  section.table = safety_table_text(result);
  section.title = "Passive safety";
  section.html =
      table_html("Least separations, and how large deviations may be", safety_rows(result));
  section.charts.push_back(separations_chart(result));
  section.warnings = warnings_of(result);
  section.failed_checks = failed_checks(result);
  section.files.push_back({"safety.csv", safety_csv(result)});
  return section;
}

}  // namespace hamjet::io
