#include <fmt/format.h>

#include "scene_relative_motion.hpp"

namespace hamjet::io {

std::vector<SceneKey> domain_keys(const Absence& tolerance, std::string_view tolerance_meaning,
                                  std::string_view most_meaning) {
  constexpr int most = 10000;
  static const DomainSettings preset;
  return {
      {"tolerance_m", form::positive(), tolerance, tolerance_meaning},
      {"most_domains", form::integer(1, most), absent::value(preset.most_domains), most_meaning}};
}

DomainSettings read_domains(const TableReader& table, const Scene& scene, std::string_view what) {
  if (scene.order < 2) {
    table.fail("", fmt::format("no estimate of the miss to split {} by, got jet.order = 1, must be "
                               "beside an order of 2 or more",
                               what));
  }
  DomainSettings settings;
  table.read_if_any("tolerance_m", settings.tolerance_m);
  table.read_if_any("most_domains", settings.most_domains);
  return settings;
}

}  // namespace hamjet::io
