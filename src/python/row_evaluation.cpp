#include "row_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <experimental/simd>

namespace hamjet::python {
namespace {

/// Points that are evaluated at once: their numbers stay in the cache, and this is a multiple of
/// the points that MapEvaluator takes together on any machine.
constexpr std::size_t block = 960;

/// Columns of a state in space, known to the compiler.
constexpr std::size_t usual_columns = 6;

using Vector = std::experimental::native_simd<double>;

void split(const double* rows, std::size_t count, std::size_t columns, double* result) {
  std::size_t first = 0;
  if (columns == usual_columns) {
    // One store for a vector takes half the time of one for each number.
    for (; first + Vector::size() <= count; first += Vector::size()) {
      for (std::size_t i = 0; i < usual_columns; ++i) {
        const Vector column(
            [&](std::size_t lane) { return rows[(first + lane) * usual_columns + i]; });
        column.copy_to(result + i * count + first, std::experimental::element_aligned);
      }
    }
  }
  for (std::size_t i = 0; i < columns; ++i) {
    for (std::size_t j = first; j < count; ++j) result[i * count + j] = rows[j * columns + i];
  }
}

void join(const double* columns_first, std::size_t count, std::size_t columns, double* rows) {
  if (columns == usual_columns) {
    for (std::size_t j = 0; j < count; ++j) {
      for (std::size_t i = 0; i < usual_columns; ++i) {
        rows[j * usual_columns + i] = columns_first[i * count + j];
      }
    }
    return;
  }
  for (std::size_t i = 0; i < columns; ++i) {
    for (std::size_t j = 0; j < count; ++j) rows[j * columns + i] = columns_first[i * count + j];
  }
}

/// x - x is 0 for a finite number and NaN for the others; eight sums are a run of vector additions.
bool all_finite(const std::vector<double>& values) {
  double sums[8] = {};
  std::size_t i = 0;
  for (; i + 8 <= values.size(); i += 8) {
    for (std::size_t lane = 0; lane < 8; ++lane) {
      sums[lane] += values[i + lane] - values[i + lane];
    }
  }
  for (; i < values.size(); ++i) sums[0] += values[i] - values[i];
  double sum = 0;
  for (const double s : sums) sum += s;
  return sum == 0;
}

}  // namespace

std::size_t evaluate_rows(const MapEvaluator& map, const double* points, std::size_t count,
                          double* values, const std::function<void()>& pause) {
  std::vector<double> block_points;
  std::vector<double> block_values;
  std::size_t not_finite = 0;
  for (std::size_t first = 0; first < count; first += block) {
    const std::size_t here = std::min(block, count - first);
    block_points.resize(map.variables() * here);
    block_values.resize(map.components() * here);
    split(points + first * map.variables(), here, map.variables(), block_points.data());
    map.evaluate(block_points, {block_values, {}, {}});
    join(block_values.data(), here, map.components(), values + first * map.components());
    if (!all_finite(block_values)) {
      not_finite += static_cast<std::size_t>(std::count_if(
          block_values.begin(), block_values.end(), [](double x) { return !std::isfinite(x); }));
    }
    pause();
  }
  return not_finite;
}

}  // namespace hamjet::python
