#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "file_system.hpp"

namespace hamjet::io {

/// A text of any length that is kept until it is complete: the first megabytes in memory, a longer
/// text in a file without a name in TMPDIR, or /tmp. Throws Error(input_output) where there is no
/// room.
class SpooledText {
 public:
  /// The number of bytes that are kept in memory.
  static constexpr std::size_t most_in_memory = std::size_t{4} << 20;

  void add(std::string_view text);
  /// Hands out the whole text, piece by piece.
  void hand_out(const std::function<void(const std::string&)>& take);

 private:
  /// Moves the content of the memory to the file.
  void store();

  std::string memory_;
  Descriptor file_;
  std::filesystem::path folder_;
};

}  // namespace hamjet::io
