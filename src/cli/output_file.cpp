#include "output_file.hpp"

#include <fmt/format.h>

#include <system_error>

#include "../app/replaceable_file.hpp"
#include "../store/held_signals.hpp"
#include "../store/text_file.hpp"
#include "hamjet/error.hpp"

namespace hamjet::cli {

OutputFile::OutputFile(const std::filesystem::path& file, Existing existing)
    : file_(file), existing_(existing) {
  std::error_code ignored;
  const bool is_there = std::filesystem::symlink_status(file_, ignored).type() !=
                        std::filesystem::file_type::not_found;
  if (existing_ == Existing::kept && is_there) refuse_existing();
  require_replaceable(file);
}

void OutputFile::refuse_existing() const {
  throw Error(ErrorKind::input_output,
              fmt::format("{}: is there already and is not replaced; -o names another file",
                          io::printable_path(file_)));
}

void OutputFile::add(std::string_view content) {
  if (!written_) {
    const io::HeldSignals held;
    written_.emplace(file_);
    leftovers_.watch(written_->leftovers());
  }
  written_->write(content);
}

void OutputFile::put_in_place() {
  const UninterruptedWriting results;
  if (existing_ == Existing::replaced) {
    written_->replace(io::Flush::yes);
  } else if (!written_->put_where_nothing_is()) {
    refuse_existing();
  }
}

}  // namespace hamjet::cli
