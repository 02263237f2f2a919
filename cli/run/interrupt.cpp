// Remembering a signal, and what is done in no time.
#include "cli/run/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <initializer_list>

#include "base/sudden_end.h"

namespace billow::cli {

namespace {

volatile std::sig_atomic_t pending_signal = 0, remembers = 0;

extern "C" void on_signal(int signal) {
  if (remembers && pending_signal == 0) {
    pending_signal = signal;
    return;
  }
  tidy_up(SuddenEnd::interruption);
  std::signal(signal, SIG_DFL);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, signal);
  sigprocmask(SIG_UNBLOCK, &only, nullptr);
  raise(signal);
  _exit(128 + signal);  // the first process of a container is not ended by a signal
}

}  // namespace

void tidy_up_on_signals() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction present = {};
    sigaction(signal, nullptr, &present);
    if (present.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);  // nohup stays nohup
  }
}

void catch_interrupts() { remembers = 1; }

void ignore_write_signals() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void heed_children() { std::signal(SIGCHLD, SIG_DFL); }

int interrupted_by() { return pending_signal; }

}  // namespace billow::cli
