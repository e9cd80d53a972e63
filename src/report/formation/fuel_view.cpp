#include "fuel_view.hpp"

#include <fmt/format.h>

#include <functional>
#include <optional>
#include <vector>

#include "../../text/html_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../drawing/along_time_charts.hpp"
#include "../drawing/report_page.hpp"
#include "frame_columns.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

using Fuelled = const FuelOptimalTransfer&;

/// What `value` makes of a transfer that was found, none of any other.
template <class Value>
auto where_fuel_is_found(Value value) {
  return [value](Fuelled one) {
    using Held = std::remove_cvref_t<std::invoke_result_t<Value, Fuelled>>;
    return one.is_found() ? std::optional<Held>(std::invoke(value, one)) : std::nullopt;
  };
}

const FuelOptimalTransfer* least_fuel(const TransferResult& result) {
  return result.fuel && result.fuel->least ? &result.fuel->transfers[*result.fuel->least] : nullptr;
}

/// The first of the times that the thruster can do.
std::optional<double> shortest_fuel_time_s(const TransferResult& result) {
  if (!result.fuel) return std::nullopt;
  for (const FuelOptimalTransfer& one : result.fuel->transfers) {
    if (one.is_found()) return seconds(result, one.time);
  }
  return std::nullopt;
}

std::string propellant_text(const std::optional<double>& kilograms) {
  return kilograms ? fmt::format(" and {:.4g} kg of propellant", *kilograms) : "";
}

}  // namespace

TableView fuel_optimal_table(const TransferResult& result) {
  const double unit = result.scene.units.time_s;
  ResultTable<FuelOptimalTransfer> table(
      "fuel_optimal", "/fuel_optimal_thrust", {"transfers"},
      "Thrust that takes the least integral of |u|, u its acceleration, which is never above the "
      "thruster's.");
  table.add("time_s", "s", "the duration of the transfer",
            [=](Fuelled one) { return one.time * unit; });
  table.add("change_m_s", "m/s", "the integral of |u|",
            where_fuel_is_found(&FuelOptimalTransfer::change_m_s));
  table.add("energy_optimal_m_s", "m/s",
            "the same integral of the energy-optimal thrust, which may be above the thruster's",
            [](Fuelled one) {
              return one.energy_optimal_m_s > 0 ? std::optional(one.energy_optimal_m_s)
                                                : std::nullopt;
            });
  table.add("impulses_m_s", "m/s",
            "the least sum of impulses found for the same time and ends; no thrust takes less",
            &FuelOptimalTransfer::impulses_m_s);
  table.add("impulses_bound_m_s", "m/s", "no impulses take less than this, to first order",
            &FuelOptimalTransfer::impulses_bound_m_s);
  table.add("burns", "", "the number of burns at full thrust",
            where_fuel_is_found([](Fuelled one) { return one.burns.size(); }));
  table.add("burning_s", "s", "the time of full thrust", where_fuel_is_found([=](Fuelled one) {
              double sum = 0;
              for (const ThrustBurn& burn : one.burns) sum += burn.length() * unit;
              return sum;
            }));
  table.add("propellant_kg", "kg",
            "the propellant that the burns take; nothing where no mass is given",
            [](Fuelled one) { return one.is_found() ? one.propellant_kg : std::nullopt; });
  table.add("miss_m", "m", "the flown miss of the position",
            where_fuel_is_found(&FuelOptimalTransfer::miss_m));
  table.add("velocity_miss_m_s", "m/s", "the flown miss of the velocity",
            where_fuel_is_found(&FuelOptimalTransfer::velocity_miss_m_s));
  table.add(
      "primer_at_switches", "",
      "the largest difference of the primer vector's length from 1 at switches; where the mass "
      "falls, it is told in parts of the costate of the change spent so far",
      where_fuel_is_found(&FuelOptimalTransfer::primer_at_switches));
  table.add("primer_in_coasts", "", "its largest length in coasts, which is not above 1",
            where_fuel_is_found(&FuelOptimalTransfer::primer_in_coasts));
  table.add("primer_in_burns", "", "its least length in burns, which is not below 1",
            where_fuel_is_found(&FuelOptimalTransfer::primer_in_burns));
  table.add("hamiltonian_change", "",
            "how far the Hamiltonian changes along the flight, in parts of its largest term; "
            "nothing where forces depend on the time",
            [](Fuelled one) { return one.is_found() ? one.hamiltonian_change : std::nullopt; });
  add_costates(table, result.scene, ", whose primer vector is that of the maximum principle",
               where_fuel_is_found(&FuelOptimalTransfer::costates));
  table.add("continuation_steps", "", "steps by which it was followed from least energy",
            &FuelOptimalTransfer::continuation_steps);
  table.add("flights", "", "the number of flights that this took", &FuelOptimalTransfer::flights);
  table.add("least_acceleration_m_s2", "m/s^2",
            "where the thruster is too weak: the least acceleration with which a thrust was found",
            &FuelOptimalTransfer::least_acceleration_m_s2);
  table.add("failure", "", "the reason why there is no answer", &FuelOptimalTransfer::failure);
  table.add_scalar("acceleration_m_s2", "m/s^2", "the thruster's acceleration, at the start",
                   result.fuel ? std::optional(result.fuel->acceleration_m_s2) : std::nullopt);
  table.add_scalar("shortest_transfer_time_s", "s",
                   "the first of the times in which the thruster can do it",
                   shortest_fuel_time_s(result));
  const auto rows = result.fuel ? result.fuel->transfers : std::vector<FuelOptimalTransfer>();
  return std::move(table).view(rows, {rows.size()});
}

TableView fuel_optimal_burns_table(const TransferResult& result) {
  struct Row {
    const FuelOptimalTransfer* transfer;
    const ThrustBurn* burn;
    std::size_t number;
  };
  const double unit = result.scene.units.time_s;
  ResultTable<Row> table("fuel_optimal_burns", "/fuel_optimal_thrust", {"burns"},
                         "Burns at full thrust of the fuel-optimal transfers, one row a burn.");
  table.add("transfer_time_s", "s", "the duration of the transfer",
            [=](const Row& row) { return row.transfer->time * unit; });
  table.add("burn", "", "the burn's number among those of the transfer, from 1",
            [](const Row& row) { return row.number; });
  table.add("start_s", "s", "when the thrust is switched on, since the start",
            [=](const Row& row) { return row.burn->start * unit; });
  table.add("end_s", "s", "when it is switched off",
            [=](const Row& row) { return row.burn->end * unit; });
  table.add("change_m_s", "m/s", "the integral of the acceleration",
            [](const Row& row) { return row.burn->change_m_s; });
  add_along_axes(table, result.scene, "start_direction",
                 axis_parts(result.scene, "start_direction_", ""), "",
                 "the unit vector of the thrust at its start, along the frame's axes then",
                 [](const Row& row) { return row.burn->start_direction; });
  add_along_axes(table, result.scene, "end_direction",
                 axis_parts(result.scene, "end_direction_", ""), "",
                 "the unit vector of the thrust at its end, along the frame's axes then",
                 [](const Row& row) { return row.burn->end_direction; });
  std::vector<Row> rows;
  if (result.fuel) {
    for (const FuelOptimalTransfer& one : result.fuel->transfers) {
      if (!one.is_found()) continue;
      for (std::size_t k = 0; k < one.burns.size(); ++k) {
        rows.push_back({&one, &one.burns[k], k + 1});
      }
    }
  }
  return std::move(table).view(rows, {rows.size()});
}

TableView primer_profile_table(const TransferResult& result) {
  const double unit = result.scene.units.time_s;
  ResultTable<PrimerSample> table(
      "primer_profile", "/fuel_optimal_thrust", {"profile"},
      "Thrust and primer vector along the way of the fuel-optimal transfer that takes the least.");
  table.add("time_s", "s", "since the start",
            [=](const PrimerSample& sample) { return sample.time * unit; });
  add_along_axes(table, result.scene, "thrust_m_s2", axis_parts(result.scene, "thrust_", "_m_s2"),
                 "m/s^2", "the acceleration, along the frame's axes then",
                 &PrimerSample::thrust_m_s2);
  table.add("primer", "",
            "the length of the primer vector, in parts of that at which the thrust is switched",
            &PrimerSample::primer);
  const auto rows = result.fuel ? result.fuel->profile : std::vector<PrimerSample>();
  return std::move(table).view(rows, {rows.size()});
}

nlohmann::ordered_json fuel_optimal_json(const TransferResult& result) {
  if (!result.fuel) return nullptr;
  nlohmann::ordered_json json = table_json(fuel_optimal_table(result));
  json.update(table_json(fuel_optimal_burns_table(result)));
  json.update(table_json(primer_profile_table(result)));
  return json;
}

Chart fuel_chart(const TransferResult& result) {
  Chart chart;
  chart.name = "primer-profile";
  chart.title = "Primer vector and full thrust along the way";
  const std::vector<PrimerSample>& profile = result.fuel->profile;
  const TimeAxis axis = time_axis(seconds(result, profile.back().time));
  chart.x.label = fmt::format("time since the start ({})", axis.name);
  add_revolutions(result.scene, axis.seconds, chart.x);
  chart.y.label = "length, and thrust in parts of the thruster's";
  chart.y.includes = {0};
  const auto add = [&](std::string title, std::size_t style) -> ChartCurve& {
    ChartCurve curve;
    curve.title = std::move(title);
    curve.style = style;
    curve.has_markers = false;
    chart.curves.push_back(std::move(curve));
    return chart.curves.back();
  };
  ChartCurve& primer = add("primer vector", 0);
  for (const PrimerSample& sample : profile) {
    primer.points.emplace_back(seconds(result, sample.time) / axis.seconds, sample.primer);
  }
  ChartCurve& thrust = add("thrust", 3);
  const auto step = [&](double time, double share) {
    thrust.points.emplace_back(seconds(result, time) / axis.seconds, share);
  };
  step(0, 0);
  for (const ThrustBurn& burn : least_fuel(result)->burns) {
    step(burn.start, 0);
    step(burn.start, 1);
    step(burn.end, 1);
    step(burn.end, 0);
  }
  step(profile.back().time, 0);
  chart.reading =
      "The thrust is full where the primer vector is longer than 1, along which it then is, and "
      "none where it is shorter. While the mass falls, its length is told in parts of the costate "
      "of the change spent so far.";
  return chart;
}

std::string fuel_failure(const TransferResult& result) {
  return result.fuel ? result.fuel->failure : "";
}

std::string fuel_verdict(const TransferResult& result) {
  if (!result.fuel) return "";
  const FuelOptimalTransfer* least = least_fuel(result);
  if (least == nullptr) {
    return fmt::format("No thrust of least fuel can be named: {}.", fuel_failure(result));
  }
  const auto& propellant = least->propellant_kg;
  std::string text = fmt::format(
      "Thrust of least fuel, full or none at {:.4g} m/s^2{}, takes {}{} over {} in {} and misses "
      "by "
      "{} and {:.2g} m/s. That of least energy takes {} in the same time",
      result.fuel->acceleration_m_s2, propellant ? " at the start" : "",
      velocity_text(least->change_m_s), propellant_text(propellant),
      time_text(seconds(result, least->time)), counted(least->burns.size(), "burn"),
      miss_text(least->miss_m, result.flight_floor_m), least->velocity_miss_m_s,
      velocity_text(least->energy_optimal_m_s));
  if (least->impulses_m_s) {
    text += fmt::format(", and impulses {}", velocity_text(*least->impulses_m_s));
  }
  text += ".";
  if (const std::string failures = failures_text(*result.fuel); !failures.empty()) {
    text += fmt::format(" Not in every time: {}; the shortest of the times that it can do is {}.",
                        failures, time_text(*shortest_fuel_time_s(result)));
  }
  return text;
}

std::string fuel_lines(const TransferResult& result) {
  if (!result.fuel) return "";
  const FuelOptimalTransfer* least = least_fuel(result);
  if (least == nullptr) {
    return fmt::format("  least fuel       not found: {}\n", fuel_failure(result));
  }
  std::string text =
      fmt::format("  least fuel       {}{} over {} by {}: misses by {} and {:.2g} m/s\n",
                  velocity_text(least->change_m_s), propellant_text(least->propellant_kg),
                  time_text(seconds(result, least->time)), counted(least->burns.size(), "burn"),
                  miss_text(least->miss_m, result.flight_floor_m), least->velocity_miss_m_s);
  for (const ThrustBurn& burn : least->burns) {
    text += fmt::format("{:19}full thrust from {:.6f} s to {:.6f} s\n", "",
                        seconds(result, burn.start), seconds(result, burn.end));
  }
  return text;
}

std::string fuel_section_html(const TransferResult& result) {
  if (!result.fuel) return "";
  const std::vector<std::string> names = {"time (s)",        "change (m/s)", "least energy (m/s)",
                                          "impulses (m/s)",  "burns",        "full thrust (s to s)",
                                          "propellant (kg)", "miss (m)"};
  std::string rows;
  for (const FuelOptimalTransfer& one : result.fuel->transfers) {
    rows += "<tr>" + row_name_cell(fmt::format("{:.6g}", seconds(result, one.time)));
    if (!one.is_found()) {
      rows += fmt::format("<td colspan=\"7\">{}</td></tr>\n", escape_html(one.failure));
      continue;
    }
    std::string spans;
    for (const ThrustBurn& burn : one.burns) {
      spans += fmt::format("{}{:.1f} to {:.1f}", spans.empty() ? "" : ", ",
                           seconds(result, burn.start), seconds(result, burn.end));
    }
    rows += cell(fmt::format("{:.6g}", one.change_m_s)) +
            cell(fmt::format("{:.6g}", one.energy_optimal_m_s)) +
            cell(one.impulses_m_s ? fmt::format("{:.6g}", *one.impulses_m_s) : "-") +
            cell(fmt::format("{}", one.burns.size())) + cell(spans) +
            cell(one.propellant_kg ? fmt::format("{:.4g}", *one.propellant_kg) : "-") +
            cell(fmt::format("{:.3g}", one.miss_m)) + "</tr>\n";
  }
  return "<section>\n<h2>Thrust of least fuel</h2>\n<p>" + escape_html(fuel_verdict(result)) +
         "</p>\n" +
         table_html("By transfer time, flown with the full equations of motion.",
                    "<tr>" + header_cells(names) + "</tr>", rows) +
         "</section>\n";
}

}  // namespace hamjet::io
