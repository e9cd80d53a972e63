#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <functional>
#include <vector>

namespace hamjet::benchmarks {

inline double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The processor's time of work on one thread, which other programs lengthen less.
inline double processor_seconds_of(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Median times of several pieces of work. The repeats are interleaved, so that a noisy machine
/// hurts all alike; compare the ratios, not single figures.
inline std::vector<double> median_seconds(
    const std::vector<std::function<void()>>& works, int repeats,
    double (*time_of)(const std::function<void()>&) = seconds_of) {
  std::vector<std::vector<double>> times(works.size());
  for (int r = 0; r < repeats; ++r) {
    for (std::size_t i = 0; i < works.size(); ++i) times[i].push_back(time_of(works[i]));
  }
  std::vector<double> medians;
  for (auto& t : times) {
    std::nth_element(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(t.size() / 2), t.end());
    medians.push_back(t[t.size() / 2]);
  }
  return medians;
}

}  // namespace hamjet::benchmarks
