#include "feedback_errors_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "../../text/quantity_text.hpp"
#include "../drawing/report_page.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

struct Loop {
  std::string_view name;
  std::string_view words;
  ErroneousFlight ErrorSample::*flight;
};

constexpr std::array<Loop, 2> loops = {{{"closed", "closed loop", &ErrorSample::closed_loop},
                                        {"open", "open loop", &ErrorSample::open_loop}}};

struct Quantity {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
  double ErroneousFlight::*value;
};

constexpr std::array<Quantity, 4> quantities = {
    {{"miss_m", "m", "distance from the wanted place", &ErroneousFlight::miss_m},
     {"velocity_miss_m_s", "m/s", "difference from the wanted velocity",
      &ErroneousFlight::velocity_miss_m_s},
     {"energy_m2_s3", "m^2/s^3", "integral of |u|^2 / 2", &ErroneousFlight::energy_m2_s3},
     {"change_m_s", "m/s", "integral of |u|", &ErroneousFlight::change_m_s}}};

const std::vector<ErrorSample>& samples_of(const TransferResult& result) {
  static const std::vector<ErrorSample> none;
  const bool has_law = result.thrust && result.thrust->feedback;
  return has_law ? result.thrust->feedback->samples : none;
}

/// The median, the least number that 95 % do not exceed, and the largest; empty if no flight of the
/// loop arrived.
std::optional<std::array<double, 3>> spread(const std::vector<ErrorSample>& samples,
                                            const Loop& loop, double ErroneousFlight::*value) {
  std::vector<double> sorted;
  for (const ErrorSample& sample : samples) {
    const ErroneousFlight& flight = sample.*loop.flight;
    if (flight.failure.empty()) sorted.push_back(flight.*value);
  }
  if (sorted.empty()) return std::nullopt;
  std::sort(sorted.begin(), sorted.end());
  const auto count = static_cast<double>(sorted.size());
  const auto below = [&](double share) {
    return sorted[static_cast<std::size_t>(std::max(std::ceil(share * count) - 1, 0.0))];
  };
  const double median = (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]) / 2;
  return std::array{median, below(0.95), sorted.back()};
}

std::size_t failed(const std::vector<ErrorSample>& samples, const Loop& loop) {
  return static_cast<std::size_t>(std::count_if(
      samples.begin(), samples.end(),
      [&](const ErrorSample& sample) { return !(sample.*loop.flight).failure.empty(); }));
}

}  // namespace

TableView feedback_samples_table(const TransferResult& result) {
  ResultTable<ErrorSample> table(
      "feedback_samples", "/energy_optimal_thrust/feedback", {"samples"},
      "Flights by the law of feedback and by the planned thrust, under the same errors of thrust.");
  table.leave_rows_out_of_json();
  for (const Loop& loop : loops) {
    for (const Quantity& quantity : quantities) {
      table.add(fmt::format("{}_{}", loop.name, quantity.name), std::string(quantity.unit),
                fmt::format("the {} in {}", quantity.meaning, loop.words),
                [loop, value = quantity.value](const ErrorSample& sample) {
                  const ErroneousFlight& flight = sample.*loop.flight;
                  return flight.failure.empty() ? std::optional(flight.*value) : std::nullopt;
                });
    }
    table.add(fmt::format("{}_failure", loop.name), "",
              fmt::format("the reason why the flight in {} does not arrive", loop.words),
              [loop](const ErrorSample& sample) { return (sample.*loop.flight).failure; });
  }
  const std::vector<ErrorSample>& rows = samples_of(result);
  return std::move(table).view(rows, {rows.size()});
}

TableView feedback_errors_table(const TransferResult& result) {
  const std::vector<ErrorSample>& samples = samples_of(result);
  ResultTable<Loop> table("feedback_errors", "/energy_optimal_thrust/feedback", {"errors"},
                          "Misses and costs of these flights in closed and in open loop.");
  table.add("loop", "", "closed, by the law of feedback, or open, as planned",
            [](const Loop& loop) { return std::string(loop.name); });
  for (const Quantity& quantity : quantities) {
    const std::string name(quantity.name);
    table.add_array(name, {"median_" + name, "quantile_95_" + name, "largest_" + name},
                    std::string(quantity.unit),
                    fmt::format("the {}: median, what 95 % of the flights do not exceed, and the "
                                "largest",
                                quantity.meaning),
                    [&samples, value = quantity.value](const Loop& loop) {
                      return spread(samples, loop, value);
                    });
  }
  table.add("flights", "", "the number of flights",
            [&samples](const Loop&) { return samples.size(); });
  table.add("failed", "", "the number of these that do not arrive, which the columns leave out",
            [&samples](const Loop& loop) { return failed(samples, loop); });
  const std::vector<Loop> rows =
      samples.empty() ? std::vector<Loop>() : std::vector<Loop>(loops.begin(), loops.end());
  return std::move(table).view(rows, {rows.size()});
}

std::string feedback_errors_lines(const TransferResult& result) {
  const std::vector<ErrorSample>& samples = samples_of(result);
  std::string text;
  for (const Loop& loop :
       samples.empty() ? std::vector<Loop>() : std::vector<Loop>(loops.begin(), loops.end())) {
    const auto miss = spread(samples, loop, &ErroneousFlight::miss_m);
    const auto change = spread(samples, loop, &ErroneousFlight::change_m_s);
    const std::size_t lost = failed(samples, loop);
    text += fmt::format("  {:<17}", text.empty() ? "under errors" : "");
    if (!miss || !change) {
      text += fmt::format("{}: no flight of {} arrives\n", loop.words, samples.size());
      continue;
    }
    text += fmt::format("{}: misses by {} (median), {} (95 % of {} flights), takes {}{}\n",
                        loop.words, miss_text((*miss)[0], result.flight_floor_m),
                        miss_text((*miss)[1], result.flight_floor_m), samples.size(),
                        velocity_text((*change)[0]),
                        lost > 0 ? fmt::format("; {} do not arrive", lost) : "");
  }
  return text;
}

std::string feedback_errors_html(const TransferResult& result) {
  const std::vector<ErrorSample>& samples = samples_of(result);
  if (samples.empty()) return "";
  std::string rows;
  for (const Loop& loop : loops) {
    for (const Quantity& quantity : quantities) {
      rows += "<tr>" + row_name_cell(
                           fmt::format("{}: {} ({})", loop.words, quantity.meaning, quantity.unit));
      const auto values = spread(samples, loop, quantity.value);
      for (std::size_t i = 0; i < 3; ++i) {
        rows += cell(values ? fmt::format("{:.5g}", (*values)[i]) : "none");
      }
      rows += cell(std::to_string(failed(samples, loop))) + "</tr>\n";
    }
  }
  return table_html(
      fmt::format("{} flights by the law of feedback, and as many as planned, under the same "
                  "errors of thrust; the law is told wrong states.",
                  samples.size()),
      "<tr>" + header_cells({"", "median", "95 %", "largest", "do not arrive"}) + "</tr>", rows);
}

}  // namespace hamjet::io
