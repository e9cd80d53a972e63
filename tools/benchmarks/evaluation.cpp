#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <vector>

#include "cases.hpp"
#include "hamjet/maps/map_evaluator.hpp"
#include "peak_rate.hpp"
#include "timing.hpp"

namespace hamjet::benchmarks {
namespace {

constexpr std::size_t variables = 6;
constexpr std::size_t points_at_once = 4096;  // as `hamjet eval` takes them
constexpr int repeats = 41;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void benchmark_evaluation() {
  fmt::print(
      "\na map of 6 components in 6 variables at many points, {} at once; the products that "
      "form the\n    monomials take time and are not counted as multiply-adds\n",
      points_at_once);
  fmt::print("{:>5} {:>14} {:>9} {:>12} {:>9} {:>18} {:>9}\n", "order", "multiply-adds", "products",
             "a point", "of peak", "with last degrees", "of peak");
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int order = 1; order <= 8; ++order) {
    const SpacePointer space = SeriesSpace::create(variables, order);
    std::vector<Series<double>> map(variables, Series<double>(space));
    for (auto& component : map) {
      for (double& c : component.coefficients()) c = uniform(generator);
    }
    const MapEvaluator evaluator(map);
    std::vector<double> points(variables * points_at_once);
    for (double& x : points) x = uniform(generator);
    std::vector<double> values(points.size());
    std::vector<double> last(points.size());
    std::vector<double> last_but_one(points.size());
    const auto multiply_adds = static_cast<double>(evaluator.multiply_adds_per_point());
    const int rounds =
        1 + static_cast<int>(3e7 / (multiply_adds * static_cast<double>(points_at_once)));
    const double evaluations = rounds * static_cast<double>(points_at_once);
    const auto seconds_with = [&](const MapValues& results) {
      return seconds_of([&] {
        for (int r = 0; r < rounds; ++r) {
          evaluator.evaluate(points, results);
          forget(*values.data());
        }
      });
    };
    // The peak is measured beside each sample: the clock frequency changes from moment to moment.
    std::vector<double> plain;
    std::vector<double> full;
    std::vector<double> plain_share;
    std::vector<double> full_share;
    for (int r = 0; r < repeats; ++r) {
      const double peak = peak_rate();
      plain.push_back(seconds_with({values, {}, {}}) / evaluations);
      full.push_back(seconds_with({values, last, last_but_one}) / evaluations);
      plain_share.push_back(multiply_adds / plain.back() / peak);
      full_share.push_back(multiply_adds / full.back() / peak);
    }
    fmt::print("{:>5} {:>14} {:>9} {:>9.1f} ns {:>7.0f} % {:>15.1f} ns {:>7.0f} %\n", order,
               multiply_adds, evaluator.products_per_point(), median(plain) * 1e9,
               100 * median(plain_share), median(full) * 1e9, 100 * median(full_share));
  }
}

}  // namespace hamjet::benchmarks
