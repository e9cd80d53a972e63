#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hamjet::io {

/// Whether a directory has a complete set of results: its summary is as it was written, and does
/// not say that a numerical failure left some results out.
bool has_whole_results(const std::filesystem::path& directory, const std::string& name);

/// A set of results that an OutputDirectory has put in place, for reading. Its content may be used
/// only once verify() has confirmed that it is as it was written.
class ResultSet {
 public:
  /// Reads the summary. If the process that wrote the set was killed while putting it in place,
  /// that work is completed first. Throws Error(input_output) with path and reason, also if another
  /// process is about to do this work.
  ResultSet(std::filesystem::path directory, std::string name);

  /// The path of the summary; summary() has its text.
  std::filesystem::path path() const { return directory_ / name_; }
  const std::string& summary() const noexcept { return summary_; }
  /// The text of another file of the set.
  std::string read(const std::string& relative);

  /// Throws Error(input_output), with a line that names the file, unless the summary and all files
  /// that were read are bit for bit as they were written together.
  void verify() const;

 private:
  struct FileRead {
    std::string path;
    std::string problem;  ///< empty if the file agrees with the summary
  };

  std::filesystem::path directory_;
  std::string name_;
  std::string summary_;
  std::vector<FileRead> read_;
};

}  // namespace hamjet::io
