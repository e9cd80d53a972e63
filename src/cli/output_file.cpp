#include "output_file.hpp"

#include <fmt/format.h>

#include <system_error>

#include "../io/file_system.hpp"
#include "../io/text_file.hpp"
#include "hamjet/error.hpp"
#include "interruption.hpp"

namespace hamjet::cli {

OutputFile::OutputFile(const std::filesystem::path& file) : file_(file) {
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  // A rename would put a file in the place of a device such as /dev/null.
  if (!file.has_filename() || (exists(status) && !is_regular_file(status))) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: cannot be written: not a regular file", io::printable_path(file)));
  }
  io::require_writable(file.has_parent_path() ? file.parent_path() : ".");
}

void OutputFile::write(const std::string& content) const {
  const RemovedAtSuddenEnd leftovers({io::temporary_beside(file_)});
  const UninterruptedWriting results;
  io::write_whole_file(file_, content);
}

}  // namespace hamjet::cli
