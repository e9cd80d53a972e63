#include <fmt/format.h>

#include <algorithm>

#include "../studies/formation/charts/free_coordinates.hpp"
#include "scene_relative_motion.hpp"

namespace hamjet::io {
namespace {

constexpr int default_times = 12;
constexpr int fewest_samples = 10;
constexpr int most_samples = 10000;

/// The semi-axes, relative to the largest.
std::vector<double> read_semi_axes(const TableReader& validity, std::size_t count) {
  std::vector<double> axes = validity.positive_numbers("semi_axes", count);
  const double largest = *std::max_element(axes.begin(), axes.end());
  for (double& axis : axes) axis /= largest;
  axes.resize(3, 1.0);
  return axes;
}

}  // namespace

const TableDescription& validity_table() {
  static const ValiditySettings preset;
  static const TableDescription table = {joined<SceneKey>(
      {{{"tolerance_m", form::positive(), absent::value(preset.tolerance_m), "the largest miss"}},
       transfer_time_keys(absent::other(fmt::format("`count = {}`", default_times))),
       {{"semi_axes", form::words("array of 3 numbers above 0", form::array(form::positive(), 3)),
         absent::value(preset.semi_axes),
         "semi-axes of the ellipsoid of positions along the axes of the frame, as many as a system "
         "of the scene's own has coordinates; velocities fill the same one times the mean motion"},
        {"samples", form::integer(fewest_samples, most_samples), absent::value(preset.samples),
         "deputies that are flown"},
        {"separation_m", form::positive(), absent::other("domains are not counted"),
         "also how many domains, with polynomials about centres of their own, deputies within this "
         "separation take at the last time"},
        {"most_domains", form::integer(1, most_samples), absent::value(preset.most_domains),
         "no more are made"}},
       relative_frame_keys(absent::value("RTN"))})};
  return table;
}

ValiditySettings read_validity(const TableReader& validity, const Scene& scene,
                               const Nominal& nominal) {
  validity.check_keys();
  require_deviations(validity, scene);
  ValiditySettings settings;
  validity.read_if_any("tolerance_m", settings.tolerance_m);
  settings.times = read_transfer_times(validity, scene, nominal, default_times);
  settings.frame = read_relative_frame(validity, nominal);
  if (validity.has("semi_axes")) {
    settings.semi_axes = read_semi_axes(validity, told_coordinates(scene.system));
  }
  validity.read_if_any("samples", settings.samples);
  if (validity.has("separation_m")) {
    if (!is_orbit(scene.system.model)) {
      validity.fail(
          "separation_m",
          fmt::format("of deputies about an orbit, got {} along the coordinates of an own "
                      "system, must be left out",
                      validity.found("separation_m")));
    }
    settings.separation_m = validity.positive_number("separation_m");
  }
  validity.read_if_any("most_domains", settings.most_domains);
  return settings;
}

}  // namespace hamjet::io
