#include "validity_command.hpp"

#include "../app/report_origin.hpp"
#include "../app/scene_refusal.hpp"
#include "../report/study_description.hpp"
#include "hamjet/report/relative_motion_report.hpp"
#include "study_command.hpp"

namespace hamjet::cli {

int validity_in_all_coordinates(const RunOptions& options) {
  const Scene scene = read_scene(options);
  const io::StudyDescription& study = io::study_of_table("validity");
  io::require_scene_of(study, scene, *options.scene_file);
  return report_study(options, scene.name + study.suffix(), [&](const ProgressCallback& progress) {
    return io::coordinates_report(
        study_of(*options.scene_file, [&] { return study_validity_in_all(scene, progress); }),
        report_origin(options.command));
  });
}

}  // namespace hamjet::cli
