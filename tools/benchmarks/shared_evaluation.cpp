// The evaluation of a map at many points as C++ does it, timed there, for a caller that times its
// own beside it (tools/benchmark-python).

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "hamjet/maps/map_evaluator.hpp"
#include "timing.hpp"

namespace {

constexpr std::size_t points_at_once = 4096;  // as `hamjet eval` takes them

}  // namespace

/// Seconds of evaluating `count` points, laid out as MapEvaluator has them, 4096 at once: of points
/// and values each block is a structure of arrays. `coefficients` are component by component.
/// Without `values` the results go into new memory, which is a part of the time.
extern "C" double hamjet_seconds_of_evaluation(const double* coefficients, std::size_t components,
                                               std::size_t variables, int order,
                                               const double* points, double* values,
                                               std::size_t count) {
  const auto space = hamjet::SeriesSpace::create(variables, order);
  std::vector<hamjet::Series<double>> map;
  for (std::size_t c = 0; c < components; ++c) {
    const double* first = coefficients + c * space->size();
    map.emplace_back(space, std::vector<double>(first, first + space->size()));
    map.back()[0] = 0;  // deviations, as the Python module has them
  }
  const hamjet::MapEvaluator evaluator(map);
  std::unique_ptr<double[]> made;
  return hamjet::benchmarks::seconds_of([&] {
    if (values == nullptr) {
      made = std::make_unique_for_overwrite<double[]>(count * components);
      values = made.get();
    }
    for (std::size_t first = 0; first < count; first += points_at_once) {
      const std::size_t here = std::min(points_at_once, count - first);
      evaluator.evaluate(std::span(points + first * variables, here * variables),
                         {std::span(values + first * components, here * components), {}, {}});
    }
  });
}
