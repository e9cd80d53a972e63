#pragma once

#include <chrono>

namespace hamjet {

/// Wall time of an integration alone: what its observer takes is left out.
class IntegrationClock {
 public:
  using Clock = std::chrono::steady_clock;

  /// Makes a call, such as the observer's, whose time is left out.
  template <class Call>
  void exclude(const Call& call) {
    const auto before = Clock::now();
    call();
    excluded_ += Clock::now() - before;
  }
  /// Makes a call whose time is left out and added to `seconds`.
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
