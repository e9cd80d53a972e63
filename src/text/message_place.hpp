#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace hamjet::io {

/// A message taken apart at the head that `location` and `message_head` of scene_message.hpp give
/// it; what it does not say has no value.
struct PlacedMessage {
  std::optional<std::string> file;
  std::optional<std::size_t> line;
  std::optional<std::size_t> column;
  std::optional<std::string>
      key;              ///< of the scene or of `--set`, dotted; a keyword of another file
  std::string problem;  ///< the rest
};

/// `file` is the scene's name as messages have it; they may be about another file too.
PlacedMessage placed(std::string_view message, std::string_view file);

}  // namespace hamjet::io
