#pragma once

#include <optional>
#include <string>

#include "scene_options.hpp"

namespace hamjet::cli {

/// A jet that `hamjet run` has stored.
struct StoredJetChoice {
  std::optional<std::string> directory;
  std::optional<std::string> run;  ///< label; absent: the first run that has a result
};

/// Transfers by a stored jet, whose directory the choice names, instead of a computed one; writes
/// the results and returns the exit code.
int transfer_by_stored_jet(const RunOptions& options, const StoredJetChoice& jet);

}  // namespace hamjet::cli
