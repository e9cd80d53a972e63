#include "spooled_text.hpp"

#include <unistd.h>

#include <cerrno>

namespace hamjet::io {

void SpooledText::add(std::string_view text) {
  memory_ += text;
  if (memory_.size() > most_in_memory) store();
}

void SpooledText::store() {
  if (!file_.is_open()) file_ = unnamed_temporary_file(folder_);
  write_all(file_, memory_, folder_);
  memory_.clear();
}

void SpooledText::hand_out(const std::function<void(const std::string&)>& take) {
  if (!file_.is_open()) return take(memory_);
  store();
  std::string piece(std::size_t{1} << 20, '\0');
  for (off_t offset = 0;;) {
    const ssize_t count = ::pread(file_.value(), piece.data(), piece.size(), offset);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw_file_error(folder_, "a temporary file cannot be read", errno_text());
    if (count == 0) return;
    offset += count;
    take(piece.substr(0, static_cast<std::size_t>(count)));
  }
}

}  // namespace hamjet::io
