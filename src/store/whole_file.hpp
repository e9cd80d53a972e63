#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "file_system.hpp"

namespace hamjet::io {

/// Whether to wait until the content is on the disk.
enum class Flush { no, yes };

/// One file that is written piece by piece and only then put in its place, complete. Until then it
/// has no name; on file systems without nameless files it has a hidden, unpredictable one beside
/// its place. Throws Error(input_output) with the path of the place.
class WholeFile {
 public:
  /// Creates the file's folder. Refuses a symbolic link in the file's place.
  explicit WholeFile(std::filesystem::path path);
  /// Removes a file that was not put in its place, and the folders that were made for it.
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void write(std::string_view content);
  /// Puts the file in its place and replaces what was there.
  void replace(Flush flush);
  /// Puts the file in its place only if nothing is there, without a race; returns false if
  /// something is.
  [[nodiscard]] bool put_where_nothing_is();

  /// What a sudden end of the process would leave: a hidden file, then the folders made for it,
  /// innermost first.
  std::vector<std::filesystem::path> leftovers() const;

 private:
  /// Gives the finished file its hidden name, and closes it.
  void give_name(Flush flush);

  std::filesystem::path path_;
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> created_;  ///< folders that were created, outermost first
  std::filesystem::path temporary_;
  Descriptor file_;
  bool is_named_ = false;
};

/// Throws for a symbolic link: a rename would replace the link itself, not the file to which it
/// leads.
void refuse_replacing_link(const std::filesystem::path& path);

/// Throws if no file can be created in the folder, which need not exist. It leaves nothing behind.
void require_writable(const std::filesystem::path& folder);

/// Writes one file completely, or leaves what was there untouched; its folder is created. It does
/// not wait for the disk: after a power failure the file may be cut or missing, so that the file
/// must have a seal.
void replace_sealed_file(const std::filesystem::path& path, std::string_view content);

/// Writes one file completely, or leaves what was there untouched, and waits for the disk: after a
/// power failure the file is there and complete.
void write_whole_file(const std::filesystem::path& path, std::string_view content);

}  // namespace hamjet::io
