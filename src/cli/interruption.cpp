#include "interruption.hpp"

#include <csignal>

namespace hamjet::cli {
namespace {

volatile std::sig_atomic_t pending_signal = 0;

extern "C" void remember_signal(int signal) {
  pending_signal = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_signals() {
  std::signal(SIGINT, remember_signal);
  std::signal(SIGTERM, remember_signal);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void stop_if_interrupted() {
  if (pending_signal != 0) throw Interrupted(pending_signal);
}

}  // namespace hamjet::cli
