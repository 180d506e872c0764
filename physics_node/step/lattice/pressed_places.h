#pragma once
// Where a body is pressed, and how hard: a few places, each the middle of forces that lie together.

#include <span>
#include <vector>

#include "common/math/vec3.h"

namespace palpate::physics {

struct PressedPlace {
  Vec3 at = Vec3::Zero();    // middle of the forces, where the body rests [m]
  double weight = 0;         // sum of their magnitudes since the look before the last; 0: it is let go [N]
  Vec3 push = Vec3::Zero();  // sum of them [N]
  double idle = 0;           // for how long [s]
};

class PressedPlaces {
 public:
  static constexpr std::size_t most = 16;

  /// @param apart  forces further than this from all places make one of their own, while there is room [m]
  explicit PressedPlaces(double apart);

  /// @param at  where the node rests [m], @param force  on it [N]. @return is it a new place?
  bool note(const Vec3& at, const Vec3& force) noexcept;
  /// Places follow what was noted since the last look. One that nothing pressed for half a second is forgotten; of two that have met
  /// the harder pressed one stays. @param seconds  since the last look; 0: it came early
  void look(double seconds) noexcept;
  std::span<const PressedPlace> now() const noexcept { return places_; }
  void clear() noexcept;

 private:
  struct Noted {
    double force = 0;
    Vec3 moment = Vec3::Zero();  // force times place
    Vec3 push = Vec3::Zero();    // of vectors
  };
  double apart_;
  std::vector<PressedPlace> places_;
  std::vector<Noted> noted_;  // of each place
};

}  // namespace palpate::physics
