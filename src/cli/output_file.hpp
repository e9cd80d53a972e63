#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "../store/whole_file.hpp"
#include "process/interruption.hpp"

namespace hamjet::cli {

/// What happens to a file of the same name that exists already.
enum class Existing { replaced, kept };

/// The one file that the user named, written in full or not at all. Errors are
/// Error(input_output), unless said otherwise.
class OutputFile {
 public:
  /// Makes sure that the file can be written, so that a mistake shows before the work. Throws
  /// Error(usage) for a file of a set of results, which would no longer be whole.
  explicit OutputFile(const std::filesystem::path& file, Existing existing = Existing::replaced);

  /// Adds to the file, which is not seen yet.
  void add(std::string_view content);
  /// Puts what was added in its place, which is the end of the work.
  void put_in_place();

 private:
  [[noreturn]] void refuse_existing() const;

  std::filesystem::path file_;
  Existing existing_;
  RemovedAtSuddenEnd leftovers_;  ///< outlives the file, which removes the same at its end
  std::optional<io::WholeFile> written_;
};

}  // namespace hamjet::cli
