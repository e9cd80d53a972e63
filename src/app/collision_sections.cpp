#include "collision_sections.hpp"

#include "../report/uncertainty/collision_section.hpp"
#include "processors.hpp"

namespace hamjet::cli {

std::vector<io::UncertaintySection> collision_sections(const Scene& scene,
                                                       const ProgressCallback& progress) {
  if (!scene.uncertainty || !scene.uncertainty->collision) return {};
  return {io::collision_section(scene, study_collision(scene, usable_processors(), progress))};
}

}  // namespace hamjet::cli
