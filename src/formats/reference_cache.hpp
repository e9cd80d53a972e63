#pragma once

#include <filesystem>
#include <string>

#include "hamjet/studies/comparison.hpp"

namespace hamjet::io {

/// References that are kept in a directory, one file for each, named by a hash of its key (SHA-1,
/// as a version 5 UUID). The file also holds the key itself, so that another key with the same hash
/// is not mistaken for it, and a hash of the whole content. A damaged file counts as missing; a
/// file that cannot be written is skipped.
class ReferenceCache : public ReferenceStore {
 public:
  explicit ReferenceCache(std::filesystem::path directory) : directory_(std::move(directory)) {}

  /// $XDG_CACHE_HOME/hamjet/references or ~/.cache/hamjet/references. If neither is known, the path
  /// is empty and nothing is kept.
  static std::filesystem::path user_directory();

  std::optional<ReferenceResult> load(const std::string& key, const SpacePointer& space) override;
  void save(const std::string& key, const ReferenceResult& reference) override;

 private:
  std::filesystem::path file_of(const std::string& key) const;

  std::filesystem::path directory_;
};

}  // namespace hamjet::io
