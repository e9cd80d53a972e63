#include "scene_refusal.hpp"

#include <fmt/format.h>

#include "../text/scene_message.hpp"

namespace hamjet::cli {

void refuse_scene(const std::string& file, const std::string& key, const std::string& problem) {
  throw Error(ErrorKind::scene,
              fmt::format("{}: {}: {}", io::printable(file, std::string::npos), key, problem));
}

void rethrow_with_file(const Error& error, const std::string& file) {
  if (error.kind() != ErrorKind::scene) throw error;
  throw Error(ErrorKind::scene,
              fmt::format("{}: {}", io::printable(file, std::string::npos), error.what()));
}

}  // namespace hamjet::cli
