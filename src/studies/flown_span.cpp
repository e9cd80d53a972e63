#include "flown_span.hpp"

#include <algorithm>
#include <cmath>

#include "../astronomy/sampled_days.hpp"
#include "formation/jets_about_time.hpp"

namespace hamjet {
namespace {

/// How far polynomials of flow boxes, which are known at times about an end, need forces that
/// depend on the time beyond what such forces are known for anyway.
double beyond_ends(const Scene& scene) {
  constexpr double known_s = 0.99 * 86400 * days_beyond_span;
  const bool has_boxes = scene.coordinates == JetCoordinates::flow_box ||
                         scene.coordinates == JetCoordinates::automatic || scene.validity;
  if (!scene.system.earth || !has_boxes) return 0;
  return std::max(0.0, longest_time_about(scene.nominal) - known_s / scene.units.time_s);
}

}  // namespace

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
  const double beyond = beyond_ends(scene);
  return {span.first - beyond, span.last + beyond};
}

double last_arrival(const TransferSettings& settings) {
  const double last = settings.times.back();
  return last + std::copysign(settings.longest_coast.value_or(0), last);
}

}  // namespace hamjet
