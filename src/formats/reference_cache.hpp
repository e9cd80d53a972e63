#pragma once

#include <filesystem>
#include <string>

#include "hamjet/studies/comparison.hpp"

namespace hamjet::io {

/// References kept in a directory, a file each, named by a hash of its key (SHA-1, as a version 5
/// UUID). The key stands in the file too, so that another key of the same hash finds nothing, and a
/// hash of all its content. A file that is damaged counts as missing; one that cannot be written is
/// not kept.
class ReferenceCache : public ReferenceStore {
 public:
  explicit ReferenceCache(std::filesystem::path directory) : directory_(std::move(directory)) {}

  /// $XDG_CACHE_HOME/hamjet/references, else ~/.cache/hamjet/references; empty where neither is
  /// known: nothing is kept then.
  static std::filesystem::path user_directory();

  std::optional<ReferenceResult> load(const std::string& key, const SpacePointer& space) override;
  void save(const std::string& key, const ReferenceResult& reference) override;

 private:
  std::filesystem::path file_of(const std::string& key) const;

  std::filesystem::path directory_;
};

}  // namespace hamjet::io
