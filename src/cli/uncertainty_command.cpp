#include "uncertainty_command.hpp"

#include "../app/report_origin.hpp"
#include "../app/required_tables.hpp"
#include "../app/uncertainty_sections.hpp"
#include "../report/uncertainty/uncertainty_report.hpp"
#include "../studies/uncertainty/uncertainty.hpp"
#include "study_command.hpp"

namespace hamjet::cli {

int uncertainty(const RunOptions& options) {
  const Scene scene = read_unsplit_scene(options, "hamjet uncertainty");
  require_uncertainty(scene, *options.scene_file);
  return report_study(
      options, scene.name + uncertainty_suffix, [&](const ProgressCallback& progress) {
        return study_of(*options.scene_file, [&] {
          const UncertaintyResult moments = study_uncertainty(scene, progress);
          const auto sections = uncertainty_sections(scene, progress);
          return io::uncertainty_report(moments, report_origin(options.command), sections);
        });
      });
}

}  // namespace hamjet::cli
