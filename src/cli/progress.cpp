#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace hamjet::cli {
namespace {

/// Puts the text in place of the line. Best effort: the terminal may have gone.
void show(const std::string& text) {
  std::fputs(fmt::format("\r{:78}\r{}", "", text).c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

Progress::Progress(bool wanted)
    : is_shown_(wanted && ::isatty(STDERR_FILENO) == 1),
      task_start_(Clock::now()),
      last_shown_(task_start_) {}

Progress::~Progress() {
  if (has_line_) show("");
}

void Progress::update(const std::string& task, double fraction) {
  if (!is_shown_) return;
  const auto now = Clock::now();
  if (task != task_) {
    task_ = task;
    task_start_ = now;
  }
  if (now - last_shown_ < std::chrono::milliseconds(100)) return;
  last_shown_ = now;
  const double passed = std::chrono::duration<double>(now - task_start_).count();
  const std::string left =
      fraction > 0 ? fmt::format(", {:.0f} s left", passed * (1 - fraction) / fraction) : "";
  show(fmt::format("{:.40}: {:3.0f} %{}", task, 100 * fraction, left));
  has_line_ = true;
}

}  // namespace hamjet::cli
