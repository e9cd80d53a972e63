#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace hamjet::io {

/// A message, and what its head (see `location` and `message_head` of scene_message.hpp) says of
/// the place. What the head does not say has no value.
struct PlacedMessage {
  std::optional<std::string> file;
  std::optional<std::size_t> line;
  std::optional<std::size_t> column;
  /// Dotted key of the scene or of `--set`, or a keyword of another file.
  std::optional<std::string> key;
  std::string problem;  ///< the rest of the message
};

/// Takes a message apart. `file` is the name of the scene as messages write it; a message may also
/// be about another file.
PlacedMessage placed(std::string_view message, std::string_view file);

}  // namespace hamjet::io
