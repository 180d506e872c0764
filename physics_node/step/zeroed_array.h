#pragma once
// Memory for one number of every storage cell.

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>

namespace palpate::physics {

/// Zeroed memory, aligned to 64 bytes, with a vector's worth of zeros to read beyond its end; pages that are never
/// written cost nothing.
/// @param colour  arrays that are read together take different ones: each begins five cache lines further into its
///                page, so that the same cell of many arrays does not fall into one set of the first-level cache
template <class T>
class ZeroedArray {
 public:
  ZeroedArray() = default;
  explicit ZeroedArray(std::size_t n, std::size_t colour = 0)
      : n_(n), block_(static_cast<std::byte*>(std::calloc(n * sizeof(T) + page + 128, 1))) {
    if (!block_) throw std::bad_alloc();
    const auto address = reinterpret_cast<std::uintptr_t>(block_.get());
    const std::uintptr_t aligned = (address + 63) / 64 * 64;
    data_ = reinterpret_cast<T*>(aligned + (colour * 5 * 64) % page);
  }
  /// Of an array that is about to be written everywhere: in pages of 2 MB where the system has them, as common/process/large_pages.cpp.
  void will_be_filled() noexcept {
    constexpr std::uintptr_t large = std::uintptr_t{2} << 20;
    const auto begin = (reinterpret_cast<std::uintptr_t>(data_) + large - 1) / large * large;
    const auto end = reinterpret_cast<std::uintptr_t>(data_ + n_) / large * large;
    if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);  // a wish
  }
  T* data() noexcept { return data_; }
  const T* data() const noexcept { return data_; }
  T& operator[](std::size_t i) noexcept { return data_[i]; }
  const T& operator[](std::size_t i) const noexcept { return data_[i]; }
  std::size_t size() const noexcept { return n_; }

 private:
  static constexpr std::size_t page = 4096;
  struct Free {
    void operator()(std::byte* block) const noexcept { std::free(block); }
  };
  std::size_t n_ = 0;
  std::unique_ptr<std::byte, Free> block_;
  T* data_ = nullptr;
};

}  // namespace palpate::physics
