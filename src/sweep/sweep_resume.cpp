#include "sweep_resume.hpp"

#include "hamjet/error.hpp"

namespace hamjet::io {

SweepResume resume_sweep(const std::vector<std::size_t>& items, const SweepDirectory& directory,
                         const std::function<void()>& look) {
  SweepResume result;
  for (const std::size_t item : items) {
    const auto row = directory.read(item);
    const auto has_ended_with = [&](ErrorKind kind) {
      return row->exit_code == static_cast<int>(kind);
    };
    if (!row || has_ended_with(ErrorKind::too_large) || has_ended_with(ErrorKind::input_output)) {
      result.remaining.push_back(item);
    } else if (row->exit_code != 0) {
      ++result.failed;
    }
    look();
  }
  return result;
}

}  // namespace hamjet::io
