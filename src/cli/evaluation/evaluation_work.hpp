#pragma once

#include <cstddef>
#include <optional>

#include "../../app/domain_evaluation.hpp"
#include "hamjet/maps/map_evaluator.hpp"

namespace hamjet::cli {

/// What all evaluations took.
struct EvaluationWork {
  double seconds = 0;
  double chart_seconds = 0;  ///< of these, for the coordinates of other charts at both ends
  int degree = 0;
  std::size_t multiply_adds_per_point = 0;
  std::size_t products_per_point = 0;
  /// The multiply-adds of all points, with those of the lower degrees that estimates need.
  double all_multiply_adds = 0;
  std::optional<EvalDomains> domains = {};  ///< where the scene asks for them
  /// Of stored results whose scene asks for domains: deputies that would need them.
  std::size_t beyond_tolerance = 0;

  /// The speed of the polynomials, without the time of the charts.
  double multiply_adds_per_second() const { return all_multiply_adds / (seconds - chart_seconds); }

  void add(double taken, double multiply_adds, const MapEvaluator& evaluator) {
    seconds += taken;
    all_multiply_adds += multiply_adds;
    degree = evaluator.degree();
    multiply_adds_per_point = evaluator.multiply_adds_per_point();
    products_per_point = evaluator.products_per_point();
  }
};

}  // namespace hamjet::cli
