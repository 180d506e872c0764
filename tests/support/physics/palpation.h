#pragma once
// A hand that palpates the slab of palpated_slab.h, and what the tissue tool tells of it.

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>

#include "tests/support/physics/palpated_slab.h"
#include "tests/support/physics/recorded_hand.h"

namespace palpate::physics::test {

/// In the air for 50 ms, then down to 2 mm, and 0.5 mm to and fro at 5 Hz until 0.65 s; then away.
inline Vec3 palpation(double t) {
  const double in = 1e-3 * (-1 + 3 * std::clamp((t - 0.05) / 0.1, 0.0, 1.0));
  const double swing = t > 0.15 ? 0.5e-3 * std::sin(2 * M_PI * 5 * (t - 0.15)) : 0;
  return {0.0005, 0.0005, slab_top - in - swing + (t > 0.65 ? 0.2 * (t - 0.65) : 0)};
}

/// A world with one tool that a hand leads.
struct Session {
  explicit Session(const Recipe& recipe) : world(scene_of(recipe)) {}
  /// A frame at whose end this sample of the hand is played.
  const TouchedTissue& to(std::uint64_t sample, const std::function<Vec3(double)>& path = palpation) {
    std::optional<ToolState> hand = recorded_hand(path, sample);
    world.frame(std::span(&hand, 1));
    world.tool(0).write_patch(patch, 1, 0);
    return patch.tissues[0];
  }
  Vec3 borne() const { return world.tool(0).borne(); }

  World world;
  ContactPatch patch;
};

inline double pressed(const TouchedTissue& told) { return -vec(told.normal).dot(vec(told.force)); }

}  // namespace palpate::physics::test
