#pragma once
// The colours of bodies and fragments that have none of their own (0xAABBGGRR).

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/scene/scene_fwd.h"
#include "physics_node/boundary/surface.h"
#include "physics_node/fragments/fragments.h"

namespace palpate::physics {

/// Steel for a body that is a tool, otherwise one tint of tissue after the other.
std::uint32_t body_colour(const Scene& scene, std::size_t body);

inline constexpr std::uint32_t strand_colour = 0xFF70C8E8;  // of connecting tissue, as of fat

/// Well apart from the colours of nearby labels, and always the same for a label. @param label  >= 0
std::uint32_t fragment_colour(std::int32_t label);

/// The fragments of a body at one moment, apart from the body: a thread of its own may colour a surface by them.
class FragmentColours {
 public:
  /// Cost: a copy of the label of every mass.
  FragmentColours(const Fragments& fragments, const Body& body);

  /// Gives every fragment its colour but the one with most masses, which keeps the body's.
  void paint(Surface& surface) const;

 private:
  std::vector<Index> label_;  // (capacity of the body)
  Index largest_ = 0;
};

}  // namespace palpate::physics
