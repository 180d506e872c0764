#pragma once
// A rigid needle: a straight shaft with a sharp tip that the hand leads into finite elements (needle_channel.h). It comes
// through a surface once it presses harder than that bears, goes on against the tissue's toughness, and rubs along its
// shaft; tissue holds it across. No mass is lost, and no element parts.
//
// The hand is told the force of the frame's last step and how its spring would change that.
// While physics hears nothing the needle stands, and after Hands::silence its spring lets go, within 200 ms.
// Limits: it is in one body at a time; it does not bend; its hub holds the tip back rather than the skin.

#include <memory>
#include <vector>

#include "physics_node/contact/hand_play.h"
#include "physics_node/contact/needle_channel.h"
#include "physics_node/contact/pressing_tool.h"

namespace palpate::physics {

class NeedleTool final : public PressingTool {
 public:
  /// @param bodies, touchable  all of a scene, which outlive this  @param period  of the hand's samples [s]
  /// @throws InputError  a body that a needle cannot go through, or a material that does not say how tough it is
  NeedleTool(const ToolSpec& tool, std::uint32_t index, const BodyModels& bodies,
             const std::vector<TouchableBody>& touchable, double period);

  void take(const ToolState* state, double dt) noexcept override;
  void find_contact(double t) noexcept override;
  void reset() noexcept override;

  std::span<const NodalForce> forces() const noexcept override {
    return presses_ ? std::span(now().channel.forces()) : std::span<const NodalForce>();
  }
  bool may_press() const noexcept override { return engaged_ && near_; }
  std::size_t touched_body() const noexcept override { return touched_; }
  bool follows_steps() const noexcept override { return true; }
  void begin_step() noexcept override;
  double press(double dt) noexcept override;
  CutWork cut_work() const noexcept override { return {.hand = done_.work, .released = 0}; }

  void write_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) noexcept override {
    begin_patch(patch, frame, now_ns);
  }
  void write_wrench(ToolWrench& wrench, std::uint64_t frame, std::int64_t now_ns,
                    double t) const noexcept override;

  Vec3 tip() const noexcept override { return hand_; }
  Wrench wrench() const noexcept override;
  Wrench raw_wrench() const noexcept override { return wrench(); }
  std::uint32_t contacts() const noexcept override {
    return static_cast<std::uint32_t>(now().channel.n_held());
  }
  Vec3 borne() const noexcept override { return -done_.force; }
  bool knows_tissue_work() const noexcept override { return true; }

 private:
  struct OfBody {
    TipEntry entry;
    NeedleChannel channel;
  };
  const OfBody& now() const noexcept { return *bodies_[touched_]; }
  OfBody& now() noexcept { return *bodies_[touched_]; }
  void let_go() noexcept;

  Eigen::Matrix3d attitude_;
  double stiffness_;
  HandPlay play_;
  std::vector<std::unique_ptr<OfBody>> bodies_;  // of each of the scene
  bool engaged_ = false, near_ = false, presses_ = false;
  double keep_ = 1;                    // of the spring, after silence
  double frame_dt_ = 0, elapsed_ = 0;  // of it [s]
  std::size_t touched_ = 0;
  Vec3 hand_ = Vec3::Zero(), along_ = -Vec3::UnitZ();
  NeedleOutcome done_;  // of the last step
};

}  // namespace palpate::physics
