#pragma once

#include <chrono>

namespace hamjet {

/// Wall time of an integration alone: what its observer takes is left out.
class IntegrationClock {
 public:
  using Clock = std::chrono::steady_clock;

  /// Calls the observer.
  template <class Call>
  void exclude(const Call& call) {
    const auto before = Clock::now();
    call();
    excluded_ += Clock::now() - before;
  }
  /// The same for another call, whose time is added to `seconds`.
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
