#include "collision_section.hpp"

#include <fmt/format.h>

#include <cmath>

#include "../../formats/orbit_messages/encounter_message.hpp"
#include "../../text/html_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/time_axis.hpp"
#include "../drawing/along_time_charts.hpp"
#include "collision_table.hpp"

namespace hamjet::io {
namespace {

nlohmann::ordered_json collision_json(const CollisionResult& result) {
  nlohmann::ordered_json json = table_json(collision_table(result));
  json["whole_passage"] = nullptr;
  if (result.of_whole_passage) json["whole_passage"] = table_json(whole_passage_table(result));
  json["warnings"] = result.warnings;
  json["least_separation"] = table_json(least_separation_table(result));
  json.update(table_json(approaches_table(result)));
  const TableView planes = short_encounter_table(result);
  for (std::size_t k = 0; k < result.approaches.size(); ++k) {
    nlohmann::ordered_json& approach = json["approaches"][k];
    if (result.approaches[k].plane) {
      approach["short_encounter"] = row_json(planes, k);
    } else {
      approach["no_short_encounter"] = result.approaches[k].refusal;
    }
  }
  json["seconds"] = result.seconds;
  return json;
}

/// Whether the formulas of a short encounter hold, and why not.
std::string judgement(const UncertainApproach& approach) {
  const ShortEncounter& plane = *approach.plane;
  if (plane.holds()) {
    return std::string("motion is straight while they pass") +
           (approach.is_cut ? ", of the whole passage" : "");
  }
  const std::string passage = duration_text(2 * plane.passage);
  if (plane.is_cut) {
    return fmt::format("does not hold, the window cuts the passage of {} off", passage);
  }
  return fmt::format(
      "does not hold, the motion departs from a straight one by {:.2g} standard deviations in the "
      "{} of the passage",
      plane.departure, passage);
}

std::string plane_text(const UncertainApproach& approach) {
  if (!approach.plane) return fmt::format("    {}\n", approach.refusal);
  const ShortEncounter& plane = *approach.plane;
  std::string text =
      fmt::format("    as a short encounter {:.3e} (Foster, Alfano), {:.3e} (Chan): {}",
                  plane.alfano, plane.chan, judgement(approach));
  // Chan's disc is one of the density's standard deviations, of the same area.
  constexpr double much = 0.01;
  const double of_disc = plane.alfano > 0 ? plane.chan / plane.alfano - 1 : 0;
  if (plane.holds() && std::abs(of_disc) > much) {
    text += fmt::format(", but Chan's disc of the same area is off by {:+.2g} %", of_disc * 100);
  }
  return text + "\n";
}

/// A time after the start, or before it.
std::string moment_text(double seconds) {
  return (seconds < 0 ? "-" : "") + duration_text(std::abs(seconds));
}

/// What one order less makes of the probability.
std::string lower_order_text(const CollisionProbability& p, int order) {
  if (!(p.standard_error_of_change > 0)) {
    return fmt::format("  order {} gives the same answer for every sample that was compared\n",
                       order - 1);
  }
  if (!(p.probability > 0)) {
    return fmt::format("  by order {} it is {:.1e} +- {:.1e}\n", order - 1,
                       p.change_from_lower_order, p.standard_error_of_change);
  }
  return fmt::format("  by order {} it is {:+.1e} +- {:.1e} of it more\n", order - 1,
                     p.change_from_lower_order / p.probability,
                     p.standard_error_of_change / p.probability);
}

/// A probability with its interval, or why it was not sampled; what was not has no interval.
std::string probability_text(const CollisionProbability& p, double confidence) {
  if (p.samples == 0) return "0, not sampled: no path within 9 standard deviations comes so near";
  return fmt::format("{:.5g} ({:g} % from {:.5g} to {:.5g})", p.probability, confidence * 100,
                     p.lower, p.upper);
}

std::string collision_table_text(const CollisionResult& result) {
  const CollisionProbability& p = result.probability;
  std::string text = fmt::format(
      "collision nearer than {:.6g} m, {} to {} after the start, polynomials of order {}\n",
      result.watch.radius_m, moment_text(result.from_s), moment_text(result.to_s), result.order);
  if (result.is_widened) {
    text += fmt::format(
        "  the window is wider than the scene, {:.9g} s to {:.9g} s, to hold the whole passage "
        "that "
        "an end of the scene lies in\n",
        result.from_s, result.to_s);
  }
  if (p.samples == 0) {
    text += fmt::format("  probability {}\n", probability_text(p, result.watch.confidence));
  } else {
    text += fmt::format("  probability {:.4e}, {:g} % from {:.4e} to {:.4e}: {} {} samples",
                        p.probability, result.watch.confidence * 100, p.lower, p.upper, p.samples,
                        p.sampling == CollisionSampling::plain ? "plain" : "weighted");
    if (p.sampling != CollisionSampling::plain) {
      text += fmt::format(", as good as {:.2g} plain ones", p.equivalent_samples);
    }
    if (p.parts > 1) text += fmt::format(", of {} pairs of parts of both", p.parts);
    text += fmt::format("\n  in it: distances along a path are right to {:.1e} m\n", p.path_error);
    if (result.order > 1) text += lower_order_text(p, result.order);
  }
  if (const auto& whole = result.of_whole_passage) {
    text += fmt::format("  of the whole passage {}\n",
                        probability_text(*whole, result.watch.confidence));
  }
  text += "  least separation in the window:";
  for (std::size_t k = 0; k < result.separations.shares.size(); ++k) {
    text += fmt::format("{} {:g} % below {:.4g} m", k == 0 ? "" : ",",
                        result.separations.shares[k] * 100, result.separations.separations[k]);
  }
  text +=
      fmt::format(" ({} plain samples, {} flights within {:.1e} m)\n", result.separations.samples,
                  result.separations.flights, result.separations.flight_difference);
  if (result.approaches.empty()) text += "  the means have no closest approach in the window\n";
  for (const UncertainApproach& approach : result.approaches) {
    text += fmt::format(
        "  closest approach of the means {:.6g} s{}: {:.6g} m at {:.4g} m/s; 1 sigma {:.3g} s and "
        "{:.3g} m; ",
        approach.time_s, approach.is_in_window ? "" : " (outside the window)", approach.distance_m,
        approach.speed_m_s, approach.time_deviation_s, approach.distance_deviation_m);
    text += approach.holds(result.watch.radius_m)
                ? fmt::format("its polynomials are within {:.1e} m and {:.1e} s of {} flights\n",
                              approach.position_error_m, approach.time_error_s, approach.flights)
                : "its polynomials in the deviations do not hold, the time varies too much\n";
    text += plane_text(approach);
  }
  return text;
}

Chart probability_chart(const Scene& scene, const CollisionResult& result) {
  const CollisionProbability& p = result.probability;
  const TimeAxis axis = time_axis(result.to_s);
  Chart chart;
  chart.name = "collision";
  chart.title = "Probability of having come nearer";
  chart.x.label = fmt::format("time ({})", axis.name);
  add_revolutions(scene, axis.seconds, chart.x);
  chart.y.label = fmt::format("probability of less than {:g} m", result.watch.radius_m);
  chart.reading = "How likely it is that both have come nearer than the radius by a time.";
  ChartCurve curve = unmarked_line();
  for (std::size_t k = 0; k < p.times.size(); ++k) {
    curve.points.emplace_back(p.times[k] / axis.seconds, p.by_time[k]);
  }
  chart.curves.push_back(std::move(curve));
  for (const UncertainApproach& approach : result.approaches) {
    chart.rules.push_back({true, approach.time_s / axis.seconds, "approach of the means", false});
  }
  return chart;
}

}  // namespace

UncertaintySection collision_section(const Scene& scene, const CollisionResult& result) {
  UncertaintySection section;
  section.key = "collision";
  section.json = collision_json(result);
  const CollisionProbability& p = result.probability;
  section.verdict =
      fmt::format("The probability of coming nearer than {:g} m is {}.", result.watch.radius_m,
                  probability_text(p, result.watch.confidence));
  if (const auto& whole = result.of_whole_passage) {
    section.verdict += fmt::format(
        " But an edge of the window lies inside the passage, of the whole of which it is {}.",
        probability_text(*whole, result.watch.confidence));
  }
  if (result.is_cut_by_burn) {
    section.verdict +=
        " But the burn at the start lies inside the passage, of which this is a part.";
  }
  if (!has_whole_passage(result)) {
    section.verdict +=
        " But the window is a part of a slow encounter, the rest of which it leaves out.";
  }
  section.warnings = result.warnings;
  section.table = collision_table_text(result);
  section.title = "Collision";
  if (p.probability > 0) section.charts.push_back(probability_chart(scene, result));
  section.files.push_back({"collision.csv", table_csv(collision_table(result))});
  const auto lack = encounter_message_lack(scene, result);
  if (!lack) {
    section.files.push_back({"encounter.cdm", cdm_text(encounter_message(scene, result))});
    section.json["message"] = "encounter.cdm";
  } else {
    section.json["no_message"] = *lack;
    section.table += fmt::format("  no conjunction data message: {}\n", *lack);
  }
  section.html = fmt::format("<pre>{}</pre>\n", escape_html(section.table));
  return section;
}

}  // namespace hamjet::io
