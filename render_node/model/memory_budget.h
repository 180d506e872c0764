#pragma once
// How much of what others send the eye keeps. Why: a surface may have 33 million vertices by its promises, and a scene 64
// bodies; what is drawn of a vertex takes some four times what came over the wire.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

namespace palpate::render {

/// Bytes as they came, of all bodies together: surfaces shown, surfaces that still lack chunks, pages and blocks that wait for theirs.
struct MemoryBudget {
  static constexpr std::size_t most = std::size_t{128} << 20;  // 4 million vertices with their facets
  std::size_t used = 0;
  std::uint64_t refused = 0;  // times
};

/// A part of the budget, given back by its end.
class MemoryHold {
 public:
  explicit MemoryHold(std::shared_ptr<MemoryBudget> budget) : budget_(std::move(budget)) {}
  MemoryHold(MemoryHold&& other) noexcept : budget_(other.budget_), bytes_(std::exchange(other.bytes_, 0)) {}
  MemoryHold& operator=(MemoryHold&& other) noexcept {
    std::swap(budget_, other.budget_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~MemoryHold() { clear(); }

  /// @return false if there is no room: nothing has changed then
  bool add(std::size_t bytes) noexcept {
    if (bytes > MemoryBudget::most || budget_->used > MemoryBudget::most - bytes) {
      ++budget_->refused;
      return false;
    }
    budget_->used += bytes;
    bytes_ += bytes;
    return true;
  }
  void clear() noexcept { budget_->used -= std::exchange(bytes_, 0); }

 private:
  std::shared_ptr<MemoryBudget> budget_;
  std::size_t bytes_ = 0;
};

}  // namespace palpate::render
