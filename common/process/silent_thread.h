#pragma once
// A thread that gets no signal: those sent to the process stay with the threads that wait for them.

#include <pthread.h>
#include <signal.h>

#include <thread>
#include <utility>

namespace palpate {

template <class Body>
std::thread silent_thread(Body&& body) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);  // a thread begins with the mask of its maker
  std::thread thread(std::forward<Body>(body));
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

}  // namespace palpate
