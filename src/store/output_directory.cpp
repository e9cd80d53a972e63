#include "hamjet/store/output_directory.hpp"

#include <stdexcept>
#include <utility>

#include "directory_lock.hpp"
#include "file_system.hpp"
#include "prepared_set.hpp"

namespace hamjet::io {

OutputDirectory::OutputDirectory(std::filesystem::path path)
    : path_(std::move(path)), lock_(std::make_unique<DirectoryLock>(path_)) {
  remove_unfinished(path_);
  if (is_ready(path_)) put_in_place(path_);
}

OutputDirectory::~OutputDirectory() = default;

void OutputDirectory::write(const std::filesystem::path& relative, std::string_view content) {
  if (set_ == nullptr) {
    // If the directory was removed during the computation, it is created again.
    if (!lock_->is_in_place()) lock_ = std::make_unique<DirectoryLock>(path_);
    set_ = std::make_unique<PreparedSet>(path_);
  }
  if (!last_path_.empty() && last_path_ != relative) set_->write(last_path_, last_content_);
  last_path_ = relative;
  last_content_ = content;
}

std::string OutputDirectory::commit() {
  if (last_path_.empty()) throw std::logic_error("a set of results needs a summary");
  std::string summary = set_->commit(std::exchange(last_path_, {}), last_content_);
  set_.reset();
  last_content_.clear();
  return summary;
}

std::vector<std::filesystem::path> OutputDirectory::leftovers() const { return lock_->leftovers(); }

}  // namespace hamjet::io
