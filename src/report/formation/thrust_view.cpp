#include "thrust_view.hpp"

#include <fmt/format.h>

#include <functional>
#include <optional>
#include <vector>

#include "../../formats/relative_frame_text.hpp"
#include "../../text/html_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../drawing/along_time_charts.hpp"
#include "../drawing/report_page.hpp"
#include "feedback_errors_view.hpp"
#include "frame_columns.hpp"
#include "impulse_view.hpp"
#include "transfer_json.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

using Thrusted = const EnergyOptimalTransfer&;

/// What `value` makes of a transfer that was found, none of any other.
template <class Value>
auto where_found(Value value) {
  return [value](Thrusted one) {
    return one.is_found() ? std::optional(std::invoke(value, one)) : std::nullopt;
  };
}

/// A column with a number for each polynomial order, 1 to N.
template <class Value>
void add_by_thrust_order(ResultTable<EnergyOptimalTransfer>& table, int orders,
                         const std::string& name, std::string unit, std::string meaning,
                         Value value) {
  std::vector<std::string> parts;
  for (int order = 1; order <= orders; ++order) {
    parts.push_back(fmt::format("{}_order_{}", name, order));
  }
  table.add_array(name + "_by_order", std::move(parts), std::move(unit), std::move(meaning),
                  [orders, value](Thrusted one) {
                    std::vector<std::optional<double>> values(static_cast<std::size_t>(orders));
                    for (std::size_t i = 0; i < one.answers.size(); ++i) {
                      const EnergyOptimalAnswer& answer = one.answers[i];
                      if (answer.failure.empty()) values[i] = std::invoke(value, answer);
                    }
                    return values;
                  });
}

void add_thrust(ResultTable<EnergyOptimalTransfer>& table, const Scene& scene,
                const std::string& end, Eigen::Vector3d EnergyOptimalTransfer::*thrust) {
  add_along_axes(
      table, scene, end + "_thrust_m_s2", axis_parts(scene, end + "_thrust_", "_m_s2"), "m/s^2",
      fmt::format("the acceleration at the {}, along the frame's axes at that time", end),
      where_found(thrust));
}

const EnergyOptimalTransfer* least_thrust(const TransferResult& result) {
  return result.thrust && result.thrust->least ? &result.thrust->transfers[*result.thrust->least]
                                               : nullptr;
}

}  // namespace

TableView energy_optimal_table(const TransferResult& result) {
  const Scene& scene = result.scene;
  const double unit = scene.units.time_s;
  const int orders = result.thrust ? result.thrust->order : scene.transfer->thrust_order;
  ResultTable<EnergyOptimalTransfer> table(
      "energy_optimal", "/energy_optimal_thrust", {"times"},
      "Thrust that lasts and takes the least integral of |u|^2 / 2, u its acceleration.");
  table.add("time_s", "s", "the duration of the transfer",
            [=](Thrusted one) { return one.time * unit; });
  table.add(
      "condition", "", "the condition of the linear part that is inverted, of states by costates",
      [](Thrusted one) { return one.condition > 0 ? std::optional(one.condition) : std::nullopt; });
  table.add("energy_m2_s3", "m^2/s^3", "the integral of |u|^2 / 2 along the flight",
            where_found(&EnergyOptimalTransfer::energy_m2_s3));
  add_by_thrust_order(table, orders, "energy_m2_s3", "m^2/s^3",
                      "the same integral by the generating function of the orders 1 to N",
                      &EnergyOptimalAnswer::energy_m2_s3);
  table.add("change_m_s", "m/s", "the integral of |u| along the flight",
            where_found(&EnergyOptimalTransfer::change_m_s));
  table.add("largest_m_s2", "m/s^2", "the largest |u|, among the nodes of that integral",
            where_found(&EnergyOptimalTransfer::largest_m_s2));
  table.add("exceeds_thrust", "",
            "whether the acceleration exceeds the scene's largest_thrust_m_s2 somewhere",
            &EnergyOptimalTransfer::exceeds_thrust);
  add_thrust(table, scene, "start", &EnergyOptimalTransfer::start_thrust_m_s2);
  add_thrust(table, scene, "end", &EnergyOptimalTransfer::end_thrust_m_s2);
  add_by_thrust_order(table, orders, "miss_m", "m",
                      "the distances from the wanted place at which flights with the thrust of the "
                      "orders 1 to N end",
                      &EnergyOptimalAnswer::miss_m);
  add_by_thrust_order(table, orders, "velocity_miss_m_s", "m/s",
                      "the differences of these flights from the wanted velocity",
                      &EnergyOptimalAnswer::velocity_miss_m_s);
  table.add("continuation_steps", "",
            "where flying did not correct the answer of order N: the number of smaller deviations "
            "through which it was followed; otherwise 0",
            where_found(&EnergyOptimalTransfer::continuation_steps));
  const auto of_refined = [](auto value) {
    return where_found([value](Thrusted one) { return std::invoke(value, *one.refined); });
  };
  table.add("refined_miss_m", "m", "the miss of the answer that flying corrected",
            of_refined(&EnergyOptimalAnswer::miss_m));
  table.add("refined_velocity_miss_m_s", "m/s",
            "the difference of that answer from the wanted velocity",
            of_refined(&EnergyOptimalAnswer::velocity_miss_m_s));
  add_costates(table, scene, "", of_refined(&EnergyOptimalAnswer::costates));
  table.add("refinement_flights", "", "the number of flights that the correction took",
            &EnergyOptimalTransfer::refinement_flights);
  table.add("failure", "", "the reason why there is no answer", &EnergyOptimalTransfer::failure);
  const auto rows = result.thrust ? result.thrust->transfers : std::vector<EnergyOptimalTransfer>();
  return std::move(table).view(rows, {rows.size()});
}

TableView thrust_profile_table(const TransferResult& result) {
  const double unit = result.scene.units.time_s;
  ResultTable<ThrustSample> table(
      "thrust_profile", "/energy_optimal_thrust", {"profile"},
      "The thrust of least energy along the way of the transfer that takes the least change.");
  table.add("time_s", "s", "since the start",
            [=](const ThrustSample& sample) { return sample.time * unit; });
  add_along_axes(table, result.scene, "thrust_m_s2", axis_parts(result.scene, "thrust_", "_m_s2"),
                 "m/s^2", "the acceleration, along the frame's axes then",
                 &ThrustSample::thrust_m_s2);
  table.add("magnitude_m_s2", "m/s^2", "its magnitude",
            [](const ThrustSample& sample) { return sample.thrust_m_s2.norm(); });
  const std::vector<ThrustSample> rows =
      result.thrust ? result.thrust->profile : std::vector<ThrustSample>();
  return std::move(table).view(rows, {rows.size()});
}

TableView feedback_table(const TransferResult& result) {
  struct Row {
    const FeedbackInstant* instant;
    std::size_t monomial;
  };
  const double unit = result.scene.units.time_s;
  // Coordinates of one's own may have names that begin with v.
  const bool is_own = result.scene.transfer->frame == RelativeFrame::coordinates;
  std::vector<std::string> powers = axis_parts(result.scene, "power_", "");
  for (std::string& name : axis_parts(result.scene, is_own ? "power_rate_" : "power_v", "")) {
    powers.push_back(std::move(name));
  }
  ResultTable<Row> table("feedback", "/energy_optimal_thrust/feedback", {"instants", "monomials"},
                         "The thrust of least energy at equal parts of the way as polynomials of "
                         "the deputy's relative state then.");
  table.leave_rows_out_of_json();
  table.add("time_s", "s", "the instant, since the start",
            [=](const Row& row) { return row.instant->time * unit; });
  table.add_array("powers", powers, "",
                  "the powers of position (m) and velocity (m/s) along the frame's axes in this "
                  "monomial",
                  [](const Row& row) {
                    const auto exponents =
                        row.instant->thrust.front().space().exponents(row.monomial);
                    return std::vector<int>(exponents.begin(), exponents.end());
                  });
  table.add_array("thrust_m_s2", axis_parts(result.scene, "thrust_", "_m_s2"), "m/s^2",
                  "its coefficients in the acceleration along the frame's axes then, per m and m/s",
                  [](const Row& row) {
                    std::vector<double> values;
                    for (const Series<double>& one : row.instant->thrust) {
                      values.push_back(one[row.monomial]);
                    }
                    return values;
                  });
  std::vector<Row> rows;
  std::size_t instants = 0, monomials = 0;
  if (result.thrust && result.thrust->feedback && result.thrust->feedback->failure.empty()) {
    const FeedbackLaw& law = *result.thrust->feedback;
    instants = law.instants.size();
    monomials = law.instants.front().thrust.front().space().size();
    for (const FeedbackInstant& instant : law.instants) {
      for (std::size_t m = 0; m < monomials; ++m) rows.push_back({&instant, m});
    }
  }
  const auto flown = [&](double FeedbackLaw::*member) {
    return instants > 0 ? std::optional((*result.thrust->feedback).*member) : std::nullopt;
  };
  table.add_scalar("miss_m", "m", "the miss of the flight by these polynomials",
                   flown(&FeedbackLaw::miss_m));
  table.add_scalar("velocity_miss_m_s", "m/s", "its difference from the wanted velocity",
                   flown(&FeedbackLaw::velocity_miss_m_s));
  table.add_scalar("energy_m2_s3", "m^2/s^3", "the integral of |u|^2 / 2 along it",
                   flown(&FeedbackLaw::energy_m2_s3));
  table.add_scalar("change_m_s", "m/s", "the integral of |u| along it",
                   flown(&FeedbackLaw::change_m_s));
  return std::move(table).view(rows, {instants, monomials});
}

nlohmann::ordered_json feedback_json(const TransferResult& result) {
  using Json = nlohmann::ordered_json;
  const FeedbackLaw& law = *result.thrust->feedback;
  const double arrival_s = seconds(result, result.thrust->transfers[*result.thrust->least].time);
  Json json = {{"frame", frame_text(result.scene.transfer->frame)},
               {"arrival_s", arrival_s},
               {"flown",
                {{"miss_m", law.miss_m},
                 {"velocity_miss_m_s", law.velocity_miss_m_s},
                 {"energy_m2_s3", law.energy_m2_s3},
                 {"change_m_s", law.change_m_s}}},
               {"failure", law.failure.empty() ? Json(nullptr) : Json(law.failure)},
               {"instants", Json::array()}};
  if (!law.failure.empty()) {
    json["flown"] = nullptr;
    return json;
  }
  const SeriesSpace& space = law.instants.front().thrust.front().space();
  json["powers"] = Json::array();
  for (std::size_t m = 0; m < space.size(); ++m) {
    const auto exponents = space.exponents(m);
    json["powers"].push_back(std::vector<int>(exponents.begin(), exponents.end()));
  }
  for (const FeedbackInstant& instant : law.instants) {
    Json thrust = Json::array();
    for (const Series<double>& one : instant.thrust) {
      std::vector<double> values;
      for (std::size_t m = 0; m < space.size(); ++m) values.push_back(one[m]);
      thrust.push_back(values);
    }
    const double time_s = seconds(result, instant.time);
    json["instants"].push_back({{"time_s", time_s},
                                {"time_to_go_s", arrival_s - time_s},
                                {"position_m", vector_json(instant.state.position_m)},
                                {"velocity_m_s", vector_json(instant.state.velocity_m_s)},
                                {"thrust_m_s2", std::move(thrust)}});
  }
  return json;
}

Chart thrust_chart(const TransferResult& result) {
  Chart chart;
  chart.name = "thrust-profile";
  chart.title = "Thrust of least energy along the way";
  const std::vector<ThrustSample>& profile = result.thrust->profile;
  const TimeAxis axis = time_axis(seconds(result, profile.back().time));
  chart.x.label = fmt::format("time since the start ({})", axis.name);
  add_revolutions(result.scene, axis.seconds, chart.x);
  chart.y.label = "acceleration (m/s^2)";
  chart.y.includes = {0};
  const auto add = [&](std::string title, std::size_t style, auto value) {
    ChartCurve curve;
    curve.title = std::move(title);
    curve.style = style;
    curve.has_markers = false;
    for (const ThrustSample& sample : profile) {
      curve.points.emplace_back(seconds(result, sample.time) / axis.seconds,
                                value(sample.thrust_m_s2));
    }
    chart.curves.push_back(std::move(curve));
  };
  const auto letters = axis_letters(result.scene.system, result.scene.transfer->frame);
  for (std::size_t i = 0; i < letters.size(); ++i) {
    add(fmt::format("along {}", letters[i]), i,
        [i](const Eigen::Vector3d& thrust) { return thrust[static_cast<Eigen::Index>(i)]; });
  }
  add("magnitude", 3, [](const Eigen::Vector3d& thrust) { return thrust.norm(); });
  chart.reading =
      "The acceleration of the transfer whose change is the least, as it was flown, along the axes "
      "of the frame at that time, and its magnitude, whose integral is the change.";
  return chart;
}

std::string thrust_failure(const TransferResult& result) {
  return result.thrust ? result.thrust->failure : "";
}

std::string thrust_verdict(const TransferResult& result) {
  if (!result.thrust) return "";
  const EnergyOptimalTransfer* least = least_thrust(result);
  if (least == nullptr) {
    return fmt::format("No thrust of least energy can be named: {}.", thrust_failure(result));
  }
  return fmt::format(
      "Thrust of least energy takes {} at the least, over {}, never more than {:.3g} m/s^2; by "
      "order {} alone it misses by {}.",
      velocity_text(least->change_m_s), time_text(seconds(result, least->time)),
      least->largest_m_s2, least->answers.back().order,
      miss_text(least->answers.back().miss_m, result.flight_floor_m));
}

namespace {

std::string feedback_line(const TransferResult& result) {
  if (!result.thrust->feedback) return "";
  const FeedbackLaw& law = *result.thrust->feedback;
  if (!law.failure.empty()) return fmt::format("  feedback         not found: {}\n", law.failure);
  return fmt::format(
      "  feedback         {} by {} polynomials of order {} on the way: misses by {}\n",
      velocity_text(law.change_m_s), law.instants.size(), result.thrust->order,
      miss_text(law.miss_m, result.flight_floor_m));
}

}  // namespace

std::string thrust_lines(const TransferResult& result) {
  if (!result.thrust) return "";
  const EnergyOptimalTransfer* least = least_thrust(result);
  if (least == nullptr) {
    return fmt::format("  lasting thrust   not found: {}\n", thrust_failure(result));
  }
  return fmt::format("  lasting thrust   {} over {}, at most {:.3g} m/s^2: misses by {}\n{}",
                     velocity_text(least->change_m_s), time_text(seconds(result, least->time)),
                     least->largest_m_s2, miss_text(least->refined->miss_m, result.flight_floor_m),
                     feedback_line(result) + feedback_errors_lines(result));
}

std::string thrust_section_html(const TransferResult& result) {
  if (!result.thrust) return "";
  const std::vector<std::string> names = {
      "time (s)",           "change (m/s)",
      "largest (m/s^2)",    "energy (m^2/s^3)",
      "by the polynomials", fmt::format("miss of order {} (m)", result.thrust->order),
      "corrected (m)"};
  std::string rows;
  for (const EnergyOptimalTransfer& one : result.thrust->transfers) {
    rows += "<tr>" + row_name_cell(fmt::format("{:.6g}", seconds(result, one.time)));
    if (!one.is_found()) {
      rows += fmt::format("<td colspan=\"6\">{}</td></tr>\n", escape_html(one.failure));
      continue;
    }
    const EnergyOptimalAnswer& answer = one.answers.back();
    rows +=
        cell(fmt::format("{:.5g}", one.change_m_s)) +
        cell(fmt::format("{:.4g}{}", one.largest_m_s2, one.exceeds_thrust ? " (too much)" : "")) +
        cell(fmt::format("{:.6g}", one.energy_m2_s3)) +
        cell(fmt::format("{:.6g}", answer.energy_m2_s3)) +
        cell(fmt::format("{:.3g}", answer.miss_m)) +
        cell(fmt::format("{:.3g}", one.refined->miss_m)) + "</tr>\n";
  }
  return "<section>\n<h2>Thrust of least energy</h2>\n<p>" + escape_html(thrust_verdict(result)) +
         "</p>\n" +
         table_html("By transfer time, flown with the full equations of motion.",
                    "<tr>" + header_cells(names) + "</tr>", rows) +
         feedback_errors_html(result) + "</section>\n";
}

}  // namespace hamjet::io
