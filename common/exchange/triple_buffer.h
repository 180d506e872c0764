#pragma once
// The newest value from one thread to one other, without locks: the reader never waits, never sees half a value,
// and never sees an older one than before. Values that nobody took are lost on purpose.

#include <atomic>
#include <cstdint>
#include <type_traits>

namespace palpate {

/// One writing thread, one reading thread. Neither call allocates, locks or fails.
template <class T>
class TripleBuffer {
  static_assert(std::is_trivially_copyable_v<T>, "copied as bytes between threads");

 public:
  /// Writer: replaces the newest value.
  void write(const T& value) noexcept {
    slots_[back_].value = value;
    back_ =
        middle_.exchange(static_cast<std::uint8_t>(back_ | fresh), std::memory_order_acq_rel) & index_mask;
  }

  /// Reader: the newest value, valid until the next call; null if nothing was ever written.
  /// `is_new` tells whether it was written after the last call.
  const T* newest(bool* is_new = nullptr) noexcept {
    const bool has_fresh = (middle_.load(std::memory_order_relaxed) & fresh) != 0;
    if (has_fresh) {
      front_ = middle_.exchange(front_, std::memory_order_acq_rel) & index_mask;
      ever_ = true;
    }
    if (is_new != nullptr) *is_new = has_fresh;
    return ever_ ? &slots_[front_].value : nullptr;
  }

 private:
  static constexpr std::uint8_t fresh = 4;
  static constexpr std::uint8_t index_mask = 3;

  struct alignas(64) Slot {
    T value{};
  };
  Slot slots_[3];
  alignas(64) std::atomic<std::uint8_t> middle_{1};
  alignas(64) std::uint8_t back_ = 0;   // the writer's
  alignas(64) std::uint8_t front_ = 2;  // the reader's
  bool ever_ = false;
};

}  // namespace palpate
