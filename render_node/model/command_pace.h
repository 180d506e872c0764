#pragma once
// When a control commands what a person sets: a value that is not yet commanded, at most five times a second while it is moved.

namespace palpate::render {

template <class Value>
class CommandPace {
 public:
  static constexpr double shortest_s = 0.2;  // between two commands

  CommandPace() = default;
  /// @param known  what everybody begins with
  explicit CommandPace(const Value& known) : sent_(known) {}

  /// Somebody commanded this: it is not commanded again.
  void obey(const Value& value) noexcept { sent_ = value; }
  /// Is it to be commanded now? Then it counts as done. @param now  wall time [s]
  bool due(const Value& value, double now, bool released) noexcept {
    if (value == sent_ || (!released && now - sent_at_ < shortest_s)) return false;
    sent_ = value;
    sent_at_ = now;
    return true;
  }

 private:
  Value sent_{};
  double sent_at_ = -1e9;
};

}  // namespace palpate::render
