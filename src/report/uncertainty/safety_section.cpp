#include "safety_section.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../../text/quantity_text.hpp"
#include "../../text/terminal_text.hpp"
#include "../drawing/report_page.hpp"
#include "safety_table.hpp"

namespace hamjet::io {
namespace {

std::string burn_text(const SafetyPair& pair) {
  if (*pair.burn_share == 0) return "not done";
  if (*pair.burn_share == 1) return "done";
  return fmt::format("{:g} % done", 100 * *pair.burn_share);
}

std::string pair_text(const SafetyPair& pair) { return pair.first + " and " + pair.second; }

/// With the share of the burn, if the pair has a part in it.
std::string case_text(const SafetyPair& pair) {
  return pair_text(pair) + (pair.burn_share ? ", burn " + burn_text(pair) : "");
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

/// Of the checks that the scene asks for, a sentence for each pair that fails one.
std::vector<std::string> failed_checks(const SafetyResult& result) {
  const SafetyWatch& watch = result.watch;
  std::vector<std::string> failed;
  for (const SafetyPair& pair : result.pairs) {
    const std::string whose = case_text(pair);
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
            : "the size up to which the ellipsoid stays free was not found",
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

nlohmann::ordered_json safety_json(const SafetyResult& result) {
  nlohmann::ordered_json json = table_json(safety_table(result));
  // The rows come behind what is said of all of them.
  const nlohmann::ordered_json pairs = std::move(json["pairs"]);
  json.erase("pairs");
  json["warnings"] = warnings_of(result);
  json["failed_checks"] = failed_checks(result);
  json["pairs"] = pairs;
  json["seconds"] = result.seconds;
  return json;
}

std::vector<std::vector<std::string>> safety_rows(const SafetyResult& result) {
  std::vector<std::vector<std::string>> rows = {{"pair"}};
  rows[0].emplace_back("least of means (m)");
  rows[0].push_back(fmt::format("{:g} % beyond (m)", 100 * result.watch.share));
  rows[0].push_back(fmt::format("{:g} % interval", 100 * result.watch.confidence));
  rows[0].push_back(fmt::format("nearer than {:g} m", result.watch.keep_apart_m));
  if (result.watch.keep_out_m) rows[0].emplace_back("keeps out up to");
  for (const SafetyPair& pair : result.pairs) {
    const LeastSeparations& s = pair.separations;
    // A table that is broken in two repeats its first column alone.
    rows.push_back({case_text(pair)});
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
    ChartCurve curve = unmarked_line(case_text(pair), style++);
    for (std::size_t k = 1; k < pair.separations.shares.size(); ++k) {
      curve.points.emplace_back(pair.separations.separations[k], pair.separations.shares[k]);
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
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
  section.files.push_back({"safety.csv", table_csv(safety_table(result))});
  return section;
}

}  // namespace hamjet::io
