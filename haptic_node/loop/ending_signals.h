#pragma once
// Which signals end palpate-haptic, and how.
//
//   in order (common/process/stop_flag)  SIGINT, SIGTERM, SIGHUP, SIGPWR
//   not at all                           SIGPIPE, SIGXFSZ (the write fails instead), SIGTSTP, SIGTTIN, SIGTTOU: a process
//                                        that is stopped cannot lower its force
//   motors off, then as without us       all that follow here
//   past everything                      SIGKILL (see guardian/), SIGSTOP

#include <csignal>
#include <vector>

namespace palpate::haptic {

/// Something is broken: taken from whoever had it, who gets it afterwards.
inline const std::vector<int>& crash_signals() {
  static const std::vector<int> all = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGSYS, SIGTRAP};
  return all;
}

/// Nobody should send these, and each would end the process. Left alone where a library uses one.
inline std::vector<int> stray_signals() {
  std::vector<int> all = {SIGQUIT, SIGALRM, SIGVTALRM, SIGPROF,  SIGUSR1,
                          SIGUSR2, SIGXCPU, SIGPOLL,   SIGSTKFLT};
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) all.push_back(signal);
  return all;
}

inline constexpr int stop_signals[] = {SIGTSTP, SIGTTIN, SIGTTOU};

}  // namespace palpate::haptic
