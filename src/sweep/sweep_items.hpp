#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hamjet/detail/studies/progress.hpp"
#include "sweep_study.hpp"

namespace hamjet::io {

/// What a column holds: nothing (not computed), a truth value, a number or a text.
using SweepValue = std::variant<std::monostate, bool, double, std::string>;

/// What became of one item.
struct SweepRow {
  std::size_t item = 0;
  int exit_code =
      0;  ///< exit code of the item's command; with 1 (a check failed) there are values too
  std::string error;               ///< one line, if the exit code is not 0
  std::vector<SweepValue> values;  ///< one a column
  /// Not empty: a column leads nowhere in the item's summary; the message names it and its place in
  /// the study. Not stored.
  std::string astray = {};

  bool operator==(const SweepRow&) const = default;
};

/// Computes one item. A failure is recorded in the row, with exit code 3 if a column leads nowhere
/// in the summary; only what `progress` throws is thrown. Items share nothing but the study.
SweepRow run_sweep_item(const SweepStudy& study, std::size_t item,
                        const ProgressCallback& progress = {});

/// Makes sure that the first, middle or last item is a scene that its command can work on: a key
/// that is misspelt shows before anything is computed. Throws Error(scene).
void check_sweep_items(const SweepStudy& study);

/// The folder of a sweep, which many processes on many machines may share: `manifest.json`, and
/// one small file an item, a thousand in a folder. No file has two writers with different content,
/// and each is put in place in one step, so that no locks are needed.
class SweepDirectory {
 public:
  enum class RowState { missing, damaged, foreign, whole };

  /// Writes the manifest, or compares with the one that is there. Throws Error(usage) if that is
  /// another study's, Error(input_output).
  SweepDirectory(std::filesystem::path path, const SweepStudy& study);
  /// The study of a sweep whose folder exists, from its manifest. Throws Error(input_output).
  static SweepStudy study_in(const std::filesystem::path& path);

  const std::filesystem::path& path() const noexcept { return path_; }

  /// Stores a row as the file of its item. Throws Error(input_output).
  void write(const SweepRow& row) const;
  /// The row of an item, checked: of this manifest, with its own checksum. No value if it is not
  /// whole. Throws Error(input_output) if it is there and cannot be read.
  std::optional<SweepRow> read(std::size_t item, RowState* state = nullptr) const;
  /// Removes what processes that were killed have left. To be called only when no other process is
  /// at work.
  void remove_leftovers() const;

 private:
  std::filesystem::path file_of(std::size_t item) const;

  std::filesystem::path path_;
  std::string checksum_;  ///< checksum of the manifest
  std::size_t columns_ = 0;
};

/// How far a sweep is.
struct SweepProgress {
  std::size_t finished = 0;  ///< items, failed ones too
  std::size_t failed = 0;
};

/// Computes items on threads and writes their rows. `watch` is called from the calling thread about
/// ten times a second; if it throws, the items that are being computed are given up, and what it
/// threw goes on, with how far they came in `reached`. Throws Error(input_output) if a row cannot
/// be written, Error(scene) as run_sweep_item does.
SweepProgress run_sweep_items(const SweepStudy& study, const SweepDirectory& directory,
                              const std::vector<std::size_t>& items, std::size_t threads,
                              const std::function<void(const SweepProgress&)>& watch,
                              SweepProgress* reached = nullptr);

}  // namespace hamjet::io
