#pragma once
// A world whose one tool is a blade, and a hand that leads it a frame at a time.

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "common/scene/scene.h"
#include "physics_node/world.h"
#include "tests/support/physics/recorded_hand.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {

struct LedBlade {
  /// @param start  of the tip [m]
  LedBlade(const Recipe& recipe, const Vec3& start) : world(scene_of(recipe)), path{start, start} {}
  /// A frame after which the hand is there. @return force on the tool
  Vec3 to(const Vec3& tip) {
    path.push_back(tip);
    std::optional<ToolState> hand = recorded_hand(
        [this](double t) { return path[static_cast<std::size_t>(std::llround(1e3 * t))]; }, path.size() - 1);
    hand->stiffness = 1000;
    world.frame(std::span(&hand, 1));
    return world.tool(0).borne();
  }
  /// Straight on at a speed. @return forces of all frames
  std::vector<Vec3> along(const Vec3& end, double speed) {
    std::vector<Vec3> forces;
    const Vec3 begin = path.back();
    const auto n = static_cast<int>(std::ceil((end - begin).norm() / speed * 1e3));
    for (int i = 1; i <= n; ++i) forces.push_back(to(begin + (end - begin) * i / n));
    return forces;
  }
  /// What a straight stroke is like, in the mean of its frames.
  struct Stroke {
    double force = 0;    // against its way [N]
    double jump = 0;     // the most from one frame to the next [N]
    double opened = 0;   // of area, by its way [m]
    double viscous = 0;  // what tissue dissipates, by its way [N]
  };
  Stroke stroke(const Vec3& end, double speed) {
    const Vec3 way = end - path.back();
    const double dissipated = world.ledger().dissipated, opened = book().cut_area();
    const std::vector<Vec3> forces = along(end, speed);
    Stroke of{0, 0, (book().cut_area() - opened) / way.norm(),
              (world.ledger().dissipated - dissipated) / way.norm()};
    for (std::size_t i = 0; i < forces.size(); ++i) {
      of.force -= forces[i].dot(way.normalized()) / static_cast<double>(forces.size());
      if (i > 0) of.jump = std::max(of.jump, (forces[i] - forces[i - 1]).norm());
    }
    return of;
  }
  const TouchBook& book() { return world.tool(0).book(); }

  World world;
  std::vector<Vec3> path;
};

}  // namespace palpate::physics::test
