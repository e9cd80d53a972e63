#include <fmt/format.h>

#include <algorithm>

#include "scene_relative_motion.hpp"

namespace hamjet::io {
namespace {

constexpr int default_times = 12;
constexpr int fewest_samples = 10;
constexpr int most_samples = 10000;

/// The semi-axes, relative to the largest.
std::vector<double> read_semi_axes(const TableReader& validity) {
  std::vector<double> axes = validity.numbers("semi_axes", 3);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!(axes[i] > 0)) {
      validity.fail_element("semi_axes", i,
                            fmt::format("not positive, got {}, must be a number above 0", axes[i]));
    }
  }
  const double largest = *std::max_element(axes.begin(), axes.end());
  for (double& axis : axes) axis /= largest;
  return axes;
}

}  // namespace

ValiditySettings read_validity(const TableReader& validity, const Scene& scene,
                               const Nominal& nominal) {
  validity.check_keys({{"tolerance_m", "times_s", "times_orbits", "times_canonical", "count",
                        "semi_axes", "samples", "frame", "derivatives"}});
  require_relative_motion(validity, scene);
  ValiditySettings settings;
  if (validity.has("tolerance_m")) settings.tolerance_m = validity.positive_number("tolerance_m");
  settings.times = read_transfer_times(validity, scene, nominal, default_times);
  settings.frame = read_relative_frame_or_rtn(validity);
  if (validity.has("semi_axes")) settings.semi_axes = read_semi_axes(validity);
  if (validity.has("samples")) {
    settings.samples =
        static_cast<int>(validity.integer_between("samples", fewest_samples, most_samples));
  }
  return settings;
}

}  // namespace hamjet::io
