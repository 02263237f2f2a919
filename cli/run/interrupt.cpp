// Remembering a signal.
#include "cli/run/interrupt.h"

#include <csignal>
#include <initializer_list>

namespace billow::cli {

namespace {

volatile std::sig_atomic_t pending_signal = 0;

extern "C" void remember(int signal) { pending_signal = signal; }

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESETHAND | SA_RESTART;  // the default action is back for a second signal
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction present = {};
    sigaction(signal, nullptr, &present);
    if (present.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);  // nohup stays nohup
  }
}

void ignore_write_signals() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void heed_children() { std::signal(SIGCHLD, SIG_DFL); }

int interrupted_by() { return pending_signal; }

}  // namespace billow::cli
