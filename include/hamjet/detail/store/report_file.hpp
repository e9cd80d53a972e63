#pragma once

#include <filesystem>
#include <string>

namespace hamjet::io {

/// A file of a report before it is written.
struct ReportFile {
  std::filesystem::path path;  ///< path relative to the output directory
  std::string content;
};

}  // namespace hamjet::io
