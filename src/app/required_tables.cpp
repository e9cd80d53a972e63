#include "required_tables.hpp"

#include <fmt/format.h>

#include <string_view>

#include "../text/scene_message.hpp"

namespace hamjet::cli {
namespace {

/// `example` is the smallest such table, in one line that can stand above the scene's first table.
void require_table(const std::string& file, bool is_there, std::string_view key,
                   std::string_view example) {
  if (is_there) return;
  refuse_scene(
      file, std::string(key),
      fmt::format("missing, must be a table [{}]; the smallest is {} = {{{}}}", key, key, example));
}

bool is_zero(const RelativeState& state) {
  return state.position_m.isZero(0) && state.velocity_m_s.isZero(0);
}

}  // namespace

void refuse_scene(const std::string& file, const std::string& key, const std::string& problem) {
  throw Error(ErrorKind::scene,
              fmt::format("{}: {}: {}", io::printable(file, std::string::npos), key, problem));
}

void require_transfer(const Scene& scene, const std::string& file) {
  require_table(file, scene.transfer.has_value(), "transfer",
                "times_s = [1200, 1800], start = {position_m = [0, -1000, 0]}, "
                "end = {position_m = [0, -100, 0]}");
  const bool has_end = !scene.transfer->end.is_along_axes() || !is_zero(scene.transfer->end);
  if (scene.assignment && is_zero(scene.transfer->start) && !has_end) {
    refuse_scene(
        file, "transfer.start",
        "missing, must be a table with position_m, as must transfer.end; `hamjet assign` works "
        "on this scene's deputies and slots");
  }
}

void require_deputy(const Scene& scene, const std::string& file) {
  require_table(file, scene.deputy.has_value(), "deputy", "position_m = [0, -1000, 0]");
}

void require_validity(const Scene& scene, const std::string& file) {
  require_table(file, scene.validity.has_value(), "validity", "tolerance_m = 1, count = 12");
}

void require_uncertainty(const Scene& scene, const std::string& file) {
  require_table(file, scene.uncertainty.has_value(), "uncertainty",
                "position_m = [100, 100, 100], velocity_m_s = [0.1, 0.1, 0.1]");
}

void require_event(const Scene& scene, const std::string& file) {
  require_table(file, scene.event.has_value(), "event", "surface = \"equator\"");
}

void require_bounded(const Scene& scene, const std::string& file) {
  require_table(file, scene.bounded.has_value(), "bounded", "sizes_km = [1, 10]");
}

void require_assignment(const Scene& scene, const std::string& file) {
  require_table(file, scene.assignment.has_value(), "assignment",
                "deputy = [{position_m = [0, -100, 0]}], slot = [{position_m = [0, 100, 0]}]");
}

void rethrow_with_file(const Error& error, const std::string& file) {
  if (error.kind() != ErrorKind::scene) throw error;
  throw Error(ErrorKind::scene,
              fmt::format("{}: {}", io::printable(file, std::string::npos), error.what()));
}

}  // namespace hamjet::cli
