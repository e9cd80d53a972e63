#pragma once

#include <string>

namespace hamjet::io {

/// The stem of the file's name, made fit for the name of a directory.
std::string scene_name(const std::string& file_name);

}  // namespace hamjet::io
