#pragma once

#include <string>

namespace hamjet::io {

/// The file name of a scene that is read from standard input.
inline constexpr const char* standard_input_name = "<standard input>";

/// The name of a scene: the stem of its file's name, made fit for the name of a directory;
/// "standard-input" for the name above.
std::string scene_name(const std::string& file_name);

/// The title of a scene without a title: the printable stem of its file's name.
std::string default_title(const std::string& file_name);

}  // namespace hamjet::io
