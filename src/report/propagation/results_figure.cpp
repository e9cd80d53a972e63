#include "../drawing/along_time_charts.hpp"
#include "../drawing/study_figure.hpp"
#include "hamjet/report/results.hpp"

namespace hamjet::io {

std::string figure_svg(const PropagationResult& result, std::optional<std::string>& problem) {
  if (!result.scene.figure) return "";
  std::vector<RunAlongTime> runs;
  for (const RunResult& run : result.runs) {
    if (run.along_time) {
      runs.push_back(*run.along_time);
    } else {
      runs.push_back({run.settings.label, run.failure, {}, {}});
    }
  }
  const auto kind = figure_kind(result.scene, result.problem);
  return draw_figure({kind ? exactness_along_time_chart(result.scene, kind, runs)
                           : energy_along_time_chart(result.scene, runs)},
                     problem);
}

}  // namespace hamjet::io
