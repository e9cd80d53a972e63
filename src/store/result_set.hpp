#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hamjet::io {

/// Whether a directory has a set of results that are all there: its summary is as it was written,
/// and does not say that a numerical failure left some of them out.
bool has_whole_results(const std::filesystem::path& directory, const std::string& name);

/// A set of results that an OutputDirectory has put in place, for reading. What is read counts only
/// once verify() has found it to be what was written.
class ResultSet {
 public:
  /// Reads the summary. If the process that wrote the set was killed while it put it in place, that
  /// is completed first. Throws Error(input_output) with path and reason, also if another process
  /// is about to do so.
  ResultSet(std::filesystem::path directory, std::string name);

  /// The path of the summary; summary() has its text.
  std::filesystem::path path() const { return directory_ / name_; }
  const std::string& summary() const noexcept { return summary_; }
  /// The text of another file of the set.
  std::string read(const std::string& relative);

  /// Throws Error(input_output), one line with the file, unless the summary and all files that
  /// were read are bit for bit those that were written together.
  void verify() const;

 private:
  struct FileRead {
    std::string path;
    std::string problem;  ///< empty if it agrees with the summary
  };

  std::filesystem::path directory_;
  std::string name_;
  std::string summary_;
  std::vector<FileRead> read_;
};

}  // namespace hamjet::io
