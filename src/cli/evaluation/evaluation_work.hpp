#pragma once

#include <cstddef>

#include "hamjet/maps/map_evaluator.hpp"

namespace hamjet::cli {

/// What all evaluations took.
struct EvaluationWork {
  double seconds = 0;
  double chart_seconds = 0;  ///< of these, for the coordinates of other charts at both ends
  int degree = 0;
  std::size_t multiply_adds_per_point = 0;
  std::size_t products_per_point = 0;
  /// With those of the lower degrees that an estimate needs.
  std::size_t all_multiply_adds_per_point = 0;

  /// Of the polynomials, without the time of the charts.
  double multiply_adds_per_second(double points) const {
    return static_cast<double>(all_multiply_adds_per_point) * points / (seconds - chart_seconds);
  }

  void add(double taken, const MapEvaluator& evaluator) {
    seconds += taken;
    all_multiply_adds_per_point = evaluator.multiply_adds_per_point();
    degree = evaluator.degree();
    multiply_adds_per_point = evaluator.multiply_adds_per_point();
    products_per_point = evaluator.products_per_point();
  }
};

}  // namespace hamjet::cli
