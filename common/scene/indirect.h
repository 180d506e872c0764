#pragma once
// A value kept elsewhere: copied and moved as a member would be, but its type may be incomplete where the
// owner is declared. Who uses the value includes its header; who only passes the owner on does not compile again when it
// changes. As std::indirect of C++26 (P3019), without allocators.
//
// The owner's special members are defined where T is complete. After a move the source may only be assigned or destroyed.

#include <memory>
#include <utility>

namespace palpate {

template <class T>
class Indirect {
 public:
  Indirect() : value_(std::make_unique<T>()) {}
  explicit Indirect(T value) : value_(std::make_unique<T>(std::move(value))) {}
  Indirect(const Indirect& other) : value_(other.value_ ? std::make_unique<T>(*other.value_) : nullptr) {}
  Indirect(Indirect&&) noexcept = default;
  Indirect& operator=(const Indirect& other) {
    value_ = other.value_ ? std::make_unique<T>(*other.value_) : nullptr;  // made before the old one goes
    return *this;
  }
  Indirect& operator=(Indirect&&) noexcept = default;
  Indirect& operator=(T value) {
    value_ = std::make_unique<T>(std::move(value));
    return *this;
  }

  T& operator*() noexcept { return *value_; }
  const T& operator*() const noexcept { return *value_; }
  T* operator->() noexcept { return value_.get(); }
  const T* operator->() const noexcept { return value_.get(); }

 private:
  std::unique_ptr<T> value_;  // never null but after a move
};

}  // namespace palpate
