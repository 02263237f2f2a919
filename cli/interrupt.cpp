// Remembering a signal.
#include "cli/interrupt.h"

#include <csignal>

namespace billow::cli {

namespace {

volatile std::sig_atomic_t pending_signal = 0;

extern "C" void remember(int signal) { pending_signal = signal; }

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESETHAND | SA_RESTART;  // the default action is back for a second signal
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int interrupted_by() { return pending_signal; }

}  // namespace billow::cli
