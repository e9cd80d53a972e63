#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace hamjet::cli {

/// One line on standard error that shows what is being done, how far it is and the time left; only
/// when standard error is a terminal. The line is removed at the end.
class Progress {
 public:
  explicit Progress(bool wanted);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(const std::string& task, double fraction);

 private:
  using Clock = std::chrono::steady_clock;

  bool is_shown_;
  std::string task_;
  Clock::time_point task_start_;
  Clock::time_point last_shown_;
  bool has_line_ = false;
};

}  // namespace hamjet::cli
