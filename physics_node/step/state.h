#pragma once
// What changes of a lattice body: structure of arrays over storage cells, in the precision of the scene.

#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>

#include "physics_node/body/body.h"
#include "physics_node/step/mass_flags.h"

namespace palpate::physics {

/// Zeroed memory, aligned to 64 bytes, with a vector's worth of zeros to read beyond its end; pages that are never
/// written cost nothing.
template <class T>
class ZeroedArray {
 public:
  ZeroedArray() = default;
  explicit ZeroedArray(std::size_t n)
      : n_(n), block_(static_cast<std::byte*>(std::calloc(n * sizeof(T) + 64 + 64, 1))) {
    if (!block_) throw std::bad_alloc();
    const auto address = reinterpret_cast<std::uintptr_t>(block_.get());
    data_ = reinterpret_cast<T*>((address + 63) / 64 * 64);
  }
  T* data() noexcept { return data_; }
  const T* data() const noexcept { return data_; }
  T& operator[](std::size_t i) noexcept { return data_[i]; }
  const T& operator[](std::size_t i) const noexcept { return data_[i]; }
  std::size_t size() const noexcept { return n_; }

 private:
  struct Free {
    void operator()(std::byte* block) const noexcept { std::free(block); }
  };
  std::size_t n_ = 0;
  std::unique_ptr<std::byte, Free> block_;
  T* data_ = nullptr;
};

template <class Real>
using Three = std::array<ZeroedArray<Real>, 3>;  // x, y, z

template <class Real>
struct LatticeState {
  Three<Real> u, v;                 // displacement from rest [m], velocity [m/s]            (n_cells)
  Three<Real> next_u, next_v;       // written by the step, then swapped                     (n_cells)
  ZeroedArray<Mask> mask;           // live elements                                         (n_cells)
  ZeroedArray<std::uint8_t> flags;  // mass_yielded | mass_broken       (n_cells)
  std::array<ZeroedArray<Real>, max_half>
      l_c;  // plastic stretch [m]; only where the material yields (n_cells)
  std::array<ZeroedArray<Real>, max_half>
      y_p;                         // yield ratio now; only where the material yields     (n_cells)
  ZeroedArray<Real> inverse_mass;  // constant, in this precision      (n_cells)

  explicit LatticeState(const Body& body);
  void reset(const Body& body);
};

}  // namespace palpate::physics
