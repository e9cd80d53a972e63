#include "stability_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "../app/report_origin.hpp"
#include "../report/stability/stability_report.hpp"
#include "../studies/descriptions/method_description.hpp"
#include "../studies/stability/flow_box_cases.hpp"
#include "../text/quantity_text.hpp"
#include "../text/terminal_text.hpp"
#include "hamjet/error.hpp"
#include "process/standard_streams.hpp"
#include "study_command.hpp"

namespace hamjet::cli {
namespace {

/// The folder of the cases that hamjet comes with: that of the working directory, of the tree that
/// the program was built in, or of the installation that it belongs to, wherever that was moved.
std::filesystem::path default_suite() {
  const std::filesystem::path here = "data/scenes/extreme";
  std::error_code ignored;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const std::filesystem::path& folder :
       {here, program / here, program / HAMJET_DATA_FROM_PROGRAM / "scenes/extreme"}) {
    if (std::filesystem::is_directory(folder, ignored)) return folder.lexically_normal();
  }
  throw Error(ErrorKind::input_output,
              fmt::format("{}: no such folder; --suite names a folder of cases", here.string()));
}

/// Leaves out the cases whose integrator is not in this build (CVODE).
void leave_out_what_is_not_built(std::vector<StabilityCase>& cases) {
  const auto count = std::erase_if(cases, [](const StabilityCase& subject) {
    const Scene* scene = std::get_if<Scene>(&subject.scene);
    return scene != nullptr && std::any_of(scene->integrators.begin(), scene->integrators.end(),
                                           [](const auto& settings) {
                                             return !description_of(settings.method).is_built();
                                           });
  });
  if (count > 0)
    print_error(fmt::format("this build has no CVODE; left out: {}", counted(count, "case")));
}

}  // namespace

int stability(const RunOptions& options, const std::optional<std::string>& suite) {
  auto cases = io::read_stability_suite(suite ? std::filesystem::path(*suite) : default_suite());
  if (!suite) {
    for (StabilityCase& subject : flow_box_cases()) cases.push_back(std::move(subject));
  }
  leave_out_what_is_not_built(cases);
  return report_study(options, "stability", [&](const ProgressCallback& progress) {
    std::vector<StabilityResult> results;
    std::size_t width = 0;
    for (const StabilityCase& subject : cases) width = std::max(width, subject.name.size());
    for (const StabilityCase& subject : cases) {
      const auto done = static_cast<double>(results.size());
      results.push_back(run_stability_case(subject, [&](const std::string&, double fraction) {
        progress("stability", (done + fraction) / static_cast<double>(cases.size()));
      }));
      if (!options.json && !options.quiet)
        print(io::fitted(io::stability_line(results.back(), width)));
    }
    return io::stability_report(results, report_origin(options.command));
  });
}

}  // namespace hamjet::cli
