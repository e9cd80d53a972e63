#include "collision_section.hpp"

#include <fmt/format.h>

#include <cmath>

#include "../../formats/orbit_messages/encounter_message.hpp"
#include "../../store/csv_values.hpp"
#include "../../store/json_values.hpp"
#include "../../text/html_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/time_axis.hpp"
#include "../drawing/along_time_charts.hpp"

namespace hamjet::io {
namespace {

nlohmann::ordered_json plane_json(const ShortEncounter& plane) {
  return {{"foster", plane.foster},
          {"alfano", plane.alfano},
          {"chan", plane.chan},
          {"offset_m", plane.offset},
          {"deviation_m", plane.deviation},
          {"passage_s", plane.passage},
          {"departure", plane.departure},
          {"cut_by_window", plane.is_cut},
          {"holds", plane.holds()}};
}

nlohmann::ordered_json approach_json(const UncertainApproach& approach, double radius_m) {
  const auto of_flights = [&](double error) {
    return approach.flights > 0 ? nlohmann::ordered_json(error) : nlohmann::ordered_json();
  };
  nlohmann::ordered_json json = {{"time_s", approach.time_s},
                                 {"distance_m", approach.distance_m},
                                 {"speed_m_s", approach.speed_m_s},
                                 {"time_deviation_s", approach.time_deviation_s},
                                 {"distance_deviation_m", approach.distance_deviation_m},
                                 {"flights", approach.flights},
                                 {"polynomials_hold", approach.holds(radius_m)},
                                 {"position_error_m", of_flights(approach.position_error_m)},
                                 {"time_error_s", of_flights(approach.time_error_s)}};
  if (approach.plane) {
    json["short_encounter"] = plane_json(*approach.plane);
  } else {
    json["no_short_encounter"] = approach.refusal;
  }
  return json;
}

template <class Enumerator, std::size_t Count>
std::string_view name_in(const std::array<std::string_view, Count>& names, Enumerator value) {
  return names[static_cast<std::size_t>(value)];
}

nlohmann::ordered_json collision_json(const CollisionResult& result) {
  const CollisionProbability& p = result.probability;
  nlohmann::ordered_json json = {{"radius_m", result.watch.radius_m},
                                 {"window_s", {result.from_s, result.to_s}},
                                 {"window_widened", result.is_widened},
                                 {"event", name_in(collision_event_names, result.watch.event)},
                                 {"order", result.order},
                                 {"sampling", name_in(collision_sampling_names, p.sampling)},
                                 {"probability", p.probability},
                                 {"confidence", result.watch.confidence},
                                 {"interval", {p.lower, p.upper}},
                                 {"path_error_m", p.path_error},
                                 {"standard_error", p.standard_error},
                                 {"samples", p.samples},
                                 {"hits", p.hits},
                                 {"equivalent_samples", p.equivalent_samples},
                                 {"change_from_lower_order", p.change_from_lower_order},
                                 {"standard_error_of_change", p.standard_error_of_change}};
  if (p.sampled_radius) json["sampled_radius_m"] = *p.sampled_radius;
  if (p.largest_difference) json["largest_difference_m"] = *p.largest_difference;
  json["whole_passage"] = nullptr;
  if (const auto& whole = result.of_whole_passage) {
    json["whole_passage"] = {{"window_s", {result.whole_from_s, result.whole_to_s}},
                             {"probability", whole->probability},
                             {"interval", {whole->lower, whole->upper}},
                             {"path_error_m", whole->path_error},
                             {"standard_error", whole->standard_error}};
  }
  json["warnings"] = result.warnings;
  json["least_separation"] = {{"samples", result.separations.samples},
                              {"shares", result.separations.shares},
                              {"separations_m", result.separations.separations},
                              {"errors_m", result.separations.errors},
                              {"flights", result.separations.flights},
                              {"flight_difference_m", result.separations.flight_difference},
                              {"lower_m", result.separations.lower},
                              {"upper_m", nlohmann::ordered_json::array()}};
  for (const double upper : result.separations.upper) {
    json["least_separation"]["upper_m"].push_back(json_number(upper));
  }
  json["approaches"] = nlohmann::ordered_json::array();
  for (const UncertainApproach& approach : result.approaches) {
    json["approaches"].push_back(approach_json(approach, result.watch.radius_m));
  }
  json["seconds"] = result.seconds;
  return json;
}

/// Whether the formulas of a short encounter hold, and why not.
std::string judgement(const ShortEncounter& plane) {
  if (plane.holds()) return "motion is straight while they pass";
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
                  plane.alfano, plane.chan, judgement(plane));
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
    return fmt::format("  order {} decides alike on every sample that was compared\n", order - 1);
  }
  if (!(p.probability > 0)) {
    return fmt::format("  by order {} it is {:.1e} +- {:.1e}\n", order - 1,
                       p.change_from_lower_order, p.standard_error_of_change);
  }
  return fmt::format("  by order {} it is {:+.1e} +- {:.1e} of it more\n", order - 1,
                     p.change_from_lower_order / p.probability,
                     p.standard_error_of_change / p.probability);
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
    text += "  probability 0: no path within 9 standard deviations comes near\n";
  } else {
    text += fmt::format("  probability {:.4e}, {:g} % from {:.4e} to {:.4e}: {} {} samples",
                        p.probability, result.watch.confidence * 100, p.lower, p.upper, p.samples,
                        p.sampling == CollisionSampling::plain ? "plain" : "weighted");
    if (p.sampling != CollisionSampling::plain) {
      text += fmt::format(", as good as {:.2g} plain ones", p.equivalent_samples);
    }
    text += fmt::format("\n  in it: distances along a path are right to {:.1e} m\n", p.path_error);
    if (result.order > 1) text += lower_order_text(p, result.order);
  }
  if (const auto& whole = result.of_whole_passage) {
    text +=
        fmt::format("  of the whole passage {:.4e}, {:g} % from {:.4e} to {:.4e}\n",
                    whole->probability, result.watch.confidence * 100, whole->lower, whole->upper);
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
        "  closest approach of the means {:.6g} s: {:.6g} m at {:.4g} m/s; 1 sigma {:.3g} s and "
        "{:.3g} m; ",
        approach.time_s, approach.distance_m, approach.speed_m_s, approach.time_deviation_s,
        approach.distance_deviation_m);
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
  ChartCurve curve;
  curve.has_markers = false;
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
  section.verdict = fmt::format(
      "The probability of coming nearer than {:g} m is {:.5g} ({:g} % from {:.5g} to "
      "{:.5g}).",
      result.watch.radius_m, p.probability, result.watch.confidence * 100, p.lower, p.upper);
  section.warnings = result.warnings;
  section.table = collision_table_text(result);
  section.title = "Collision";
  if (p.probability > 0) section.charts.push_back(probability_chart(scene, result));
  std::string csv = "time_s,probability\n";
  for (std::size_t k = 0; k < p.times.size(); ++k) {
    csv += fmt::format("{},{}\n", csv_number(p.times[k]), csv_number(p.by_time[k]));
  }
  section.files.push_back({"collision.csv", csv});
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
