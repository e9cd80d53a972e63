#include "collision_table.hpp"

#include <fmt/format.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "../../store/result_table.hpp"

namespace hamjet::io {
namespace {

/// The probability of having come nearer by a time.
struct TimeRow {
  double time_s;
  double probability;
};

template <class Row>
void add_probability(ResultTable<Row>& table, const CollisionProbability& p) {
  table.add_scalar("probability", "",
                   "the probability that the spacecraft come nearer than the radius",
                   p.probability);
}
template <class Row>
void add_interval(ResultTable<Row>& table, const CollisionProbability& p) {
  table.add_scalars(
      "interval", "",
      "the interval of the probability at that confidence, for what samples and paths leave open",
      std::array{p.lower, p.upper});
  table.add_scalar("path_error_m", "m", "by how much distances along a path may be wrong",
                   p.path_error);
  table.add_scalar("standard_error", "", "the standard error of the probability by its samples",
                   p.standard_error);
}

std::vector<const UncertainApproach*> approaches_of(const CollisionResult& result) {
  std::vector<const UncertainApproach*> rows;
  for (const UncertainApproach& approach : result.approaches) rows.push_back(&approach);
  return rows;
}

}  // namespace

TableView collision_table(const CollisionResult& result) {
  const CollisionProbability& p = result.probability;
  ResultTable<TimeRow> table("collision", "/collision", {"times"},
                             "How likely chief and deputy are to come nearer than the radius.");
  table.leave_rows_out_of_json();
  table.add_scalar("radius_m", "m", "the sum of the radii of both spacecraft",
                   result.watch.radius_m);
  table.add_scalars("window_s", "s", "the window of time that was looked at, after the start",
                    std::array{result.from_s, result.to_s});
  table.add_scalar("window_widened", "",
                   "whether the window is wider than the scene's, so that it holds a whole passage",
                   result.is_widened);
  table.add_scalar("event", "", "what counts as a collision",
                   collision_event_names[static_cast<std::size_t>(result.watch.event)]);
  table.add_scalars("gaussian_in", "",
                    "the coordinates in which the starts of chief and deputy are Gaussian",
                    std::vector<std::string>(result.gaussian_in.begin(), result.gaussian_in.end()));
  table.add_scalar("order", "", "the order of the polynomials", result.order);
  table.add_scalar("sampling", "", "how samples were drawn",
                   collision_sampling_names[static_cast<std::size_t>(p.sampling)]);
  table.add_scalar(
      "parts", "",
      "the number of pairs of parts of both distributions, each with polynomials about "
      "its own mean, that were sampled; 1 for whole ones, 0 where no path comes near",
      p.parts);
  add_probability(table, p);
  table.add_scalar("confidence", "", "the confidence of the intervals", result.watch.confidence);
  add_interval(table, p);
  table.add_scalar("samples", "",
                   "the number of samples that were drawn; 0 where no path comes near", p.samples);
  table.add_scalar("hits", "", "the number of samples that come nearer than the radius", p.hits);
  table.add_scalar("equivalent_samples", "", "the number of plain samples that would tell as much",
                   p.equivalent_samples);
  table.add_scalar("change_from_lower_order", "",
                   "the probability by polynomials of the next lower order, minus this probability",
                   p.change_from_lower_order);
  table.add_scalar("standard_error_of_change", "", "the standard error of that difference",
                   p.standard_error_of_change);
  table
      .add_scalar("sampled_radius_m", "m", "the radius of the sphere into which entries are drawn",
                  p.sampled_radius)
      .is_in_json = p.sampled_radius.has_value();
  table
      .add_scalar("largest_difference_m", "m",
                  "the largest difference seen between the least distances of a linear path and of "
                  "the polynomials' path",
                  p.largest_difference)
      .is_in_json = p.largest_difference.has_value();
  table.add("time_s", "s", "since the start, in equal parts of the window", &TimeRow::time_s);
  table.add("probability_by_time", "",
            "the probability that the spacecraft have come nearer than the radius by then",
            &TimeRow::probability);
  std::vector<TimeRow> rows;
  for (std::size_t k = 0; k < p.times.size(); ++k) rows.push_back({p.times[k], p.by_time[k]});
  return std::move(table).view(rows, {rows.size()});
}

TableView whole_passage_table(const CollisionResult& result) {
  const CollisionProbability& p = probability_of_passage(result);
  const bool is_cut = result.of_whole_passage.has_value();
  ResultTable<int> table("whole_passage", "/collision/whole_passage", {},
                         "The same of the whole passages where an edge of the window cuts one.");
  table.add_scalars("window_s", "s",
                    "the window of time that holds whole passages, after the start",
                    std::array{is_cut ? result.whole_from_s : result.from_s,
                               is_cut ? result.whole_to_s : result.to_s});
  add_probability(table, p);
  add_interval(table, p);
  return std::move(table).view({0}, {});
}

TableView least_separation_table(const CollisionResult& result) {
  const LeastSeparations& least = result.separations;
  ResultTable<int> table("least_separation", "/collision/least_separation", {},
                         "How near chief and deputy come in the window.");
  table.add_scalar("samples", "", "the number of plain samples", least.samples);
  table.add_scalars("shares", "", "shares of all cases", least.shares);
  table.add_scalars("separations_m", "m",
                    "the separations below which these shares have their least separation",
                    least.separations);
  table.add_scalars("errors_m", "m",
                    "by how much these separations may be wrong beside their sampling",
                    least.errors);
  table.add_scalar("flights", "", "the number of samples that were flown with the full equations",
                   least.flights);
  table.add_scalar(
      "flight_difference_m", "m",
      "the largest difference of the least separations between flights and polynomials",
      least.flight_difference);
  table.add_scalars("lower_m", "m", "the lower ends of the intervals of these separations",
                    least.lower);
  table.add_scalars("upper_m", "m",
                    "the upper ends of these intervals; infinite above the largest sample",
                    least.upper);
  return std::move(table).view({0}, {});
}

TableView approaches_table(const CollisionResult& result) {
  const double radius_m = result.watch.radius_m;
  ResultTable<const UncertainApproach*> table("approaches", "/collision", {"approaches"},
                                              "Closest approaches of the means in the window, and "
                                              "in whole passages that an edge of it cuts.");
  table.add("time_s", "s", "since the start", &UncertainApproach::time_s);
  table.add("in_window", "",
            "whether the approach is in `window_s`, not only in the window of the whole passage",
            &UncertainApproach::is_in_window);
  table.add("distance_m", "m", "the distance between the means", &UncertainApproach::distance_m);
  table.add("speed_m_s", "m/s", "the relative speed of the means", &UncertainApproach::speed_m_s);
  table.add("time_deviation_s", "s", "the standard deviation of the time, in the linear theory",
            &UncertainApproach::time_deviation_s);
  table.add("distance_deviation_m", "m",
            "the standard deviation of the distance, in the linear theory",
            &UncertainApproach::distance_deviation_m);
  table.add("flights", "",
            "the number of flights of random deviations to the times that the polynomials tell",
            &UncertainApproach::flights);
  table.add("polynomials_hold", "",
            "whether the polynomials are right to a tenth of the distance or the radius",
            [=](const UncertainApproach* approach) { return approach->holds(radius_m); });
  const auto has_flights = [](const UncertainApproach* row) { return row->flights > 0; };
  table.add_if(has_flights, "position_error_m", "m",
               "the largest error of the polynomials' position",
               &UncertainApproach::position_error_m);
  table.add_if(has_flights, "time_error_s", "s", "the largest error of the polynomials' time",
               &UncertainApproach::time_error_s);
  const auto rows = approaches_of(result);
  TableView view = std::move(table).view(rows, {rows.size()});
  for (TableColumn& column : view.columns) column.is_in_csv = false;
  return view;
}

TableView short_encounter_table(const CollisionResult& result) {
  ResultTable<const UncertainApproach*> table(
      "short_encounter", "", {"approaches"},
      "The formulas for short encounters, of each closest approach and the whole of its passage; "
      "nothing where they have no answer. In summary.json at "
      "`/collision/approaches/.../short_encounter`.");
  table.leave_rows_out_of_json();
  const auto has_plane = [](const UncertainApproach* row) { return row->plane.has_value(); };
  const auto add = [&](const char* name, const char* unit, const char* meaning, auto member) {
    table.add_if(has_plane, name, unit, meaning, [member](const UncertainApproach* row) {
      return std::invoke(member, *row->plane);
    });
  };
  const auto add_axes = [&](const char* name, const char* meaning,
                            std::array<double, 2> ShortEncounter::*member) {
    table.add_array(name, {"first", "second"}, "m", meaning,
                    [member](const UncertainApproach* row) {
                      return row->plane ? std::optional((*row->plane).*member) : std::nullopt;
                    });
  };
  add("foster", "", "the probability by the formula of Foster and Estes", &ShortEncounter::foster);
  add("alfano", "", "the probability by the formula of Alfano", &ShortEncounter::alfano);
  add("chan", "",
      "the probability by the formula of Chan, which takes the ellipse of deviations for a circle",
      &ShortEncounter::chan);
  add_axes(
      "offset_m",
      "the distance of the means across the velocity, along the principal axes of the deviations",
      &ShortEncounter::offset);
  add_axes("deviation_m", "the standard deviations along the same axes",
           &ShortEncounter::deviation);
  add("passage_s", "s",
      "the time that the spacecraft take to pass each other, to each side of the approach",
      &ShortEncounter::passage);
  add("departure", "", "the departure of the motion from a straight one, in standard deviations",
      &ShortEncounter::departure);
  table.add_if(has_plane, "cut_by_window", "", "whether an edge of `window_s` cuts the passage",
               &UncertainApproach::is_cut);
  add("holds", "",
      "whether the formulas hold: the departure is below 0.1, and the passage is not cut, or "
      "`whole_passage` has the probability without the cut",
      &ShortEncounter::holds);
  const auto rows = approaches_of(result);
  TableView view = std::move(table).view(rows, {rows.size()});
  for (TableColumn& column : view.columns) column.is_in_csv = false;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (!rows[k]->plane) continue;
    view.places_of_rows.emplace_back(k, fmt::format("/collision/approaches/{}/short_encounter", k));
  }
  return view;
}

std::vector<TableView> collision_tables(const CollisionResult& result) {
  return {collision_table(result), whole_passage_table(result), least_separation_table(result),
          approaches_table(result), short_encounter_table(result)};
}

}  // namespace hamjet::io
