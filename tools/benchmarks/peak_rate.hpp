#pragma once

namespace hamjet::benchmarks {

/// Multiply-adds of reals a second with all operands in registers: independent chains, enough to
/// cover the latency. One sample of a few milliseconds, to be taken beside what it is compared to.
double peak_rate();

/// Keeps the compiler from seeing what happens to an object.
template <class T>
void forget(T& object) {
  asm volatile("" : : "r"(&object) : "memory");
}

}  // namespace hamjet::benchmarks
