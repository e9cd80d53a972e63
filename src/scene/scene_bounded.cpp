#include <fmt/format.h>

#include <algorithm>

#include "scene_relative_motion.hpp"
#include "tables_of_studies.hpp"

namespace hamjet::io {
namespace {

constexpr double largest_part = 0.95;
constexpr int fewest_revolutions = 10;
constexpr int most_revolutions = 100000;
constexpr double metres_in_km = 1000;
constexpr double shortest_return = 0.01;
constexpr double longest_return = 5;
constexpr double shortest_days = 0.01;
constexpr double longest_days = 3650;

std::vector<double> default_sizes_km() {
  std::vector<double> sizes = BoundedSettings{}.sizes_m;
  for (double& size : sizes) size /= metres_in_km;
  return sizes;
}

const TableDescription& box_table() {
  static const BoxSettings preset;
  static const TableDescription table = {
      {{"half_widths_m", form::array(form::positive(), 3), absent::refused(),
        "distances along the chief's R, T and N from the box's middle to its faces"},
       {"reference", form::choice({"rest", "member"}), absent::value("member"),
        "the box's middle: `position_m`, where each return ends at rest in rotating axes; or the "
        "deputy of the first of `sizes_km`, whose motion each return ends with"},
       {"position_m", form::array(form::number(), 3), absent::other("refused with `rest`"),
        "R, T and N of the box's middle, with `rest`"},
       {"return_orbits", form::array(form::between(shortest_return, longest_return)),
        absent::value(preset.return_orbits),
        "times that a return may take, in the chief's nodal periods; the cheapest of those that "
        "stay inside is flown"},
       {"days", form::between(shortest_days, longest_days), absent::value(preset.days),
        "number of days for which the deputy is kept"}},
      "A box in which the scene's `[deputy]` is kept by two impulses each time that it leaves; "
      "without a table `[deputy]` a deputy that starts as the reference is kept."};
  return table;
}

BoxSettings read_box(const TableReader& box) {
  box.check_keys();
  BoxSettings settings;
  const std::vector<double> widths = box.positive_numbers("half_widths_m", 3);
  settings.half_widths_m.emplace(widths[0], widths[1], widths[2]);
  if (box.has("reference")) settings.reference = BoxReference(box.choice("reference"));
  if (settings.reference == BoxReference::rest) {
    const std::vector<double> place = box.numbers("position_m", 3);
    settings.position_m = {place[0], place[1], place[2]};
  } else if (box.has("position_m")) {
    box.fail("position_m",
             "not of this reference, got a place, must be left out with "
             "reference = \"member\", or reference = \"rest\"");
  }
  if (box.has("return_orbits")) {
    settings.return_orbits = box.numbers("return_orbits");
    for (std::size_t i = 0; i < settings.return_orbits.size(); ++i) {
      const double part = settings.return_orbits[i];
      if (part >= shortest_return && part <= longest_return) continue;
      box.fail_element("return_orbits", i,
                       fmt::format("out of range, got {}, must be from {} to {}", part,
                                   shortest_return, longest_return));
    }
    std::sort(settings.return_orbits.begin(), settings.return_orbits.end());
  }
  box.read_if_any("days", settings.days);
  return settings;
}

const TableDescription& bounded_table() {
  static const BoundedSettings preset;
  static const TableDescription table = {
      {{"sizes_km", form::array(form::positive()), absent::value(default_sizes_km()),
        "largest distances from the chief over the first revolution; a deputy of each"},
       {"phase_deg", form::number(), absent::value(preset.phase_deg),
        "direction of the difference of the eccentricity vectors: at 0 the eccentricity grows, at "
        "90 the pericentre turns ahead"},
       {"cross_track", form::between(-largest_part, largest_part),
        absent::value(preset.cross_track),
        "how far the difference in node takes the deputy across the chief's plane, in parts of the "
        "size"},
       {"along_track", form::between(-1, 1), absent::value(preset.along_track),
        "how far it is ahead of the chief in the mean, in parts of the size"},
       {"revolutions", form::integer(fewest_revolutions, most_revolutions),
        absent::value(preset.revolutions),
        "number of revolutions over which mean periods and drifts of the node are the chief's; all "
        "deputies are flown so long"},
       {"refine", form::boolean(), absent::value(preset.refine),
        "whether to correct the polynomials' deputies by flying too, until the flown means are the "
        "chief's"},
       {"box", form::table(box_table()), absent::other("no box"), "stationkeeping"}},
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
  if (bounded.has("box")) settings.box = read_box(bounded.table("box"));
  return settings;
}

}  // namespace

TableOfStudy bounded_of_scenes() {
  return {.name = "bounded",
          .description = &bounded_table,
          .absence = "none",
          .help = "what `hamjet bounded` works on",
          .read = [](const TableReader& table, Scene& scene, const Nominal&) {
            scene.bounded = read_bounded(table, scene);
          }};
}

}  // namespace hamjet::io
