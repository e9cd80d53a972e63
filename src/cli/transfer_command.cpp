#include "transfer_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <system_error>

#include "../app/report_origin.hpp"
#include "../app/required_tables.hpp"
#include "../app/stored_chief.hpp"
#include "../report/bounded/bounded_report.hpp"
#include "../report/bounded/event_report.hpp"
#include "../report/bounded/frozen_orbit_report.hpp"
#include "../report/formation/deputy_motion_report.hpp"
#include "../studies/bounded/bounded_formation.hpp"
#include "../studies/bounded/frozen_orbit_study.hpp"
#include "../studies/formation/deputy_motion.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "hamjet/report/relative_motion_report.hpp"
#include "noted_jet.hpp"
#include "process/standard_streams.hpp"
#include "study_command.hpp"

namespace hamjet::cli {
namespace {

[[noreturn]] void refuse_jet(const TransferOptions& transfers, const io::StoredJet& stored,
                             const std::string& problem) {
  throw Error(ErrorKind::scene, fmt::format("{}: the jet of {} {}",
                                            io::printable(*transfers.directory, std::string::npos),
                                            stored.label, problem));
}

io::StoredJet read_stored_jet(const TransferOptions& transfers) {
  io::StoredJet stored = read_noted_jet(*transfers.directory, transfers.run);
  io::require_positions_and_momenta(stored, io::printable(*transfers.directory, std::string::npos));
  if (stored.duration == 0) {
    refuse_jet(transfers, stored, "has the duration 0, in which nothing can be transferred");
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

/// The stored jet; throws unless it is of the scene's chief and expanded in all six variables.
EarlierJet earlier_jet(const TransferOptions& transfers, const io::StoredJet& stored,
                       const Scene& scene) {
  if (!is_about_chief(stored, scene))
    refuse_jet(transfers, stored, "is about another orbit than the scene's");
  if (stored.components.size() != scene.nominal.size() ||
      stored.variables.size() != scene.nominal.size()) {
    refuse_jet(transfers, stored, "is not expanded in all six variables, which transfers need");
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

int transfer(const RunOptions& options, const TransferOptions& transfers) {
  std::optional<io::StoredJet> stored;
  if (transfers.directory) stored = read_stored_jet(transfers);
  // A stored jet may well have been composed of arcs.
  const Scene scene =
      stored ? read_scene_of(*stored, options) : read_unsplit_scene(options, "hamjet transfer");
  require_transfer(scene, *options.scene_file);
  note_escape(options, scene);
  std::optional<EarlierJet> earlier;
  const std::string name = scene.name + transfer_suffix;
  if (stored) {
    refuse_to_replace(*transfers.directory, output_path(options, name));
    earlier = earlier_jet(transfers, *stored, scene);
    if (!options.quiet && !has_time_alone(*scene.transfer, earlier->time)) {
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
    if (const auto best = result.best_point()) trajectory = fly_relative(result, *best);
    std::optional<ValidityResult> validity;
    if (scene.validity) validity = study_validity(scene, progress);
    return io::transfer_report(result, trajectory, validity, report_origin(options.command));
  });
}

int motion(const RunOptions& options) {
  const Scene scene = read_unsplit_scene(options, "hamjet motion");
  require_deputy(scene, *options.scene_file);
  note_escape(options, scene);
  return report_study(options, scene.name + motion_suffix, [&](const ProgressCallback& progress) {
    return io::deputy_motion_report(
        study_of(*options.scene_file, [&] { return study_deputy_motion(scene, progress); }),
        report_origin(options.command));
  });
}

int validity(const RunOptions& given, const std::optional<std::string>& coordinates) {
  const bool is_of_all = coordinates == all_coordinates;
  RunOptions options = given;
  if (coordinates && !is_of_all) {
    options.overrides.push_back(fmt::format("jet.coordinates=\"{}\"", *coordinates));
    options.overrides.emplace_back("jet.end_coordinates=null");
  }
  const Scene scene = read_unsplit_scene(options, "hamjet validity");
  require_validity(scene, *options.scene_file);
  return report_study(options, scene.name + validity_suffix, [&](const ProgressCallback& progress) {
    if (is_of_all) {
      return io::coordinates_report(
          study_of(*options.scene_file, [&] { return study_validity_in_all(scene, progress); }),
          report_origin(options.command));
    }
    return io::validity_report(
        study_of(*options.scene_file, [&] { return study_validity(scene, progress); }),
        report_origin(options.command));
  });
}

int assign(const RunOptions& options) {
  const Scene scene = read_unsplit_scene(options, "hamjet assign");
  require_assignment(scene, *options.scene_file);
  note_escape(options, scene);
  return report_study(
      options, scene.name + assignment_suffix, [&](const ProgressCallback& progress) {
        return io::assignment_report(
            study_of(*options.scene_file, [&] { return study_assignment(scene, progress); }));
      });
}

int poincare(const RunOptions& options) {
  const Scene scene = read_unsplit_scene(options, "hamjet poincare");
  return report_study(options, scene.name + poincare_suffix, [&](const ProgressCallback& progress) {
    if (scene.event) {
      return io::event_report(
          study_of(*options.scene_file, [&] { return study_event(scene, progress); }),
          report_origin(options.command));
    }
    return io::frozen_orbit_report(
        study_of(*options.scene_file, [&] { return study_frozen_orbit(scene, progress); }),
        report_origin(options.command));
  });
}

int bounded(const RunOptions& options) {
  const Scene scene = read_unsplit_scene(options, "hamjet bounded");
  require_bounded(scene, *options.scene_file);
  return report_study(options, scene.name + bounded_suffix, [&](const ProgressCallback& progress) {
    return io::bounded_report(
        study_of(*options.scene_file, [&] { return study_bounded(scene, progress); }),
        report_origin(options.command));
  });
}

}  // namespace hamjet::cli
