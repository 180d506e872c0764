#pragma once
// A scalpel: a rigid edge that the hand leads through bodies of springs or finite elements, surfaces and the strands of
// connections, and what it passes is cut (blade_edge.h, blade_strands.h). No mass is lost.
// What the hand pays is the tissue's toughness times the area that has been opened.
//
// Scissors: the same, with an edge as long as their mouth that stands across it where the two blades cross, and goes on
// as these close (scissor_blades.h). What pushes tissue out of the mouth, friction on the blades takes as far as it
// can: the hand feels the rest, and the handles all of it. When they stop all that they have passed is cut.
//
// The hand is told the force of the frame's last step and how its spring would change that: of two ways, as the edge slides along itself.
// While physics hears nothing the blade stands, and after Hands::silence its spring lets go, within 200 ms.
// Limits: it cuts one body at a time, that which most of its edge is near; flanks do not rub, what lies
// beside the blade does not press on it, and bodies that it cannot cut it passes unfelt, and counts that.

#include <memory>
#include <optional>
#include <vector>

#include "physics_node/contact/blade_edge.h"
#include "physics_node/contact/blade_inside.h"
#include "physics_node/contact/hand_play.h"
#include "physics_node/contact/pressing_tool.h"
#include "physics_node/contact/scissor_blades.h"

namespace palpate::physics {

/// What the scene calls it.
const char* blade_name(const ToolSpec& tool) noexcept;

class BladeTool final : public PressingTool {
 public:
  /// @param bodies, touchable, connections  all of a scene, which outlive this
  /// @param period  of the hand's samples [s]
  /// @throws InputError  bodies of which it can cut none, and nothing that joins them; or a material that does not say
  /// how tough it is
  BladeTool(const ToolSpec& tool, std::uint32_t index, const BodyModels& bodies,
            const std::vector<TouchableBody>& touchable, const Connections& connections, double period);

  void take(const ToolState* state, double dt) noexcept override;
  void find_contact(double t) noexcept override;
  void reset() noexcept override;

  std::span<const NodalForce> forces() const noexcept override { return forces_; }
  bool may_press() const noexcept override { return bites() && (near_ || strands_.is_near()); }
  std::size_t touched_body() const noexcept override { return near_ ? bodies_[touched_].number : 0; }
  bool follows_steps() const noexcept override { return true; }
  void begin_step() noexcept override;
  double press(double dt) noexcept override;
  std::span<const EdgeGone> cuts() const noexcept override { return cuts_; }
  std::span<const StrandPush> pushes(std::size_t connection) const noexcept override {
    return strands_.pushes(connection);
  }
  CutWork cut_work() const noexcept override { return {done_.work, done_.released}; }
  void take_released(double energy) noexcept override { blade_.take_released(energy); }

  void write_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) noexcept override {
    begin_patch(patch, frame, now_ns);
  }
  void write_wrench(ToolWrench& wrench, std::uint64_t frame, std::int64_t now_ns,
                    double t) const noexcept override;

  Vec3 tip() const noexcept override { return hand_; }
  Wrench wrench() const noexcept override;
  Wrench raw_wrench() const noexcept override { return wrench(); }
  std::uint32_t contacts() const noexcept override {
    return static_cast<std::uint32_t>(forces_.size() + strands_.n_pushes());
  }
  Vec3 borne() const noexcept override { return -done_.force; }
  bool knows_tissue_work() const noexcept override { return true; }

 private:
  struct OfBody {
    std::size_t number = 0;
    BladeLinks links;
  };
  /// Does it cut what it comes to? Scissors only as they close.
  bool cuts_now() const noexcept { return engaged_ && (!scissors_ || scissors_->closing() || stops_); }
  /// Or is still where it has cut, from where they go on if they close again.
  bool bites() const noexcept { return cuts_now() || (engaged_ && blade_.bites()); }
  BladeFrame frame_at(double share) const noexcept;
  Vec3 tip_at(double share) const noexcept { return play_.at(share).x; }
  void let_go() noexcept { blade_.let_go(), strands_.let_go(), stops_ = false; }
  void book_handles(double led, double lag) noexcept;

  Eigen::Matrix3d attitude_;
  double edge_, stiffness_;
  std::optional<ScissorBlades> scissors_;
  HandPlay play_;
  std::vector<OfBody> bodies_;  // that it cuts
  BladeLinks nothing_;          // where none of them is near
  BladeStrands strands_;
  BladeInside inside_;
  BladeEdge blade_;
  bool engaged_ = false, near_ = false;
  bool stops_ = false;                 // scissors have closed until now
  double keep_ = 1;                    // of the spring, after silence
  double frame_dt_ = 0, elapsed_ = 0;  // of it [s]
  std::size_t touched_ = 0;            // of bodies_
  Vec3 hand_ = Vec3::Zero();
  BladeFrame frame_;
  BladeOutcome done_;  // of the last step
  std::vector<NodalForce> forces_;
  std::vector<EdgeGone> cuts_;
};

}  // namespace palpate::physics
