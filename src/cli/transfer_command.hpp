#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scene_options.hpp"

// The studies of relative motion. Each writes its results and returns the exit code; Error(scene)
// if the scene has no table for it.

namespace hamjet::cli {

// What stands behind the scene's name in that of the folder of each command's results.
inline constexpr const char* motion_suffix = "-motion";
inline constexpr const char* transfer_suffix = "-transfer";
inline constexpr const char* validity_suffix = "-validity";
inline constexpr const char* assignment_suffix = "-assign";
inline constexpr const char* poincare_suffix = "-poincare";
inline constexpr const char* bounded_suffix = "-bounded";

/// A jet that `hamjet run` has stored, to be used instead of computing.
struct TransferOptions {
  std::optional<std::string> directory;
  std::optional<std::string> run;  ///< label; absent: the first run that has a result
};

/// Velocity changes from one relative position to another, for each transfer time.
int transfer(const RunOptions& options, const TransferOptions& transfers);

/// Where the deputy goes by itself, relative to the chief.
int motion(const RunOptions& options);

/// The word for all coordinates in place of one of them.
inline constexpr std::string_view all_coordinates = "all";

/// How far from the chief each order's polynomial is right, in the scene's coordinates, or in those
/// of a name, or in all.
int validity(const RunOptions& options, const std::optional<std::string>& coordinates);

/// Deputies sent to slots at the least total velocity change.
int assign(const RunOptions& options);

/// The frozen orbit of the chief's energy and angular momentum, and what librates about it.
int poincare(const RunOptions& options);

/// Deputies that stay with the chief for long.
int bounded(const RunOptions& options);

}  // namespace hamjet::cli
