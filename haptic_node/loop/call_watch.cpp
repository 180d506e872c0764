#include "haptic_node/loop/call_watch.h"

#include <cstdio>
#include <cstdlib>

#include "common/error/error.h"
#include "common/process/stop_flag.h"
#include "common/report/log.h"

namespace palpate::haptic {
namespace {

constexpr std::chrono::milliseconds look_again{20};

}  // namespace

CallWatch::CallWatch(std::function<void()> last_act)
    : last_act_(std::move(last_act)), thread_([this] { watch(); }) {}

CallWatch::~CallWatch() {
  over_.store(true);
  thread_.join();
}

void CallWatch::enter(const std::string& what) {
  const std::lock_guard<std::mutex> lock(gate_);
  what_ = what;
}

void CallWatch::watch() {
  using Clock = std::chrono::steady_clock;
  Clock::time_point asked{};
  while (!over_.load()) {
    std::this_thread::sleep_for(look_again);
    const std::lock_guard<std::mutex> lock(gate_);
    if (!stop_requested() || what_.empty()) {
      asked = {};
      continue;
    }
    if (asked == Clock::time_point{}) asked = Clock::now();
    if (Clock::now() - asked < patience) continue;
    log_error("{}: its driver does not come back, and the end was asked for; this process leaves it behind",
              what_);
    last_act_();
    std::fflush(nullptr);
    std::_Exit(exit_failed);
  }
}

}  // namespace palpate::haptic
