#pragma once

#include <exception>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace hamjet::cli {

/// Thrown out of the work after one of io::ending_signals.
class Interrupted : public std::exception {
 public:
  explicit Interrupted(int signal) : signal_(signal) {}
  const char* what() const noexcept override { return "interrupted"; }
  /// The exit code, 128 + the signal: 129, 130, 131 or 143.
  int exit_code() const noexcept { return 128 + signal_; }

 private:
  int signal_;
};

/// Catches io::ending_signals from now on: the first asks the work to stop. If it has not done so
/// within a second, for a single step of high order may take longer, or at a second signal, the
/// program ends at once. SIGHUP and SIGQUIT stay ignored where they are. SIGPIPE and SIGXFSZ become
/// errors of the write.
void catch_signals();

/// Notes that from now on a sudden end leaves a finished part of the results.
void note_finished_part();

/// Prints the one line that an interrupted program ends with, after which no signal adds another,
/// and returns the exit code.
[[nodiscard]] int end_interrupted(const Interrupted& interrupted, const std::string& message);

/// The message where memory runs out.
inline constexpr const char* out_of_memory =
    "out of memory; a lower order or fewer variables would fit";

/// For std::set_terminate: ends the program as main() does where memory runs out, for then an
/// exception can come out of a destructor too (of nlohmann's JSON values, which allocate there).
[[noreturn]] void end_after_unhandled_exception() noexcept;

/// Throws Interrupted if a signal has come.
void stop_if_interrupted();

/// While it lives, a signal that ends the program at once removes these paths first: files, and
/// folders as far as they are empty, in this order.
class RemovedAtSuddenEnd {
 public:
  RemovedAtSuddenEnd() = default;
  explicit RemovedAtSuddenEnd(std::vector<std::filesystem::path> paths) { watch(std::move(paths)); }
  void watch(std::vector<std::filesystem::path> paths);
  ~RemovedAtSuddenEnd();
  RemovedAtSuddenEnd(const RemovedAtSuddenEnd&) = delete;
  RemovedAtSuddenEnd& operator=(const RemovedAtSuddenEnd&) = delete;

 private:
  std::vector<std::filesystem::path> paths_;
  std::vector<const char*> names_;
};

/// The kind of writing that is under way.
enum class Writing {
  results,         ///< the end of the work: afterwards a signal ends the program at once
  checkpoint,      ///< the work goes on
  partial_results  ///< a signal has come, and what is finished is kept
};

/// While it lives something is being written, which takes a moment and is not broken off, unless
/// the disk takes longer than the second or a second signal comes. Throws Interrupted at the start
/// if a signal has come, unless partial results are written.
class UninterruptedWriting {
 public:
  explicit UninterruptedWriting(Writing what = Writing::results);
  ~UninterruptedWriting();
  UninterruptedWriting(const UninterruptedWriting&) = delete;
  UninterruptedWriting& operator=(const UninterruptedWriting&) = delete;

 private:
  Writing what_;
};

}  // namespace hamjet::cli
