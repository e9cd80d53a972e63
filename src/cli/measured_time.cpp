#include "measured_time.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "../app/processors.hpp"
#include "../report/study_description.hpp"
#include "../studies/flights/manoeuvred_flight.hpp"
#include "../text/quantity_text.hpp"
#include "../text/time_axis.hpp"
#include "hamjet/error.hpp"
#include "hamjet/studies/propagation.hpp"
#include "process/interruption.hpp"

namespace hamjet::cli {
namespace {

/// Seconds that a study may take before it is ended.
constexpr double longest = 1;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct TimedStudy {
  std::string_view command;
  std::function<void(const ProgressCallback&)> run;
};

/// The commands that a scene has what they need for.
std::vector<TimedStudy> timed_studies(const Scene& scene) {
  std::vector<TimedStudy> studies;
  if (!has_manoeuvres(scene)) {
    studies.push_back({"run", [&](const auto& progress) { propagate(scene, progress, 1); }});
  }
  for (const io::StudyDescription* study : io::studies_of(scene)) {
    studies.push_back({study->command, [&scene, study](const auto& progress) {
                         io::StudyWork work{progress, {}, usable_processors()};
                         work.origin.gnuplot = "";
                         study->study(scene, work).report();
                       }});
  }
  return studies;
}

/// What the process of a study tells of its progress: seconds that its task has taken, and how much
/// of it they have done.
struct Told {
  double seconds = 0;
  double fraction = 0;
};

/// Runs the study to its end; never returns.
[[noreturn]] void run_apart(const TimedStudy& study, int out) {
  std::string task;
  Clock::time_point start = Clock::now();
  try {
    study.run([&](const std::string& of, double fraction) {
      if (of != task) start = Clock::now();
      task = of;
      const Told told{seconds_since(start), fraction};
      if (::write(out, &told, sizeof told) < 0) ::_exit(0);
    });
  } catch (...) {
    ::_exit(static_cast<int>(ErrorKind::numerical));
  }
  ::_exit(0);
}

/// The process of a study, which does not outlive this.
class StudyProcess {
 public:
  explicit StudyProcess(const TimedStudy& study) {
    int ends[2];
    if (::pipe(ends) != 0) return;
    process_ = ::fork();
    if (process_ == 0) {
      ::close(ends[0]);
      run_apart(study, ends[1]);
    }
    ::close(ends[1]);
    in_ = ends[0];
  }
  ~StudyProcess() {
    if (in_ >= 0) ::close(in_);
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  StudyProcess(const StudyProcess&) = delete;
  StudyProcess& operator=(const StudyProcess&) = delete;

  std::string time() {
    if (process_ <= 0) return "not measured";
    const Clock::time_point start = Clock::now();
    Told told;
    for (double left = longest; left > 0; left = longest - seconds_since(start)) {
      stop_if_interrupted();
      pollfd waiting{in_, POLLIN, 0};
      if (::poll(&waiting, 1, static_cast<int>(left * 1000) + 1) <= 0) continue;
      if (::read(in_, &told, sizeof told) != sizeof told) return ended(seconds_since(start));
    }
    // A task of which less is done says nothing of the rest.
    constexpr double enough = 0.01;
    const double rest = told.fraction > enough && told.fraction < 1
                            ? told.seconds * (1 - told.fraction) / told.fraction
                            : 0;
    return "at least " + text_of(longest + rest);
  }

 private:
  std::string ended(double seconds) {
    int status = 0;
    const pid_t process = std::exchange(process_, 0);
    ::waitpid(process, &status, 0);
    const bool is_good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    return is_good ? text_of(seconds) : "fails";
  }

  /// In one digit, which is all that a measurement on a busy machine says.
  static std::string text_of(double seconds) {
    const io::TimeAxis axis = io::time_axis(seconds);
    const double rounded = std::stod(fmt::format("{:.0e}", seconds / axis.seconds));
    return axis.seconds == 1 ? duration_text(rounded) : fmt::format("{:g} {}", rounded, axis.name);
  }

  pid_t process_ = -1;
  int in_ = -1;
};

}  // namespace

std::string measured_times(const Scene& scene) {
  std::string text;
  for (const TimedStudy& study : timed_studies(scene)) {
    text +=
        fmt::format("{}{} {}", text.empty() ? "" : ", ", study.command, StudyProcess(study).time());
  }
  return text;
}

}  // namespace hamjet::cli
