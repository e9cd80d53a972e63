#include <fmt/format.h>

#include <cmath>

#include "scene_relative_motion.hpp"

namespace hamjet::io {
namespace {

/// Largest radius, as a fraction of the chief's distance from the centre.
constexpr double largest_radius = 0.01;
constexpr double smallest_radius = 1e-10;
constexpr int fewest_samples = 1000;
constexpr int most_samples = 1000000000;

}  // namespace

const TableDescription& collision_table() {
  static const CollisionWatch preset;
  static const TableDescription table = {
      {{"radius_m", form::positive(), absent::refused(),
        "the sum of the radii of both spacecraft: nearer than this is a collision"},
       window_key("from the start to the end, and as far before and beyond as a passage goes that "
                  "these cut"),
       {"event", form::choice({collision_event_names.begin(), collision_event_names.end()}),
        absent::value(collision_event_names[0]),
        "what counts as a collision: `nearer`, to be nearer than the radius at any time of the "
        "window; `entry`, to come nearer than the radius within the window, for which a pair that "
        "begins nearer must first leave"},
       {"sampling",
        form::choice({collision_sampling_names.begin(), collision_sampling_names.end()}),
        absent::value(collision_sampling_names[0]),
        "plain: deviations as they are distributed; entries: weighted ones whose linear path "
        "enters a sphere somewhat larger; automatic: entries where they can be drawn"},
       {"samples", form::integer(fewest_samples, most_samples), absent::value(preset.samples),
        "number of samples of the polynomials"},
       {"confidence", form::between(0.5, 0.999999), absent::value(preset.confidence),
        "confidence of the interval that is given"}},
      "Whether chief and deputy may hit each other; both have polynomials of their own."};
  return table;
}

std::array<double, 2> read_window(const TableReader& table, const Scene& scene,
                                  bool may_begin_before) {
  if (!scene.deputy) {
    table.fail("", "the scene has no deputy, got no table [deputy], must have one");
  }
  if (scene.duration < 0) {
    table.fail("", "the scene goes backwards, got a negative duration, must go forwards");
  }
  const double duration_s = scene.duration * scene.units.time_s;
  std::vector<double> window = {0, duration_s};
  if (table.has("window_s")) {
    window = table.numbers("window_s", 2);
    if (!((may_begin_before || window[0] >= 0) && window[0] < window[1])) {
      table.fail("window_s",
                 fmt::format("no window, got {} to {}, must {}end after it begins", window[0],
                             window[1], may_begin_before ? "" : "begin at 0 or later and "));
    }
    // The end of the window may have been rounded when it was written.
    constexpr double rounding = 1e-9;
    if (window[1] > duration_s * (1 + rounding)) {
      table.fail("window_s", fmt::format("beyond the scene's end, got {}, must be at most the "
                                         "duration, {} s",
                                         window[1], duration_s));
    }
  }
  return {window[0] / scene.units.time_s, window[1] / scene.units.time_s};
}

SceneKey window_key(std::string_view absence) {
  return {"window_s", form::array(form::number(), 2), absent::other(std::string(absence)),
          "begin and end of the window after the start, the first before the second; negative "
          "before the start, of a collision without a burn"};
}

double read_nearness(const TableReader& table, std::string_view key, const Scene& scene) {
  const double length_m = table.positive_number(key);
  const double distance_m =
      Eigen::Vector3d(scene.nominal.data()).norm() * scene.units.length_km * 1000;
  if (length_m >= largest_radius * distance_m) {
    table.fail(key, fmt::format("too large, got {:.6g}, must be below {:.4g}, a hundredth "
                                "of the chief's distance from the centre",
                                length_m, largest_radius * distance_m));
  }
  if (length_m < smallest_radius * distance_m) {
    table.fail(key, fmt::format("too small, got {:.6g}, must be {:.3g} or more, to which the "
                                "motion is known",
                                length_m, smallest_radius * distance_m));
  }
  return length_m;
}

CollisionWatch read_collision(const TableReader& collision, const Scene& scene, bool has_burn) {
  collision.check_keys();
  CollisionWatch watch;
  // Before a burn that ends at the start, the trajectory is a different one.
  const auto window = read_window(collision, scene, !has_burn);
  watch.from = window[0];
  watch.to = window[1];
  watch.has_window = collision.has("window_s");
  watch.radius_m = read_nearness(collision, "radius_m", scene);
  collision.read_if_any("event", watch.event);
  collision.read_if_any("sampling", watch.sampling);
  collision.read_if_any("samples", watch.samples);
  collision.read_if_any("confidence", watch.confidence);
  return watch;
}

}  // namespace hamjet::io
