#pragma once

#include <filesystem>

namespace hamjet::cli {

/// Makes sure that the one file that the user named can be written, so that a mistake shows before
/// the work. Throws Error(usage) for a file of a set of results, which would no longer be whole,
/// Error(input_output) for what is no regular file, and where none can be written.
void require_replaceable(const std::filesystem::path& file);

}  // namespace hamjet::cli
