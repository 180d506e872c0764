#pragma once
// What a hand feels of a surface that physics computes elsewhere: tissue_touch.h in space, with sliding and friction. Physics
// presses its tissue by the tip's recorded motion; the hand presses a copy by the same motion now, whose shadow takes over the
// state of an answer and replays the motion since, and fades what is felt towards it.

#include <cstdint>

#include "haptic_node/safety/force_guard.h"
#include "haptic_node/safety/leak_limit.h"
#include "haptic_node/tissue/surface_fade.h"
#include "haptic_node/tissue/tissue_touch.h"

namespace palpate::haptic {

class SurfaceTouch {
 public:
  explicit SurfaceTouch(const TouchSettings& settings) noexcept;

  /// An answer that is_sound() and newer than the last. Before the next tick().
  /// @return false if it is of no use: of a sample that is forgotten or to come, or of other modes while the tip touches
  bool take(const SurfaceAnswer& answer) noexcept;

  /// One tick. Contract: real time.
  /// @param x     tip [m]
  /// @param gain  0..1; 0 forgets the tissue until the next answer
  /// @return the force on the tissue that the device is to answer, its hold paid [N]
  Vec3 tick(const Vec3& x, double gain) noexcept;

  /// F of this sample as it is felt: limited by energy and gain, before the hold is paid [N].
  const Vec3& felt() const noexcept { return felt_force_; }
  bool touching() const noexcept { return began_ && felt_.force.squaredNorm() > 0; }
  /// Of what the copy holds, what may still be given [J].
  double stored() const noexcept { return leak_.left(); }
  double correction_work() const noexcept { return tank_.booked(); }  // since the start [J]
  double share() const noexcept { return share_; }
  double leak() const noexcept { return leak_.leak(); }  // L [J]
  /// Energy that steps of the copy have made by themselves, sum of -min(0, D) since the start [J].
  double made() const noexcept { return made_; }
  const TipHistory& history() const noexcept { return history_; }
  const SurfaceState& felt_state() const noexcept { return felt_; }

 private:
  void begin(const TipSample& tip) noexcept;
  void weaken(double keep, const Vec3& x) noexcept;
  Vec3 command(const HeldSurface& held, const Vec3& v) const noexcept;

  TouchSettings settings_;
  TipHistory history_;
  SurfaceModel model_;
  SurfaceStep step_;
  SurfaceState felt_, shadow_;
  WorkTank tank_;
  LeakLimit leak_;
  ForceGuard guard_;
  bool began_ = false;
  std::uint64_t shadow_at_ = 0;  // the sample that the shadow has been brought to; 0: no shadow
  double gain_ = 0;              // of the last tick
  Vec3 felt_force_ = Vec3::Zero();
  double share_ = 1, made_ = 0;
};

}  // namespace palpate::haptic
