#pragma once

#include <string_view>

namespace hamjet::io {

/// A kind of text about orbits that may be given where another is wanted.
struct KnownText {
  std::string_view name;  ///< with its article, for messages
  /// What becomes of it: "which the key opm_file of [nominal] reads", or why it is not read and
  /// what would be right.
  std::string_view use;
  std::string_view example = {};  ///< "with ..." or "as ...": how a scene names it, where one does
};

/// What a text is, by its beginning: an orbit message in either notation (CCSDS 502.0-B-3,
/// 508.0-B-1), or two-line elements; null for any other.
const KnownText* known_text(std::string_view text);

}  // namespace hamjet::io
