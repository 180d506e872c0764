#pragma once
// A vector of every node of a body, in the precision of its state.

#include <cstddef>

#include "common/math/vec3.h"
#include "physics_node/lattice/lattice_types.h"

namespace palpate::physics {

/// A view: the body owns the numbers, and they change with each step.
class NodeField {
 public:
  NodeField() = default;
  NodeField(const float* x, const float* y, const float* z) : data_{x, y, z}, single_(true) {}
  NodeField(const double* x, const double* y, const double* z) : data_{x, y, z} {}
  /// Four numbers of each node beside each other: x, y, z and one more.
  explicit NodeField(const float* fours) : data_{fours, fours + 1, fours + 2}, shift_(2), single_(true) {}
  explicit NodeField(const double* fours) : data_{fours, fours + 1, fours + 2}, shift_(2) {}

  Vec3 operator[](Index node) const noexcept { return single_ ? at<float>(node) : at<double>(node); }

 private:
  template <class Real>
  Vec3 at(Index node) const noexcept {
    const std::size_t n = static_cast<std::size_t>(node) << shift_;
    return {static_cast<double>(static_cast<const Real*>(data_[0])[n]),
            static_cast<double>(static_cast<const Real*>(data_[1])[n]),
            static_cast<double>(static_cast<const Real*>(data_[2])[n])};
  }

  const void* data_[3] = {};
  unsigned shift_ = 0;
  bool single_ = false;
};

}  // namespace palpate::physics
