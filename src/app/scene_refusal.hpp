#pragma once

#include <string>

#include "hamjet/error.hpp"

namespace hamjet::cli {

/// Throws Error(scene) as `file: key: problem`.
[[noreturn]] void refuse_scene(const std::string& file, const std::string& key,
                               const std::string& problem);

/// An Error(scene) that comes from a study gets the file's name before it.
[[noreturn]] void rethrow_with_file(const Error& error, const std::string& file);

/// Runs a study; its Error(scene) gets the file's name before it.
template <class Study>
auto study_of(const std::string& file, const Study& study) {
  try {
    return study();
  } catch (const Error& error) {
    rethrow_with_file(error, file);
  }
}

}  // namespace hamjet::cli
