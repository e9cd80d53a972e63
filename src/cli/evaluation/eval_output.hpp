#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "../../app/jet_evaluation.hpp"

namespace hamjet::cli {

/// What has been evaluated, as it is printed: rows of CSV, which are handed on as they come, a few
/// of them as JSON, and counts.
class EvalOutput {
 public:
  /// More rows than this are not printed as JSON, but counted only.
  static constexpr std::size_t most_json_rows = 100;

  /// The output has a column of the time if `has_time`. `take` gets the CSV, piece by piece.
  EvalOutput(std::vector<std::string_view> columns, bool has_time,
             std::function<void(std::string_view)> take);

  void add(double time_s, const std::vector<double>& state, const MissEstimate& estimate);
  /// Hands on what is left of the CSV.
  void finish();

  /// The rows, or null where there are too many.
  nlohmann::ordered_json json_rows() const;
  std::size_t rows() const { return rows_; }
  std::size_t outside() const { return outside_; }
  std::size_t unknown() const { return unknown_; }
  /// Of the rows that are not inside, those whose final state has no numbers of the form asked for.
  std::size_t undefined() const { return undefined_; }
  /// The largest estimate of the miss, in metres, among the rows inside; none without such rows.
  std::optional<double> largest_miss() const { return largest_miss_; }

 private:
  std::vector<std::string_view> columns_;
  bool has_time_;
  std::function<void(std::string_view)> take_;
  fmt::memory_buffer csv_;  ///< not handed on yet
  nlohmann::ordered_json json_rows_ = nlohmann::ordered_json::array();
  std::size_t rows_ = 0;
  std::size_t outside_ = 0;
  std::size_t unknown_ = 0;
  std::size_t undefined_ = 0;
  std::optional<double> largest_miss_;
};

}  // namespace hamjet::cli
