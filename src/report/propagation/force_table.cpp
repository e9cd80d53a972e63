#include "force_table.hpp"

#include <fmt/format.h>

#include "../../store/result_table.hpp"
#include "../../text/quantity_text.hpp"
#include "hamjet/astronomy/earth_orientation.hpp"

namespace hamjet::io {

TableView force_table(const std::vector<ForceSize>& forces) {
  ResultTable<ForceSize> table("forces", "/forces", {"forces"},
                               "How large each force of the real Earth is along the chief's orbit, "
                               "and what leaving it out changes.");
  table.add("force", "", "what is left out", &ForceSize::name);
  table.add("key", "", "the key of `[system]` that leaves the force out", &ForceSize::key);
  table.add("largest_m_s2", "m/s^2",
            "the largest acceleration by the force along the chief's orbit",
            &ForceSize::largest_m_s2);
  table.add("chief_m", "m", "by how much the chief's position changes without the force, at most",
            &ForceSize::chief_m);
  table.add(
      "relative_m", "m",
      "by how much the deputy's position relative to the chief changes without the force, at most",
      &ForceSize::relative_m);
  return std::move(table).view(forces, {forces.size()});
}

std::string force_text(const Scene& scene, const std::vector<ForceSize>& forces) {
  if (!scene.system.earth) return "";
  const EarthSettings& earth = *scene.system.earth;
  std::string text = fmt::format("  forces       the Earth's field to {} x {}{}{}; epoch {} TT\n",
                                 earth.degree, earth.order, earth.has_sun ? ", Sun" : "",
                                 earth.has_moon ? ", Moon" : "", earth.epoch_tt);
  if (earth.orientation_file.empty()) {
    text += fmt::format("               {}\n", EarthOrientation::without_table());
  }
  if (forces.empty()) return text;
  // Lines of 79 characters, which are not wrapped.
  constexpr auto row = "    {:18} {:>9}  {:>9}  {:>14}  {}\n";
  text += "  left out\n";
  text += fmt::format(row, "", "m/s^2", "chief", scene.deputy ? "deputy - chief" : "", "by");
  for (const ForceSize& force : forces) {
    text += fmt::format(row, force.name, fmt::format("{:.2e}", force.largest_m_s2),
                        length_text(force.chief_m),
                        force.relative_m ? length_text(*force.relative_m) : "", force.key);
  }
  return text;
}

}  // namespace hamjet::io
