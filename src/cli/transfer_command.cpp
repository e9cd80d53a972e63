#include "transfer_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <system_error>

#include "../app/report_origin.hpp"
#include "../app/stored_chief.hpp"
#include "../report/study_description.hpp"
#include "../text/scene_message.hpp"
#include "../text/scene_refusal.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "hamjet/report/relative_motion_report.hpp"
#include "noted_jet.hpp"
#include "process/standard_streams.hpp"
#include "study_command.hpp"

namespace hamjet::cli {
namespace {

[[noreturn]] void refuse_jet(const StoredJetChoice& jet, const io::StoredJet& stored,
                             const std::string& problem) {
  throw Error(ErrorKind::scene,
              fmt::format("{}: the jet of {} {}", io::printable(*jet.directory, std::string::npos),
                          stored.label, problem));
}

io::StoredJet read_stored_jet(const StoredJetChoice& jet) {
  io::StoredJet stored = read_noted_jet(*jet.directory, jet.run);
  io::require_positions_and_momenta(stored, io::printable(*jet.directory, std::string::npos));
  if (stored.duration == 0) {
    refuse_jet(jet, stored, "has the duration 0, in which nothing can be transferred");
  }
  return stored;
}

/// The scene, which need not say a time where a stored jet has the only one.
Scene read_scene_of(const io::StoredJet& stored, const RunOptions& options) {
  try {
    return read_scene(options);
  } catch (const Error& error) {
    RunOptions with_time = options;
    with_time.overrides.push_back(
        fmt::format("transfer.times_canonical=[{:.17g}]", stored.duration));
    try {
      return read_scene(with_time);
    } catch (const Error&) {
      throw error;  // it was something else
    }
  }
}

/// The stored jet; throws unless it is of the scene's chief and expanded in all of its variables.
EarlierJet earlier_jet(const StoredJetChoice& jet, const io::StoredJet& stored,
                       const Scene& scene) {
  if (!is_about_chief(stored, scene))
    refuse_jet(jet, stored, "is about another orbit than the scene's");
  if (stored.components.size() != scene.nominal.size() ||
      stored.variables.size() != scene.nominal.size()) {
    refuse_jet(jet, stored,
               fmt::format("is not expanded in all {} variables, which transfers need",
                           scene.nominal.size()));
  }
  return {stored.label, duration_in_units_of(scene, stored), jet_in_units_of(scene, stored)};
}

/// Whether a transfer has one time and it is this, but for the rounding of the units.
bool has_time_alone(const TransferSettings& transfer, double time) {
  constexpr double rounding = 1e-14;
  return transfer.times.size() == 1 &&
         std::abs(transfer.times[0] - time) <= rounding * std::abs(time);
}

/// Throws Error(usage) if the results would replace the directory that the stored jet is read from.
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

int transfer_by_stored_jet(const RunOptions& options, const StoredJetChoice& jet) {
  const io::StoredJet stored = read_stored_jet(jet);
  const Scene scene = read_scene_of(stored, options);
  const io::StudyDescription& study = io::study_of_table("transfer");
  // Arcs are not refused: a stored jet may have been composed of them.
  io::require_table(study, scene, *options.scene_file);
  note_escape(options, scene);
  const std::string name = scene.name + study.suffix();
  refuse_to_replace(*jet.directory, output_path(options, name));
  const EarlierJet earlier = earlier_jet(jet, stored, scene);
  if (!options.quiet && !has_time_alone(*scene.transfer, earlier.time)) {
    print_error(
        fmt::format("note: the stored jet has one time, {:.10g} s, and order {}; they take "
                    "the place of the scene's",
                    earlier.time * scene.units.time_s, earlier.jet.at(0).order()));
  }
  return report_study(options, name, [&](const ProgressCallback& progress) {
    return io::flown_transfer_report(
        io::naming_file(*options.scene_file,
                        [&] { return study_transfer(scene, progress, &earlier); }),
        report_origin(options.command));
  });
}

}  // namespace hamjet::cli
