#include "burn_view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <sstream>
#include <vector>

#include "../../text/html_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/terminal_text.hpp"
#include "../drawing/report_page.hpp"
#include "impulse_view.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

/// A burn of a plan, or a plan without any.
struct BurnRow {
  const BurnPlan* plan = nullptr;
  const FiniteBurn* burn = nullptr;
  std::size_t number = 0;
};

std::vector<BurnRow> burn_rows(const TransferResult& result) {
  std::vector<BurnRow> rows;
  if (!result.burns) return rows;
  for (const BurnPlan& plan : result.burns->plans) {
    if (plan.burns.empty()) rows.push_back({&plan});
    for (std::size_t k = 0; k < plan.burns.size(); ++k) {
      rows.push_back({&plan, &plan.burns[k], k + 1});
    }
  }
  return rows;
}

bool turns_with_orbit(const TransferResult& result) {
  return !result.scene.thruster || result.scene.thruster->attitude == BurnAttitude::rtn;
}

std::array<const char*, 3> burn_axes(const TransferResult& result) {
  return turns_with_orbit(result) ? std::array{"R", "T", "N"} : std::array{"x", "y", "z"};
}

const char* attitude_text(const TransferResult& result) {
  return turns_with_orbit(result) ? "along R, T, N of the deputy's own orbit"
                                  : "along the inertial axes";
}

const BurnPlan* least_plan(const TransferResult& result) {
  return result.burns && result.burns->least ? &result.burns->plans[*result.burns->least] : nullptr;
}

std::optional<double> shortest_time_s(const TransferResult& result) {
  if (!result.burns) return std::nullopt;
  for (const BurnPlan& plan : result.burns->plans) {
    if (plan.is_found() && !plan.is_optimal) return seconds(result, plan.duration);
  }
  return std::nullopt;
}

std::string impulses_name(const BurnPlan& plan) { return plan.is_optimal ? "optimal" : "two"; }

/// What would replace the impulses of a plan that the thruster is too weak for.
std::string remedy(const BurnPlan& plan, const TransferResult& result) {
  if (!plan.least_acceleration_m_s2) return "";
  return fmt::format("; an acceleration of {:.4g} m/s^2 does it, {:.3g} times the thruster's",
                     *plan.least_acceleration_m_s2,
                     *plan.least_acceleration_m_s2 / result.scene.thruster->acceleration_m_s2);
}

/// The lengths of a plan's burns.
std::string lengths_text(const BurnPlan& plan, const TransferResult& result) {
  std::vector<std::string> lengths;
  for (const FiniteBurn& burn : plan.burns) {
    lengths.push_back(duration_text(seconds(result, burn.end - burn.start)));
  }
  return fmt::format("{}", fmt::join(lengths, ", "));
}

}  // namespace

TableView burns_table(const TransferResult& result) {
  const double unit = result.scene.units.time_s;
  ResultTable<BurnRow> table("burns", "/finite_burns", {"burns"},
                             "Burns of the thruster in place of impulses, one row a burn.");
  const auto of_burn = [](auto value) {
    return [value](const BurnRow& row) {
      using Value = std::remove_cvref_t<std::invoke_result_t<decltype(value), const FiniteBurn&>>;
      return row.burn != nullptr ? std::optional<Value>(std::invoke(value, *row.burn))
                                 : std::nullopt;
    };
  };
  const auto in_seconds = [&](double FiniteBurn::*time) {
    return of_burn([=](const FiniteBurn& burn) { return burn.*time * unit; });
  };
  table.add("impulses", "", "which impulses the burn replaces: `two`, or `optimal`",
            [](const BurnRow& row) { return impulses_name(*row.plan); });
  table.add("transfer_time_s", "s", "the time between the ends of the transfer",
            [=](const BurnRow& row) { return row.plan->duration * unit; });
  table.add("burn", "", "the burn's number among those of the transfer, from 1",
            [](const BurnRow& row) {
              return row.burn != nullptr ? std::optional(row.number) : std::nullopt;
            });
  table.add("impulse_time_s", "s",
            "the time of the impulse, which is the mean time of the burn's velocity change",
            in_seconds(&FiniteBurn::time));
  table.add("start_s", "s", "when the burn begins, counted from the transfer's start",
            in_seconds(&FiniteBurn::start));
  table.add("end_s", "s", "when the burn ends, counted from the transfer's start",
            in_seconds(&FiniteBurn::end));
  table.add("length_s", "s", "how long the burn lasts",
            of_burn([=](const FiniteBurn& burn) { return (burn.end - burn.start) * unit; }));
  table.add_array("direction", {"direction_1", "direction_2", "direction_3"}, "",
                  "the unit vector along the axes of the thruster's attitude: R, T, N of the "
                  "deputy's own orbit, or the inertial axes",
                  of_burn(&FiniteBurn::direction));
  table.add("change_m_s", "m/s", "the integral of the acceleration",
            of_burn(&FiniteBurn::change_m_s));
  table.add("impulse_m_s", "m/s", "the magnitude of the impulse",
            of_burn(&FiniteBurn::impulse_m_s));
  table.add("gravity_loss_m_s", "m/s",
            "by how much the burn's velocity change is larger than the impulse",
            of_burn(&FiniteBurn::loss_m_s));
  table.add("propellant_kg", "kg",
            "the propellant that the burn takes; nothing where no mass is given",
            [](const BurnRow& row) {
              return row.burn != nullptr ? row.burn->propellant_kg : std::nullopt;
            });
  table.add("mass_after_kg", "kg", "the mass of the spacecraft after the burn",
            [](const BurnRow& row) {
              return row.burn != nullptr ? row.burn->mass_after_kg : std::nullopt;
            });
  const auto of_plan = [](auto value) {
    return [value](const BurnRow& row) {
      return row.burn != nullptr ? std::optional(std::invoke(value, *row.plan)) : std::nullopt;
    };
  };
  table.add("total_change_m_s", "m/s",
            "the sum of the velocity changes of all burns of the transfer",
            of_plan(&BurnPlan::change_m_s));
  table.add("total_impulses_m_s", "m/s", "the sum of the magnitudes of the transfer's impulses",
            [](const BurnRow& row) { return row.plan->impulses_m_s; });
  table.add("miss_m", "m", "the miss of the position of the deputy that flies the burns",
            of_plan(&BurnPlan::miss_m));
  table.add("velocity_miss_m_s", "m/s",
            "the miss of the velocity of the deputy that flies the burns",
            of_plan(&BurnPlan::velocity_miss_m_s));
  table.add("flights", "", "the number of flights that the correction took",
            [](const BurnRow& row) { return row.plan->flights; });
  table.add("least_acceleration_m_s2", "m/s^2",
            "the least acceleration of the full spacecraft with which there are such burns; "
            "nothing where the thruster's is enough, or the impulses are not the cheapest",
            [](const BurnRow& row) { return row.plan->least_acceleration_m_s2; });
  table.add("failure", "", "why these burns cannot replace the impulses",
            [](const BurnRow& row) { return row.plan->failure; });
  const BurnPlan* least = least_plan(result);
  table.add_scalar("least_change_m_s", "m/s",
                   "the velocity change of the cheapest burns that were found",
                   least != nullptr ? std::optional(least->change_m_s()) : std::nullopt);
  table.add_scalar(
      "least_transfer_time_s", "s", "the transfer time of the cheapest burns that were found",
      least != nullptr ? std::optional(seconds(result, least->duration)) : std::nullopt);
  table.add_scalar("shortest_transfer_time_s", "s",
                   "the first of the times at which burns can replace the two impulses",
                   shortest_time_s(result));
  const std::vector<BurnRow> rows = burn_rows(result);
  return std::move(table).view(rows, {rows.size()});
}

std::string burns_failure(const TransferResult& result) {
  if (!result.burns || result.burns->least) return "";
  const BurnPlan* cheapest = result.burns->cheapest_impulses();
  return result.burns->failure + (cheapest != nullptr ? remedy(*cheapest, result) : "");
}

std::string burns_verdict(const TransferResult& result) {
  if (!result.burns) return "";
  const BurnPlan* least = least_plan(result);
  if (least == nullptr) {
    return fmt::format("No burns of the thruster replace the impulses: {}.", burns_failure(result));
  }
  const auto propellant = least->propellant_kg();
  std::string text = fmt::format(
      "Burns of the thruster take {} at the least, {} of {}, over {}{}: {} ({:.2g} %) more than "
      "the impulses in whose place they are; flown with a miss of {} and {:.2g} m/s.",
      velocity_text(least->change_m_s()), counted(least->burns.size(), "burn"),
      lengths_text(*least, result), time_text(seconds(result, least->duration)),
      propellant ? fmt::format(", {:.4g} kg of propellant", *propellant) : "",
      velocity_text(least->loss_m_s()), 100 * least->loss_m_s() / least->impulses_m_s,
      miss_text(least->miss_m, result.flight_floor_m), least->velocity_miss_m_s);
  const BurnPlan* cheapest = result.burns->cheapest_impulses();
  if (cheapest->is_found()) return text;
  text += fmt::format(" The {} impulses of the least sum, over {}, cannot be replaced: {}{}.",
                      impulses_name(*cheapest), time_text(seconds(result, cheapest->duration)),
                      cheapest->failure, remedy(*cheapest, result));
  if (const auto shortest = shortest_time_s(result)) {
    text += fmt::format(" The shortest of the times in which burns replace two impulses is {}.",
                        time_text(*shortest));
  }
  return text;
}

std::string burn_lines(const TransferResult& result) {
  if (!result.burns) return "";
  const BurnPlan* least = least_plan(result);
  if (least == nullptr) {
    return fmt::format("  burns            not found: {}\n", burns_failure(result));
  }
  std::string text =
      fmt::format("  burns            {} by {} in {}: misses by {} and {:.2g} m/s\n",
                  velocity_text(least->change_m_s()), counted(least->burns.size(), "burn"),
                  time_text(seconds(result, least->duration)),
                  miss_text(least->miss_m, result.flight_floor_m), least->velocity_miss_m_s);
  std::vector<std::vector<std::string>> rows = {
      {"begins (s)", "lasts (s)", "change (m/s)", "loss (m/s)"}};
  for (const char* axis : burn_axes(result)) rows[0].emplace_back(axis);
  for (const FiniteBurn& burn : least->burns) {
    rows.push_back({fmt::format("{:.1f}", seconds(result, burn.start)),
                    fmt::format("{:.3f}", seconds(result, burn.end - burn.start)),
                    fmt::format("{:.6f}", burn.change_m_s),
                    fmt::format("{:.1e}", burn.loss_m_s())});
    for (const double x : burn.direction) rows.back().push_back(fmt::format("{:.4f}", x));
  }
  std::istringstream lines(aligned_table(rows));
  for (std::string line; std::getline(lines, line);) text += "    " + line + "\n";
  return text;
}

std::string burns_section_html(const TransferResult& result) {
  if (!result.burns) return "";
  std::vector<std::string> names = {"transfer (s)", "impulses",     "begins (s)",
                                    "lasts (s)",    "change (m/s)", "loss (m/s)"};
  for (const char* axis : burn_axes(result)) names.emplace_back(axis);
  names.insert(names.end(), {"propellant (kg)", "miss (m)"});
  std::string rows;
  for (const BurnRow& row : burn_rows(result)) {
    rows += "<tr>" + row_name_cell(fmt::format("{:.6g}", seconds(result, row.plan->duration))) +
            cell(impulses_name(*row.plan));
    if (row.burn == nullptr || !row.plan->is_found()) {
      rows += fmt::format("<td colspan=\"{}\">{}</td></tr>\n", names.size() - 2,
                          escape_html(row.plan->failure + remedy(*row.plan, result)));
      continue;
    }
    const FiniteBurn& burn = *row.burn;
    rows += cell(fmt::format("{:.6g}", seconds(result, burn.start))) +
            cell(fmt::format("{:.5g}", seconds(result, burn.end - burn.start))) +
            cell(fmt::format("{:.6g}", burn.change_m_s)) +
            cell(fmt::format("{:.3g}", burn.loss_m_s()));
    for (const double x : burn.direction) rows += cell(fmt::format("{:.5f}", x));
    rows += cell(burn.propellant_kg ? fmt::format("{:.4g}", *burn.propellant_kg) : "") +
            cell(fmt::format("{:.3g}", row.plan->miss_m)) + "</tr>\n";
  }
  return "<section>\n<h2>Burns of the thruster</h2>\n<p>" + escape_html(burns_verdict(result)) +
         "</p>\n" +
         table_html(fmt::format("By transfer time, flown with the full equations of motion. The "
                                "direction stays the same {}.",
                                attitude_text(result)),
                    "<tr>" + header_cells(names) + "</tr>", rows) +
         "</section>\n";
}

}  // namespace hamjet::io
