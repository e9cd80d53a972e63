#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The number in a file that holds one number; no value if the file is missing or says "max".
std::optional<double> number_in(const std::filesystem::path& file) {
  std::ifstream stream(file);
  double value = 0;
  if (stream >> value) return value;
  return std::nullopt;
}

/// The number behind a key in a file of lines "key number unit".
std::optional<double> entry_of(const std::filesystem::path& file, const std::string& wanted) {
  std::ifstream stream(file);
  std::string key;
  double value = 0;
  while (stream >> key >> value) {
    if (key == wanted) return value;
    stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return std::nullopt;
}

/// The memory that a control group leaves: its limit minus the memory in use, without pages of
/// files that were read, which are dropped when memory is short.
double free_in_group(const std::filesystem::path& group, const char* limit, const char* usage,
                     const char* droppable) {
  const auto most = number_in(group / limit);
  const auto used = number_in(group / usage);
  if (!most || !used) return unlimited;
  return *most - *used + entry_of(group / "memory.stat", droppable).value_or(0);
}

/// The least memory that the process's control group and the groups above it leave. `root` is where
/// the hierarchy is mounted; inside a container the group's path may not exist there, and the root
/// is then the container's own group.
double free_in_groups(const std::filesystem::path& root, const std::string& group,
                      const char* limit, const char* usage, const char* droppable) {
  double least = free_in_group(root, limit, usage, droppable);
  std::filesystem::path place = root;
  for (const auto& part : std::filesystem::path(group).relative_path()) {
    place /= part;
    least = std::min(least, free_in_group(place, limit, usage, droppable));
  }
  return least;
}

/// Limits of control groups, versions 1 and 2 (Linux, cgroups(7)).
double free_in_control_groups() {
  std::ifstream file("/proc/self/cgroup");
  std::string line;
  double least = unlimited;
  while (std::getline(file, line)) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string group = line.substr(second + 1);
    if (controllers.empty()) {
      least = std::min(least, free_in_groups("/sys/fs/cgroup", group, "memory.max",
                                             "memory.current", "inactive_file"));
    } else if (controllers == "memory") {
      least =
          std::min(least, free_in_groups("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes",
                                         "memory.usage_in_bytes", "total_inactive_file"));
    }
  }
  return least;
}

}  // namespace

double available_memory() {
  double least = free_in_control_groups();
  if (const auto kilobytes = entry_of("/proc/meminfo", "MemAvailable:")) {
    least = std::min(least, 1024 * *kilobytes);
  }
  rlimit address_space{};
  if (getrlimit(RLIMIT_AS, &address_space) == 0 && address_space.rlim_cur != RLIM_INFINITY) {
    least = std::min(least, static_cast<double>(address_space.rlim_cur));
  }
  return std::max(least, 0.0);
}

}  // namespace hamjet
