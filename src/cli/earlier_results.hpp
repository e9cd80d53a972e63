#pragma once

#include <filesystem>
#include <vector>

namespace hamjet::cli {

/// The files, relative to the directory, that the summary.json of an earlier run in it names: they
/// go when the new results come, or a label that the scene no longer has would keep old numbers
/// beside new ones. Empty if there is no such summary; never names anything that a run does not
/// write.
std::vector<std::filesystem::path> earlier_results(const std::filesystem::path& directory);

}  // namespace hamjet::cli
