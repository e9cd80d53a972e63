#include <fmt/format.h>

#include <functional>
#include <utility>

#include "cases.hpp"
#include "hamjet/algebra/slice_product.hpp"
#include "timing.hpp"

namespace hamjet::benchmarks {
namespace {

constexpr int lanes = 8;
using P = Pack<double, lanes>;

/// Keeps the compiler from seeing what happens to an object.
template <class T>
void forget(T& object) {
  asm volatile("" : : "r"(&object) : "memory");
}

/// Multiply-adds of reals a second with all operands in registers: independent chains, enough to
/// cover the latency.
double peak_rate() {
  using V = P::Vector;
  constexpr long rounds = 3'000'000;
  const auto run = [] {
    const V factor(0.9999999);
    const V term(1e-9);
    V a(1.0), b(1.1), c(1.2), d(1.3), e(1.4), f(1.5), g(1.6), h(1.7), i(1.8), j(1.9), k(2.0),
        l(2.1);
    for (long r = 0; r < rounds; ++r) {
      a = a * factor + term;
      b = b * factor + term;
      c = c * factor + term;
      d = d * factor + term;
      e = e * factor + term;
      f = f * factor + term;
      g = g * factor + term;
      h = h * factor + term;
      i = i * factor + term;
      j = j * factor + term;
      k = k * factor + term;
      l = l * factor + term;
    }
    volatile double sink = std::experimental::reduce(a + b + c + d + e + f + g + h + i + j + k + l);
    static_cast<void>(sink);
  };
  const double seconds = median_seconds({run}, 5)[0];
  return static_cast<double>(12 * rounds * P::width) / seconds;
}

}  // namespace

void benchmark_products() {
  const double peak = peak_rate();
  fmt::print(
      "\n(b) products of series on packs of {} lanes, 6 variables; peak {:.1f} Gmultiply-adds/s\n",
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
