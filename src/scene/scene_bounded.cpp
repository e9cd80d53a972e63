#include <fmt/format.h>

#include "scene_relative_motion.hpp"

namespace hamjet::io {
namespace {

constexpr double largest_part = 0.95;
constexpr int fewest_revolutions = 10;
constexpr int most_revolutions = 100000;
constexpr double metres_in_km = 1000;

std::vector<double> default_sizes_km() {
  std::vector<double> sizes = BoundedSettings{}.sizes_m;
  for (double& size : sizes) size /= metres_in_km;
  return sizes;
}

}  // namespace

const TableDescription& bounded_table() {
  static const BoundedSettings preset;
  static const TableDescription table = {
      {{"sizes_km", form::array(form::positive()), absent::value(default_sizes_km()),
        "largest distances from the chief over the first revolution; a deputy of each"},
       {"phase_deg", form::number(), absent::value(preset.phase_deg),
        "of the difference of the eccentricity vectors: at 0 the eccentricity grows, at 90 the "
        "pericentre turns ahead"},
       {"cross_track", form::between(-largest_part, largest_part),
        absent::value(preset.cross_track),
        "what the node's difference takes it across the chief's plane, in parts of the size"},
       {"along_track", form::between(-1, 1), absent::value(preset.along_track),
        "how far it is ahead of the chief in the mean, in parts of the size"},
       {"revolutions", form::integer(fewest_revolutions, most_revolutions),
        absent::value(preset.revolutions),
        "over which mean periods and drifts of the node are the chief's; all are flown so long"},
       {"refine", form::boolean(), absent::value(preset.refine),
        "also correct the polynomials' deputies by flying, until the flown means are the chief's"}},
      "Deputies that stay with the chief for long without fuel."};
  return table;
}

BoundedSettings read_bounded(const TableReader& bounded, const Scene& scene) {
  bounded.check_keys();
  require_relative_motion(bounded, scene);
  BoundedSettings settings;
  if (bounded.has("sizes_km")) {
    settings.sizes_m = bounded.numbers("sizes_km");
    if (settings.sizes_m.empty()) {
      bounded.fail("sizes_km", "empty, got no size, must be at least one");
    }
    for (std::size_t i = 0; i < settings.sizes_m.size(); ++i) {
      double& size = settings.sizes_m[i];
      const double distance_km =
          Eigen::Vector3d(scene.nominal.data()).norm() * scene.units.length_km;
      if (!(size > 0 && size < distance_km)) {
        bounded.fail_element("sizes_km", i,
                             fmt::format("out of range, got {}, must be above 0 and below the "
                                         "chief's distance from the centre, {:.6g}",
                                         size, distance_km));
      }
      size *= metres_in_km;
    }
  }
  bounded.read_if_any("phase_deg", settings.phase_deg);
  bounded.read_if_any("cross_track", settings.cross_track);
  bounded.read_if_any("along_track", settings.along_track);
  bounded.read_if_any("revolutions", settings.revolutions);
  if (bounded.has("refine")) settings.refine = bounded.boolean("refine");
  return settings;
}

}  // namespace hamjet::io
