#include "sample_memory.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hamjet/error.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {
namespace {

/// Six numbers.
constexpr double state_bytes = 6 * sizeof(double);
/// The memory that computing the moments of a sample takes: eight copies of its state (2026-11-26).
constexpr double copies_for_moments = 8;
/// A least separation, its sorted copy, its index and its flight.
constexpr double separation_bytes = 4 * sizeof(double);
constexpr double megabyte = 1e6;

}  // namespace

double sample_memory(const Scene& scene) {
  if (!scene.uncertainty) return 0;
  const UncertaintySettings& settings = *scene.uncertainty;
  const double spacecraft = scene.deputy && settings.chief ? 2 : 1;
  const double states = spacecraft == 2 ? 3 : 1;  // including the difference of deputy and chief
  const double kept = spacecraft + states * static_cast<double>(settings.times.size());
  const double flown = settings.samples < 2 ? 0
                                            : static_cast<double>(settings.samples) * state_bytes *
                                                  (kept + copies_for_moments);
  const double separations =
      settings.safety ? static_cast<double>(settings.safety->samples) * separation_bytes : 0;
  return std::max(flown, separations);
}

void require_sample_memory(const Scene& scene) {
  constexpr double always_there = 32 * megabyte;
  const double needed = sample_memory(scene);
  if (needed <= always_there) return;
  const double free = available_memory();
  if (needed <= free) return;
  throw Error(ErrorKind::too_large,
              fmt::format("uncertainty.samples: {} at {} times take about {:.0f} MB, but {:.0f} MB "
                          "are free; fewer samples or times would fit",
                          scene.uncertainty->samples, scene.uncertainty->times.size(),
                          needed / megabyte, free / megabyte));
}

}  // namespace hamjet
