#include "flown_span.hpp"

#include <algorithm>
#include <cmath>

namespace hamjet {

FlownSpan flown_span(const Scene& scene) {
  FlownSpan span;
  const auto reach = [&](double time) {
    span.first = std::min(span.first, time);
    span.last = std::max(span.last, time);
  };
  reach(scene.duration);
  for (const double time : scene.relative_hamiltonian_times) reach(time);
  if (scene.transfer) reach(last_arrival(*scene.transfer));
  if (scene.transfer && scene.thruster && scene.transfer->thrust != TransferThrust::fuel_optimal) {
    // Half of a burn is before the first impulse, or after the last: no burn takes twice as long as
    // its transfer.
    reach(-scene.transfer->times.back());
    reach(2 * scene.transfer->times.back());
  }
  if (scene.validity) reach(scene.validity->times.back());
  if (const auto& uncertainty = scene.uncertainty) {
    if (!uncertainty->times.empty()) reach(uncertainty->times.back());
    const auto reach_window = [&](const auto& watch) {
      if (!watch) return;
      reach(watch->from);
      reach(watch->to);
    };
    reach_window(uncertainty->collision);
    reach_window(uncertainty->safety);
  }
  return span;
}

double last_arrival(const TransferSettings& settings) {
  const double last = settings.times.back();
  return last + std::copysign(settings.longest_coast.value_or(0), last);
}

}  // namespace hamjet
