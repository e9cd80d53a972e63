#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "hamjet/detail/studies/progress.hpp"

namespace hamjet::python {

/// What long work is: it reports how far it is, and stops if that throws. It must own all it uses,
/// none of it Python's, for it may outlive the call.
using LongWork = std::function<void(const ProgressCallback&)>;

/// Does the work in a thread of its own while the calling one, without the GIL, waits: a signal
/// (Ctrl-C) is answered at once, however long a step of the work takes. `progress` is None or is
/// called with (task, fraction) from the calling thread, a few times a second. Work that was
/// interrupted ends at its next report; if that takes longer than half a second it is left to
/// itself. Throws what the work, `progress` or a signal's handler throw.
void do_interruptibly(LongWork work, const pybind11::object& progress);

/// do_interruptibly for work with a result.
template <class Work>
auto interruptibly(const pybind11::object& progress, Work work) {
  using Result = decltype(work(ProgressCallback()));
  const auto result = std::make_shared<std::optional<Result>>();
  do_interruptibly([result, work = std::move(work)](
                       const ProgressCallback& report) { result->emplace(work(report)); },
                   progress);
  return std::move(**result);
}

/// For work in short pieces by the calling thread, which does not hold the GIL: a call between two
/// of them throws if a signal has come. Looks a few times a second only.
class SignalCheck {
 public:
  void operator()();

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace hamjet::python
