#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "cases.hpp"
#include "hamjet/detail/algebra/slice_product.hpp"
#include "peak_rate.hpp"
#include "timing.hpp"

namespace hamjet::benchmarks {
namespace {

constexpr int lanes = 8;
using P = Pack<double, lanes>;

}  // namespace

void benchmark_products() {
  std::vector<double> samples;
  for (int r = 0; r < 5; ++r) samples.push_back(peak_rate());
  std::nth_element(samples.begin(), samples.begin() + 2, samples.end());
  const double peak = samples[2];
  fmt::print(
      "\nproducts of series on packs of {} lanes, 6 variables; peak {:.1f} Gmultiply-adds/s\n",
      lanes, peak * 1e-9);
  fmt::print("{:>5} {:>14} {:>13} {:>10} {:>13} {:>10}\n", "order", "multiply-adds", "product",
             "of peak", "square", "of peak");
  for (int order = 3; order <= 8; ++order) {
    const SpacePointer space = SeriesSpace::create(6, order);
    std::vector<P> a(space->size(), P(1.5));
    std::vector<P> b(space->size(), P(0.75));
    std::vector<P> c(space->size(), P(0.0));
    double product_cost = 0;
    double square_cost = 0;
    for (int d = 2; d <= order; ++d) {
      product_cost += static_cast<double>(space->products(d).multiply_adds);
      square_cost += static_cast<double>(space->products(d).square_multiply_adds);
    }
    const int rounds = std::max(1, static_cast<int>(2e7 / product_cost));
    const auto seconds =
        median_seconds({[&] {
                          for (int r = 0; r < rounds; ++r) {
                            for (int d = 2; d <= order; ++d)
                              interior_product(*space, d, a.data(), b.data(), c.data());
                            forget(*c.data());
                          }
                        },
                        [&] {
                          for (int r = 0; r < rounds; ++r) {
                            for (int d = 2; d <= order; ++d)
                              interior_square(*space, d, a.data(), c.data());
                            forget(*c.data());
                          }
                        }},
                       9);
    const double product_rate = product_cost * lanes * rounds / seconds[0];
    const double square_rate = square_cost * lanes * rounds / seconds[1];
    fmt::print("{:>5} {:>14} {:>10.2f} us {:>8.0f} % {:>10.2f} us {:>8.0f} %\n", order,
               product_cost * lanes, seconds[0] / rounds * 1e6, 100 * product_rate / peak,
               seconds[1] / rounds * 1e6, 100 * square_rate / peak);
  }
}

}  // namespace hamjet::benchmarks
