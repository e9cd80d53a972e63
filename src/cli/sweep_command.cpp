#include "sweep_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "../app/processors.hpp"
#include "../app/refusal.hpp"
#include "../store/text_file.hpp"
#include "../sweep/sweep_report.hpp"
#include "../sweep/sweep_resume.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "process/interruption.hpp"
#include "process/standard_streams.hpp"
#include "progress.hpp"
#include "study_command.hpp"
#include "sweep_shard.hpp"

namespace hamjet::cli {
namespace {

namespace fs = std::filesystem;

constexpr long most_threads = 4096;

void check_options(const RunOptions& run, const SweepOptions& options) {
  for (const auto* value : {&options.study, &run.output}) {
    if (*value && (*value)->empty()) refuse("sweep: an empty name, must name a file or directory");
  }
  if (options.study == "-") {
    refuse("study: got -, but the parts of a sweep read it again, must be a file");
  }
  if (!options.study && !(options.merge && run.output)) {
    refuse(options.merge ? "sweep --merge: needs the study, or the directory with -o"
                         : "sweep: needs a study (TOML); see hamjet sweep --help");
  }
  if (options.merge && (options.shard || options.resume || options.threads)) {
    refuse(
        "sweep --merge: makes the table of the finished items; leave out --shard, --resume "
        "and --threads");
  }
  if (run.json && options.shard) {
    refuse("sweep --json: prints the summary of the table; leave out --shard");
  }
  const auto check_range = [](const char* name, const std::optional<long>& value, long most) {
    if (value && (*value < 1 || *value > most)) {
      refuse(fmt::format("{}: out of range, got {}, must be an integer from 1 to {}", name, *value,
                         most));
    }
  };
  check_range("--threads", options.threads, most_threads);
}

/// Writes table, map and summary of the rows that are there.
int merge(const RunOptions& run, const io::SweepStudy& study, const io::SweepDirectory& directory) {
  const auto work = [&](const ProgressCallback& progress) {
    progress("reading the rows", 0);
    io::SweepRows rows = io::read_sweep_rows(study, directory);
    const bool is_complete = std::all_of(rows.rows.begin(), rows.rows.end(),
                                         [](const auto& row) { return row.has_value(); });
    if (is_complete) directory.remove_leftovers();
    progress("drawing the map", 0);
    return io::sweep_report(study, rows);
  };
  try {
    return report_study(run, study.name, work);
  } catch (const Interrupted& interrupted) {
    return end_interrupted(
        interrupted, "interrupted; there is no new table; the rows stay, and --merge makes it");
  }
}

std::size_t threads_of(const SweepOptions& options) {
  if (options.threads) return static_cast<std::size_t>(*options.threads);
  return usable_processors();
}

int run_items(const RunOptions& run, const SweepOptions& options, const io::SweepStudy& study) {
  std::optional<Shard> shard;
  if (options.shard) {
    shard = parse_shard(*options.shard);
  } else {
    shard = slurm_shard([](const char* name) { return std::getenv(name); });
  }
  if (run.json && shard) {
    refuse(
        "sweep --json: prints the summary of the table, but a task of a Slurm array makes no "
        "table");
  }
  const fs::path path = output_path(run, study.name);
  const io::SweepDirectory directory(path, study);
  const std::vector<std::size_t> items = shard.value_or(Shard{}).items(study.items.size());
  io::SweepProgress total;
  std::vector<std::size_t> remaining = items;
  if (options.resume) {
    io::SweepResume resume = io::resume_sweep(items, directory, stop_if_interrupted);
    remaining = std::move(resume.remaining);
    total.failed = resume.failed;
  }
  const std::size_t earlier = items.size() - remaining.size();
  io::SweepProgress now;
  try {
    Progress progress(!run.quiet);
    now = io::run_sweep_items(
        study, directory, remaining, threads_of(options),
        [&](const io::SweepProgress& so_far) {
          if (so_far.finished > 0) note_finished_part();
          stop_if_interrupted();
          progress.update(fmt::format("{} items", items.size()),
                          static_cast<double>(so_far.finished) /
                              static_cast<double>(std::max<std::size_t>(remaining.size(), 1)));
        },
        &now);
  } catch (const Interrupted& interrupted) {
    return end_interrupted(
        interrupted,
        fmt::format("interrupted; {} of {} items are finished and stay in {}; --resume goes on",
                    earlier + now.finished, items.size(),
                    io::printable(path.string(), std::string::npos)));
  }
  total.finished = items.size();
  total.failed += now.failed;
  if (!shard) return merge(run, study, directory);
  if (!run.quiet && !run.json) {
    print(
        fmt::format("{}\n  shard {}/{}: {} of {} items: {} computed now, {} before, {} failed\n"
                    "rows: {}\n",
                    study.title, shard->part, shard->parts, items.size(), study.items.size(),
                    now.finished, earlier, total.failed, io::printable_path(path)));
  }
  if (total.failed > 0) {
    print_error(
        fmt::format("{} of {} items failed; their rows say why", total.failed, items.size()));
  }
  return total.failed > 0 ? static_cast<int>(ErrorKind::check_failed) : 0;
}

}  // namespace

int sweep(const RunOptions& run, const SweepOptions& options) {
  check_options(run, options);
  if (!options.study) {
    const fs::path path = *run.output;
    const io::SweepStudy study = io::SweepDirectory::study_in(path);
    return merge(run, study, io::SweepDirectory(path, study));
  }
  const io::SweepStudy study = io::read_sweep_study(*options.study);
  if (options.merge) {
    const fs::path path = output_path(run, study.name);
    io::SweepDirectory::study_in(path);  // throws if there is no sweep: a merge begins none
    return merge(run, study, io::SweepDirectory(path, study));
  }
  io::check_sweep_items(study);
  return run_items(run, options, study);
}

}  // namespace hamjet::cli
