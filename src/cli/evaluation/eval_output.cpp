#include "eval_output.hpp"

#include <fmt/compile.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace hamjet::cli {
namespace {

using Json = nlohmann::ordered_json;
using Support = TruncationEstimate::Support;

constexpr std::size_t bytes_in_a_piece = std::size_t{1} << 16;

const char* support_name(Support support) {
  switch (support) {
    case Support::inside:
      return "inside";
    case Support::outside:
      return "outside";
    case Support::unknown:
      break;
  }
  return "unknown";
}

/// A number's size, one digit of it, for where the series says nothing.
double size_alone(double x) { return std::isfinite(x) ? std::stod(fmt::format("{:.0e}", x)) : x; }

/// A number, or null where the final state has none.
Json finite_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

}  // namespace

EvalOutput::EvalOutput(std::vector<std::string_view> columns, bool has_time,
                       std::function<void(std::string_view)> take)
    : columns_(std::move(columns)), has_time_(has_time), take_(std::move(take)) {
  fmt::format_to(std::back_inserter(csv_), "{}{},miss_estimate_m,support\n",
                 has_time ? "time_s," : "", fmt::join(columns_, ","));
}

void EvalOutput::add(double time_s, const std::vector<double>& state,
                     const MissEstimate& estimate) {
  const bool is_inside = estimate.is_inside();
  const bool is_outside = estimate.support == Support::outside;
  const fmt::appender write(csv_);
  ++rows_;
  if (has_time_) fmt::format_to(write, FMT_COMPILE("{},"), time_s);
  for (const double x : state) {
    if (std::isfinite(x)) fmt::format_to(write, FMT_COMPILE("{}"), is_outside ? size_alone(x) : x);
    csv_.push_back(',');
  }
  undefined_ += std::any_of(state.begin(), state.end(), [](double x) { return std::isnan(x); });
  if (is_inside) fmt::format_to(write, FMT_COMPILE("{:.3g}"), estimate.miss_m());
  fmt::format_to(write, FMT_COMPILE(",{}\n"), support_name(estimate.support));
  if (is_inside) largest_miss_ = std::max(largest_miss_.value_or(0), estimate.miss_m());
  outside_ += is_outside ? 1 : 0;
  unknown_ += estimate.support == Support::unknown ? 1 : 0;
  if (csv_.size() >= bytes_in_a_piece) finish();
  if (rows_ > most_json_rows) return;
  Json row;
  if (has_time_) row["time_s"] = time_s;
  for (std::size_t i = 0; i < state.size(); ++i) {
    row[std::string(columns_[i])] = finite_or_null(is_outside ? size_alone(state[i]) : state[i]);
  }
  row["miss_estimate_m"] = is_inside ? Json(estimate.miss_m()) : Json(nullptr);
  row["truncation_m"] = is_inside ? Json(estimate.truncation_m) : Json(nullptr);
  row["rounding_m"] = estimate.rounding_m;
  row["integration_m"] = estimate.integration_m;
  row["support"] = support_name(estimate.support);
  json_rows_.push_back(std::move(row));
}

void EvalOutput::finish() {
  take_({csv_.data(), csv_.size()});
  csv_.clear();
}

Json EvalOutput::json_rows() const { return rows_ <= most_json_rows ? json_rows_ : Json(nullptr); }

}  // namespace hamjet::cli
