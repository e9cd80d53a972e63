#pragma once

#include <pthread.h>

#include <csignal>

namespace hamjet::io {

/// While it lives, the signals that end the program (SIGINT, SIGTERM and the alarm after them) wait
/// in this thread, and never come to threads that it starts.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t held;
    sigemptyset(&held);
    for (const int signal : {SIGINT, SIGTERM, SIGALRM}) sigaddset(&held, signal);
    ::pthread_sigmask(SIG_BLOCK, &held, &before_);
  }
  ~HeldSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace hamjet::io
