#pragma once

#include <string>

#include "hamjet/error.hpp"
#include "hamjet/studies/scene.hpp"

// What the studies of relative motion need of a scene. `file` is its name, for messages.

namespace hamjet::cli {

/// Throws Error(scene) with file and key.
[[noreturn]] void refuse_scene(const std::string& file, const std::string& key,
                               const std::string& problem);

/// Each throws Error(scene) if the scene has not the tables that the command of this name works on;
/// the message shows the smallest such table.
void require_transfer(const Scene& scene, const std::string& file);
void require_deputy(const Scene& scene, const std::string& file);
void require_validity(const Scene& scene, const std::string& file);
void require_uncertainty(const Scene& scene, const std::string& file);
void require_bounded(const Scene& scene, const std::string& file);
void require_event(const Scene& scene, const std::string& file);
void require_assignment(const Scene& scene, const std::string& file);

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
