#pragma once
// One object that several threads use and one thread owns and may replace, without locks: the owner takes it back, and
// gets it once no user holds it. Users never wait for the owner.
// Source: Michael 2004 (hazard pointers), with one slot a user.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace palpate {

/// @tparam Users  threads that may hold the object, numbered from 0
template <class T, std::size_t Users>
class Handover {
 public:
  explicit Handover(std::unique_ptr<T> object) { offer(std::move(object)); }

  /// User `user`: the object until let_go(), or null while it is taken back. Tries again only when the owner has just
  /// acted, which is rare.
  T* hold(std::size_t user) noexcept {
    T* object = current_.load();
    for (;;) {
      held_[user].store(object);
      T* again = current_.load();
      if (again == object) return object;
      object = again;
    }
  }
  void let_go(std::size_t user) noexcept { held_[user].store(nullptr, std::memory_order_release); }

  /// How many objects have been offered so far: another one may have the same address.
  std::uint64_t generation() const noexcept { return generation_.load(std::memory_order_acquire); }

  /// Owner: the object, or null while it is taken back.
  T* get() noexcept { return current_.load(std::memory_order_relaxed); }

  /// Owner: from now on users find `object`. Only after take_back() has given the last one back.
  void offer(std::unique_ptr<T> object) noexcept {
    object_ = std::move(object);
    generation_.fetch_add(1, std::memory_order_release);
    current_.store(object_.get());
  }

  /// Owner: users find nothing any more. @return the object, or null while somebody still holds it: ask again later
  std::unique_ptr<T> take_back() noexcept {
    current_.store(nullptr);
    for (const auto& held : held_)
      if (held.load() == object_.get()) return nullptr;
    return std::move(object_);
  }

 private:
  std::unique_ptr<T> object_;
  std::atomic<T*> current_{nullptr};
  std::atomic<std::uint64_t> generation_{0};
  std::array<std::atomic<T*>, Users> held_{};
};

}  // namespace palpate
