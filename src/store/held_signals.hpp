#pragma once

#include <pthread.h>

#include <array>
#include <csignal>

namespace hamjet::io {

/// The signals by which a user or a system asks a program to end: hang-up of the terminal, Ctrl-C,
/// Ctrl-\, kill.
inline constexpr std::array ending_signals = {SIGHUP, SIGINT, SIGQUIT, SIGTERM};

/// During its lifetime, the signals that end the program (and the alarm after them) are blocked in
/// this thread and in threads that it starts; they wait until the end.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t held;
    sigemptyset(&held);
    for (const int signal : ending_signals) sigaddset(&held, signal);
    sigaddset(&held, SIGALRM);
    ::pthread_sigmask(SIG_BLOCK, &held, &before_);
  }
  ~HeldSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace hamjet::io
