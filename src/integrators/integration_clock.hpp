#pragma once

#include <chrono>

namespace hamjet {

/// Wall time of an integration alone, without the time of its observer.
class IntegrationClock {
 public:
  using Clock = std::chrono::steady_clock;

  /// Makes a call, for example to the observer, whose time is not counted.
  template <class Call>
  void exclude(const Call& call) {
    const auto before = Clock::now();
    call();
    excluded_ += Clock::now() - before;
  }
  /// Makes a call whose time is not counted but added to `seconds`.
  template <class Call>
  void exclude(const Call& call, double& seconds) {
    const auto before = Clock::now();
    call();
    const auto taken = Clock::now() - before;
    excluded_ += taken;
    seconds += std::chrono::duration<double>(taken).count();
  }

  double seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_ - excluded_).count();
  }

 private:
  Clock::time_point start_ = Clock::now();
  Clock::duration excluded_{0};
};

}  // namespace hamjet
