#pragma once

#include <string>

#include "hamjet/error.hpp"

namespace hamjet::io {

/// Throws Error(scene) as `file: key: problem`.
[[noreturn]] void refuse_scene(const std::string& file, const std::string& key,
                               const std::string& problem);

/// An Error(scene) that comes from some work gets the file's name before it.
[[noreturn]] void rethrow_with_file(const Error& error, const std::string& file);

/// Does some work of a scene; its Error(scene) gets the file's name before it.
template <class Work>
auto naming_file(const std::string& file, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    rethrow_with_file(error, file);
  }
}

}  // namespace hamjet::io
