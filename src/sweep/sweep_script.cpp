#include <fmt/format.h>

#include <algorithm>

#include "../text/scene_message.hpp"
#include "../text/shell_text.hpp"
#include "sweep_report.hpp"

namespace hamjet::io {
namespace {

/// The variables that both scripts begin with. Others may give another program: the same version
/// must be at its place on every machine.
std::string head(const SweepScriptPaths& paths) {
  return fmt::format(
      "hamjet=${{HAMJET:-{}}}\n"
      "study={}\n"
      "directory={}\n",
      in_shell_quotes(paths.program), in_shell_quotes(paths.study),
      in_shell_quotes(paths.directory));
}

}  // namespace

std::string slurm_script(const SweepStudy& study, const SweepScriptPaths& paths, std::size_t tasks,
                         std::size_t threads) {
  return fmt::format(
      "#!/bin/bash\n"
      "#SBATCH --job-name={}\n"
      "#SBATCH --array=1-{}\n"
      "#SBATCH --cpus-per-task={}\n"
      "# {} items in {} tasks. Add what your cluster wants to know (--time, --partition, --mem).\n"
      "# Submitted again, it computes what is missing; a part of the tasks too: --array=3,7.\n"
      "# Afterwards, or as a job with --dependency=afterany:<job>:\n"
      "#   hamjet sweep --merge -o {}\n"
      "set -euo pipefail\n"
      "{}"
      "exec \"$hamjet\" sweep \"$study\" -o \"$directory\" --shard \"$SLURM_ARRAY_TASK_ID/{}\" \\\n"
      "  --threads {} --resume --quiet\n",
      study.name, tasks, threads, study.items.size(), tasks,
      printable(in_shell_quotes(paths.directory), std::string::npos), head(paths), tasks, threads);
}

std::string parallel_script(const SweepStudy& study, const SweepScriptPaths& paths,
                            std::size_t tasks, std::size_t threads) {
  return fmt::format(
      "#!/bin/bash\n"
      "# {} items in {} tasks by GNU parallel, then the table. Options go to parallel, for "
      "example\n"
      "#   --jobs 4, or --sshloginfile nodes for machines that share this folder.\n"
      "# Run again, it computes what is missing.\n"
      "set -uo pipefail\n"
      "{}"
      "# In the command itself parallel would put the task in place of braces in a path.\n"
      "export hamjet study directory\n"
      "# How the tasks end is in the rows, which --merge counts.\n"
      "seq {} | parallel --env hamjet --env study --env directory --jobs {}% \"$@\" \\\n"
      "  '\"$hamjet\" sweep \"$study\" -o \"$directory\" --shard {{}}/{} --threads {} --resume "
      "--quiet'\n"
      "exec \"$hamjet\" sweep --merge -o \"$directory\"\n",
      study.items.size(), tasks, head(paths), tasks, std::max<std::size_t>(100 / threads, 1), tasks,
      threads);
}

}  // namespace hamjet::io
