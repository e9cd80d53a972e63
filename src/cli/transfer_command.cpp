#include "transfer_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>

#include "../io/scene_message.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "hamjet/io/relative_motion_report.hpp"
#include "hamjet/io/stored_jet.hpp"
#include "report_origin.hpp"
#include "standard_streams.hpp"
#include "study_command.hpp"

namespace hamjet::cli {
namespace {

/// Points of the trajectory that is drawn.
constexpr int trajectory_intervals = 400;

[[noreturn]] void refuse(const RunOptions& options, std::string_view key,
                         const std::string& problem) {
  throw Error(ErrorKind::scene,
              fmt::format("{}: {}: {}", io::printable(*options.scene_file, std::string::npos), key,
                          problem));
}

/// `example` is the smallest such table, in one line that can stand above the scene's first table.
void require_table(const RunOptions& options, bool is_there, std::string_view key,
                   std::string_view example) {
  if (is_there) return;
  refuse(
      options, key,
      fmt::format("missing, must be a table [{}]; the smallest is {} = {{{}}}", key, key, example));
}

/// What a study says of the scene, with the file's name.
template <class Study>
auto study_of(const RunOptions& options, const Study& study) {
  try {
    return study();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::scene) throw;
    throw Error(
        ErrorKind::scene,
        fmt::format("{}: {}", io::printable(*options.scene_file, std::string::npos), error.what()));
  }
}

bool is_zero(const RelativeState& state) {
  return state.position_m.isZero(0) && state.velocity_m_s.isZero(0);
}

/// The stored jet, if it is of the scene's chief.
EarlierJet earlier_jet(const TransferOptions& transfers, const Scene& scene) {
  const io::StoredJet stored = io::read_stored_jet(*transfers.directory, transfers.run);
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
  if (!std::filesystem::equivalent(jet, output, none)) return;
  throw Error(ErrorKind::usage,
              fmt::format("--jet and -o: are the same directory, {}, whose jet the results would "
                          "replace; choose another -o",
                          io::printable(output.string(), std::string::npos)));
}

}  // namespace

int transfer(const RunOptions& options, const TransferOptions& transfers) {
  const Scene scene = read_scene(options);
  require_table(options, scene.transfer.has_value(), "transfer",
                "frame = \"RTN\", times_s = [1200, 1800], start = {position_m = [0, -1000, 0]}, "
                "end = {position_m = [0, -100, 0]}");
  if (scene.assignment && is_zero(scene.transfer->start) && is_zero(scene.transfer->end)) {
    refuse(options, "transfer.start",
           "missing, must be a table with position_m, as must transfer.end; `hamjet assign` works "
           "on this scene's deputies and slots");
  }
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
    const TransferResult result = study_of(
        options, [&] { return study_transfer(scene, progress, earlier ? &*earlier : nullptr); });
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
  const Scene scene = read_scene(options);
  require_table(options, scene.validity.has_value(), "validity", "tolerance_m = 1, count = 12");
  return report_study(options, scene.name + "-validity", [&](const ProgressCallback& progress) {
    return io::validity_report(study_of(options, [&] { return study_validity(scene, progress); }),
                               report_origin(options.command));
  });
}

int assign(const RunOptions& options) {
  const Scene scene = read_scene(options);
  require_table(options, scene.assignment.has_value(), "assignment",
                "deputy = [{position_m = [0, -100, 0]}], slot = [{position_m = [0, 100, 0]}]");
  return report_study(options, scene.name + "-assign", [&](const ProgressCallback& progress) {
    return io::assignment_report(
        study_of(options, [&] { return study_assignment(scene, progress); }));
  });
}

}  // namespace hamjet::cli
