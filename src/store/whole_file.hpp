#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "file_system.hpp"

namespace hamjet::io {

/// Whether to wait until the disk has what was written.
enum class Flush { no, yes };

/// One file that is written piece by piece and then put in its place whole; before that nothing of
/// it is seen. Until then it has no name, or on file systems without such files a hidden one beside
/// its place that nobody can foretell. Throws Error(input_output) with the path of the place.
class WholeFile {
 public:
  /// Creates the folder. Refuses a symbolic link in the file's place.
  explicit WholeFile(std::filesystem::path path);
  /// Removes what was not put in its place, and the folders that were made for it.
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void write(std::string_view content);
  /// Puts the file in its place, of which it takes what was there.
  void replace(Flush flush);
  /// Puts the file in its place if nothing is there, not even since a moment ago; false if
  /// something is.
  [[nodiscard]] bool put_where_nothing_is();

  /// What a sudden end would leave: a hidden file, then the folders made for it, innermost first.
  std::vector<std::filesystem::path> leftovers() const;

 private:
  /// Gives the finished file its hidden name, and closes it.
  void give_name(Flush flush);

  std::filesystem::path path_;
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> created_;  ///< folders, outermost first
  std::filesystem::path temporary_;
  Descriptor file_;
  bool is_named_ = false;
};

/// Throws for a symbolic link, which a rename would replace, and not what it leads to.
void refuse_replacing_link(const std::filesystem::path& path);

/// Throws if no file can be created in the folder, which need not exist. Leaves nothing behind.
void require_writable(const std::filesystem::path& folder);

/// Writes one file in full, or leaves what was there untouched; its folder is created. Does not
/// wait for the disk: after a power failure the file may be cut or missing, so it must have a seal.
void replace_sealed_file(const std::filesystem::path& path, std::string_view content);

/// Writes one file in full, or leaves what was there untouched, and waits for the disk: after a
/// power failure it is there, whole.
void write_whole_file(const std::filesystem::path& path, std::string_view content);

}  // namespace hamjet::io
