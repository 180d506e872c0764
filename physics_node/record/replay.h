#pragma once
// Runs a recorded session again, frame by frame, and compares the state with the hashes that the first run left.

#include <cstdint>
#include <optional>
#include <vector>

#include "physics_node/record/session_record.h"
#include "physics_node/world.h"

namespace palpate::physics {

class Replay {
 public:
  struct Difference {
    std::uint64_t frame = 0;  // frames done
    double t = 0;             // [s]
    std::uint64_t recorded = 0, found = 0;
  };

  /// @param world  just made from record.lay_out(); both must outlive this
  Replay(SessionRecord& record, World& world);

  /// One frame with what acted in it. @return false: nothing is left of the record, or the states differ
  bool frame();

  const std::vector<std::optional<ToolState>>& hands() const noexcept { return hands_; }
  std::uint64_t compared() const noexcept { return compared_; }
  const std::optional<Difference>& difference() const noexcept { return difference_; }

 private:
  void compare();

  SessionRecord& record_;
  World& world_;
  std::vector<std::optional<ToolState>> hands_;
  std::size_t next_hash_ = 0, next_command_ = 0;
  std::uint64_t compared_ = 0;
  std::optional<Difference> difference_;
};

}  // namespace palpate::physics
