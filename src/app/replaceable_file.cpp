#include "replaceable_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <system_error>

#include "../store/sealed_summary.hpp"
#include "../store/text_file.hpp"
#include "../store/whole_file.hpp"
#include "hamjet/error.hpp"

namespace hamjet::cli {
namespace {

/// Throws Error(usage) for a file of a set of results, which stands in the folder of the file that
/// describes the set, or one below.
void refuse_results(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto target = std::filesystem::weakly_canonical(file, ignored);
  if (ignored || !exists(target, ignored)) return;
  for (const auto& folder : {target.parent_path(), target.parent_path().parent_path()}) {
    for (const char* name : {"summary.json", "compare.json"}) {
      if (!is_regular_file(folder / name, ignored)) continue;
      const std::string summary =
          io::read_regular_file(folder / name, io::largest_summary_bytes).text;
      if (!io::is_sealed(summary)) continue;
      const auto files = io::sealed_files(summary);
      const bool is_listed =
          std::any_of(files.begin(), files.end(),
                      [&](const io::FileRecord& record) { return folder / record.path == target; });
      if (!is_listed && target != folder / name) continue;
      throw Error(ErrorKind::usage,
                  fmt::format("{}: is a file of results that would be replaced; choose another",
                              io::printable_path(file)));
    }
  }
}

}  // namespace

void require_replaceable(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  // A rename would put a file in the place of a device such as /dev/null.
  if (!file.has_filename() || (exists(status) && !is_regular_file(status))) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: cannot be written: not a regular file", io::printable_path(file)));
  }
  io::refuse_replacing_link(file);
  refuse_results(file);
  io::require_writable(file.has_parent_path() ? file.parent_path() : ".");
}

}  // namespace hamjet::cli
