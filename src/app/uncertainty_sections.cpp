#include "uncertainty_sections.hpp"

#include "../report/uncertainty/collision_section.hpp"
#include "../report/uncertainty/safety_section.hpp"
#include "processors.hpp"

namespace hamjet::cli {

std::vector<io::UncertaintySection> uncertainty_sections(const Scene& scene,
                                                         const ProgressCallback& progress) {
  std::vector<io::UncertaintySection> sections;
  if (!scene.uncertainty) return sections;
  if (scene.uncertainty->collision) {
    sections.push_back(
        io::collision_section(scene, study_collision(scene, usable_processors(), progress)));
  }
  if (scene.uncertainty->safety) {
    sections.push_back(io::safety_section(study_safety(scene, usable_processors(), progress)));
  }
  return sections;
}

}  // namespace hamjet::cli
