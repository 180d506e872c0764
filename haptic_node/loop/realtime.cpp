#include "haptic_node/loop/realtime.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace palpate::haptic {
namespace {

constexpr std::size_t stack_bytes = 512 * 1024;

[[gnu::noinline]] void touch_stack() noexcept {
  char stack[stack_bytes];
  volatile char* bytes = stack;
  for (std::size_t i = 0; i < stack_bytes; i += 4096) bytes[i] = 0;
}

int set_fifo(int priority) noexcept {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
}

}  // namespace

bool lock_memory(std::string& why) {
  if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return true;
  why = fmt::format("memory is not locked ({}); raise memlock for this user in /etc/security/limits.d",
                    std::strerror(errno));
  munlockall();
  return false;
}

bool may_schedule(int priority, std::string& why) {
  int policy = SCHED_OTHER;
  sched_param before{};
  pthread_getschedparam(pthread_self(), &policy, &before);
  const int error = set_fifo(priority);
  if (error != 0) {
    why = fmt::format("no real-time scheduling ({}); raise rtprio for this user in /etc/security/limits.d",
                      std::strerror(error));
    return false;
  }
  pthread_setschedparam(pthread_self(), policy, &before);
  return true;
}

bool enter_realtime(int priority) noexcept {
  touch_stack();
#ifdef __SSE2__
  constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
  _mm_setcsr(_mm_getcsr() | flush_to_zero | denormals_are_zero);
#endif
  return set_fifo(priority) == 0;
}

std::string rights_text(const RealtimeRights& rights) {
  return fmt::format("rt: fifo={} mlock={}", rights.scheduled ? "yes" : "no", rights.locked ? "yes" : "no");
}

}  // namespace palpate::haptic
