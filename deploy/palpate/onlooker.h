#pragma once
// Who looks at a session that runs in this process.

#include <cstdint>

#include "common/message/messages.h"
#include "physics_node/world.h"

namespace palpate::deploy {

class Onlooker {
 public:
  virtual ~Onlooker() = default;
  /// What a hand did in one of its ticks.
  virtual void take(std::uint32_t tool, const TraceSample& sample) = 0;
  /// After every frame.
  virtual void frame(physics::World& world, std::int64_t now_ns) = 0;
};

}  // namespace palpate::deploy
