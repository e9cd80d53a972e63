#include "uncertainty_command.hpp"

#include "../app/report_origin.hpp"
#include "../app/required_tables.hpp"
#include "../report/uncertainty/uncertainty_report.hpp"
#include "../studies/uncertainty/uncertainty.hpp"
#include "study_command.hpp"

namespace hamjet::cli {

int uncertainty(const RunOptions& options) {
  const Scene scene = read_unsplit_scene(options, "hamjet uncertainty");
  require_uncertainty(scene, *options.scene_file);
  return report_study(
      options, scene.name + uncertainty_suffix, [&](const ProgressCallback& progress) {
        return io::uncertainty_report(
            study_of(*options.scene_file, [&] { return study_uncertainty(scene, progress); }),
            report_origin(options.command));
      });
}

}  // namespace hamjet::cli
