#pragma once
// Which elements of a body live, what broke in the last step, and what its nodes have been through.

#include <cstdint>
#include <span>

#include "physics_node/body/body.h"
#include "physics_node/step/fresh_breaks.h"
#include "physics_node/step/mass_flags.h"

namespace palpate::physics {

/// What a node has been through.
struct Condition {
  std::uint8_t flags = 0;  // mass_flags.h
  double yielded_share =
      0;  // of its live elements, [0, 1]; of a node without any, whether one had yielded before it broke
};

class Topology {
 public:
  virtual ~Topology() = default;
  const Body& body() const noexcept { return *body_; }

  /// Live elements of every storage cell, as bits  (n_cells)
  std::span<const Mask> masks() const noexcept { return masks_; }
  Mask mask(Index cell) const noexcept { return masks_[static_cast<std::size_t>(cell)]; }

  /// Elements that broke in the last step, in storage order; invalidated by the next step in which an element breaks.
  virtual std::span<const Break> fresh_breaks() const noexcept = 0;
  /// The list is not all: anything may have changed. After a reset and a restore at once and still after the next step, and
  /// after a step in which more broke than the list holds. Never where nothing yields.
  virtual bool fresh_overflow() const noexcept = 0;
  /// Elements broken since the start.
  virtual std::int64_t breaks() const noexcept = 0;
  /// @param out  one for each of the cells
  virtual void conditions(std::span<const Index> cells, std::span<Condition> out) const noexcept = 0;

 protected:
  explicit Topology(const Body& body) : body_(&body) {}
  /// Once, by the maker: what it steps.
  void show(std::span<const Mask> masks) { masks_ = masks; }

 private:
  const Body* body_;
  std::span<const Mask> masks_;
};

}  // namespace palpate::physics
