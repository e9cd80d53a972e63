#pragma once

#include <string_view>

namespace hamjet::io {

/// A kind of text about orbits that a user may give by mistake where another is wanted.
struct KnownText {
  std::string_view name;  ///< name of the kind with its article, for messages
  /// How the kind is used, as in "which the key opm_file of [nominal] reads", or why it is not read
  /// and what to give instead.
  std::string_view use;
  std::string_view example = {};  ///< how a scene names it, as "with ..." or "as ...", if it does
};

/// The kind of a text, judged by its beginning: an orbit message in either notation (CCSDS
/// 502.0-B-3, 508.0-B-1), or two-line elements; null for any other text.
const KnownText* known_text(std::string_view text);

}  // namespace hamjet::io
