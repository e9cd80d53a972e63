#include "transfer_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <system_error>

#include "../io/scene_message.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "hamjet/io/jet_file.hpp"
#include "hamjet/io/relative_motion_report.hpp"
#include "report_origin.hpp"
#include "required_tables.hpp"
#include "standard_streams.hpp"
#include "study_command.hpp"

namespace hamjet::cli {
namespace {

/// Points of the trajectory that is drawn.
constexpr int trajectory_intervals = 400;

/// The stored jet, if it is of the scene's chief.
EarlierJet earlier_jet(const TransferOptions& transfers, const Scene& scene) {
  const io::StoredJet stored = io::read_jet_file(*transfers.directory, transfers.run);
  const auto refuse_jet = [&](const std::string& problem) {
    throw Error(
        ErrorKind::scene,
        fmt::format("{}: the jet of {} {}", io::printable(*transfers.directory, std::string::npos),
                    stored.label, problem));
  };
  const bool is_same_chief =
      stored.model == scene.system.model && stored.units.length_km == scene.units.length_km &&
      stored.units.time_s == scene.units.time_s && stored.nominal_initial == scene.nominal;
  if (!is_same_chief) refuse_jet("is about another orbit than the scene's");
  if (stored.components.size() != scene.nominal.size() ||
      stored.variables.size() != scene.nominal.size()) {
    refuse_jet("is not expanded in all six variables, which transfers need");
  }
  if (stored.duration == 0) refuse_jet("has the duration 0, in which nothing can be transferred");
  return {stored.label, stored.duration, convert_map<double>(stored.jet)};
}

/// The results of a study take the place of what was in their directory.
void refuse_to_replace(const std::filesystem::path& jet, const std::filesystem::path& output) {
  std::error_code none;
  const bool is_file = std::filesystem::is_regular_file(jet, none);
  if (!std::filesystem::equivalent(is_file ? jet.parent_path() : jet, output, none)) return;
  throw Error(ErrorKind::usage,
              fmt::format("--jet and -o: are the same directory, {}, whose jet the results would "
                          "replace; choose another -o",
                          io::printable(output.string(), std::string::npos)));
}

}  // namespace

int transfer(const RunOptions& options, const TransferOptions& transfers) {
  // A stored jet may well have been composed of arcs.
  const Scene scene = transfers.directory && !transfers.directory->empty()
                          ? read_scene(options)
                          : read_unsplit_scene(options, "hamjet transfer");
  require_transfer(scene, *options.scene_file);
  std::optional<EarlierJet> earlier;
  const std::string name = scene.name + "-transfer";
  if (transfers.directory) {
    refuse_to_replace(*transfers.directory, output_path(options, name));
    earlier = earlier_jet(transfers, scene);
    if (!options.quiet && scene.transfer->times != std::vector<double>{earlier->time}) {
      print_error(
          fmt::format("note: the stored jet has one time, {:.10g} s, and order {}; they take "
                      "the place of the scene's",
                      earlier->time * scene.units.time_s, earlier->jet.at(0).order()));
    }
  }
  return report_study(options, name, [&](const ProgressCallback& progress) {
    const TransferResult result = study_of(*options.scene_file, [&] {
      return study_transfer(scene, progress, earlier ? &*earlier : nullptr);
    });
    std::optional<RelativeTrajectory> trajectory;
    if (const auto best = result.best_point()) {
      trajectory = fly_relative(result, *best, trajectory_intervals);
    }
    std::optional<ValidityResult> validity;
    if (scene.validity) validity = study_validity(scene, progress);
    return io::transfer_report(result, trajectory, validity, report_origin(options.command));
  });
}

int validity(const RunOptions& options) {
  const Scene scene = read_unsplit_scene(options, "hamjet validity");
  require_validity(scene, *options.scene_file);
  return report_study(options, scene.name + "-validity", [&](const ProgressCallback& progress) {
    return io::validity_report(
        study_of(*options.scene_file, [&] { return study_validity(scene, progress); }),
        report_origin(options.command));
  });
}

int assign(const RunOptions& options) {
  const Scene scene = read_unsplit_scene(options, "hamjet assign");
  require_assignment(scene, *options.scene_file);
  return report_study(options, scene.name + "-assign", [&](const ProgressCallback& progress) {
    return io::assignment_report(
        study_of(*options.scene_file, [&] { return study_assignment(scene, progress); }));
  });
}

}  // namespace hamjet::cli
