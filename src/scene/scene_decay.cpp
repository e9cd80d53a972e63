#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "../studies/checks/decay.hpp"
#include "../studies/checks/force_sizes.hpp"
#include "../text/scene_message.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {

std::vector<std::string> warnings_of_decay(const TableReader& root, const Scene& scene) {
  constexpr double least_height_km = 150;
  std::vector<std::string> warnings;
  const auto add = [&](std::string_view table, const std::string& what) {
    warnings.push_back(fmt::format("{}{}: {}", warning_head, root.table(table).head(""), what));
  };
  bool has_decayed = false;
  for (const Decay& decay : find_decays(scene)) {
    const bool is_chief = decay.spacecraft == "chief";
    has_decayed = has_decayed || is_chief;
    add(is_chief ? "nominal" : "deputy",
        fmt::format("the {} decays, got one that is down to {:.6g} km {:.3g} h after its start "
                    "(t = {:.6g} s), should be a higher orbit, less drag, or times up to {} s",
                    decay.spacecraft, decay.height_km, decay.time_s / 3600, decay.time_s,
                    std::floor(decay.time_s)));
  }
  const double perigee_km =
      perigee_height_km(scene, scene.nominal).value_or(std::numeric_limits<double>::infinity());
  if (perigee_km > 0 && perigee_km < least_height_km && !has_decayed) {
    add("nominal",
        fmt::format("low, got a perigee {:.4g} km high, should be above {} km: {}", perigee_km,
                    least_height_km,
                    scene.system.earth->atmosphere
                        ? "the air ends such orbits within days"
                        : "the air, which this scene leaves out, ends such orbits within days"));
  }
  if (scene.system.earth && scene.system.earth->atmosphere) {
    const std::vector<double>& heights = scene.system.earth->atmosphere->heights_km;
    if (!heights.empty() && (perigee_km < heights.front() || perigee_km > heights.back()) &&
        std::isfinite(perigee_km)) {
      add("system",
          fmt::format("a table of densities elsewhere, got heights from {:.6g} to {:.6g} km beside "
                      "a perigee {:.4g} km high, should reach it: beyond its ends the table goes "
                      "on exponentially",
                      heights.front(), heights.back(), perigee_km));
    }
  }
  if (!scene.thruster) return warnings;
  const double drag = drag_m_s2(scene);
  if (scene.thruster->acceleration_m_s2 < drag) {
    add("thruster",
        fmt::format("weaker than the air, got {:.4g} m/s^2, should be more than the {:.4g} m/s^2 "
                    "of drag on the chief at its start: it cannot hold that orbit",
                    scene.thruster->acceleration_m_s2, drag));
  }
  return warnings;
}

}  // namespace hamjet::io
