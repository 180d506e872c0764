#pragma once
// The physics side of a touch in space: a block of tissue pressed by the tip's recorded motion, in the hand's own time, with
// friction, through the spring and damper that the hand feels. As pressed_tissue.h has it in one dimension.

#include <memory>
#include <vector>

#include "bench/haptic/tissue_block.h"
#include "bench/haptic/told_samples.h"
#include "haptic_node/tissue/surface_step.h"

namespace palpate::bench {

/// How the hand is told wrong, for negative controls.
struct SurfaceError {
  bool frozen = false;   // as if the whole surface were as it is at xi
  bool residual = true;  // R is told
};

class PressedBlock {
 public:
  static constexpr double sample_time = 1e-3, rest_smoothing = 5e-3;  // [s]

  PressedBlock(const haptic::ContactSpring& spring, double friction, std::uint32_t modes,
               const SurfaceError& error, const haptic::SurfacePlace& xi)
      : spring_(spring), friction_(friction), modes_(modes), error_(error), xi_(xi) {}

  /// A frame. @param hand  newest message, or null
  void frame(const TipSamples* hand);
  std::shared_ptr<const haptic::SurfaceAnswer> answer(std::uint64_t tick);

  std::uint64_t stamp() const noexcept { return stamp_; }
  /// Force that the tissue bore at a sample [N]. Only up to stamp().
  Vec3 borne(std::uint64_t sample) const {
    return sample < borne_.size() ? borne_[sample] : Vec3(Vec3::Zero());
  }
  const haptic::SurfacePlace& xi() const noexcept { return xi_; }

 private:
  haptic::SurfacePlace ahead() const;
  Vec3 press(const haptic::TipSample& tip);
  void play(const haptic::TipSample& a, const haptic::TipSample& b);

  TissueBlock tissue_;
  haptic::ContactSpring spring_;
  double friction_;
  std::uint32_t modes_;
  SurfaceError error_;
  haptic::SurfacePlace xi_;
  std::uint64_t stamp_ = 0, told_at_ = 0;
  haptic::TipSample last_;
  Vec3 force_ = Vec3::Zero();
  Vec3 rest_ = Vec3::Zero();
  std::vector<Vec3> borne_;  // by sample
};

}  // namespace palpate::bench
