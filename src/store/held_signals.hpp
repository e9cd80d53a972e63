#pragma once

#include <pthread.h>

#include <array>
#include <csignal>

namespace hamjet::io {

/// The signals by which a user or a system asks a program to end: the terminal is gone, Ctrl-C,
/// Ctrl-\, kill.
inline constexpr std::array ending_signals = {SIGHUP, SIGINT, SIGQUIT, SIGTERM};

/// While it lives, the signals that end the program (and the alarm after them) wait in this thread,
/// and never come to threads that it starts.
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
