#include "peak_rate.hpp"

#include <experimental/simd>

#include "hamjet/detail/algebra/pack.hpp"
#include "timing.hpp"

namespace hamjet::benchmarks {
namespace {

// As wide as the machine.
using P = Pack<double, 16>;
constexpr long rounds = 1'000'000;

void multiply_and_add() {
  using V = P::Vector;
  const V factor(0.9999999);
  const V term(1e-9);
  V a(1.0), b(1.1), c(1.2), d(1.3), e(1.4), f(1.5), g(1.6), h(1.7), i(1.8), j(1.9), k(2.0), l(2.1);
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
}

}  // namespace

double peak_rate() {
  return static_cast<double>(12 * rounds * P::width) / seconds_of(multiply_and_add);
}

}  // namespace hamjet::benchmarks
