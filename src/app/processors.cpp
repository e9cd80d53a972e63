#include "processors.hpp"

#include <sched.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>
#include <thread>

namespace hamjet::cli {

std::size_t usable_processors() {
  std::size_t count = std::thread::hardware_concurrency();
  cpu_set_t allowed;
  // The call fails on machines with more processors than the set holds.
  if (::sched_getaffinity(0, sizeof allowed, &allowed) == 0) {
    count = static_cast<std::size_t>(CPU_COUNT(&allowed));
  }
  if (const char* text = std::getenv("SLURM_CPUS_PER_TASK")) {
    const std::string_view task = text;
    std::size_t of_task = 0;
    if (std::from_chars(task.data(), task.data() + task.size(), of_task).ec == std::errc()) {
      count = std::min(count, of_task);
    }
  }
  return std::max<std::size_t>(count, 1);
}

}  // namespace hamjet::cli
