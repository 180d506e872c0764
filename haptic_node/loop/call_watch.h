#pragma once
// Calls into a driver that the slow thread makes by itself, and that may never come back: opening a device,
// switching its motors on. Nothing after them can be done meanwhile, but a node that is stopped meanwhile
// ends.

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace palpate::haptic {

class CallWatch {
 public:
  /// After a person has asked for the end. Why: palpate gives its nodes 0.7 s before it kills them.
  static constexpr std::chrono::milliseconds patience{500};

  /// @param last_act  before the process is left in the middle of a call: motors off, as far as may be
  explicit CallWatch(std::function<void()> last_act);
  ~CallWatch();
  CallWatch(const CallWatch&) = delete;
  CallWatch& operator=(const CallWatch&) = delete;

  /// While it lives, the slow thread is in a call.
  class Call {
   public:
    /// @param what  for a person: "tip: opening its device"
    Call(CallWatch& watch, const std::string& what) : watch_(watch) { watch_.enter(what); }
    ~Call() { watch_.enter({}); }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

   private:
    CallWatch& watch_;
  };

 private:
  void enter(const std::string& what);
  void watch();

  std::function<void()> last_act_;
  std::mutex gate_;
  std::string what_;  // behind the gate; empty: no call
  std::atomic<bool> over_{false};
  std::thread thread_;
};

}  // namespace palpate::haptic
