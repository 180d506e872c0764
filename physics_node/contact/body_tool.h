#pragma once
// A tool made of elements: the hand leads its handle, it bends and may break, and what it feels are its collisions.

#include "common/math/vec3.h"
#include "common/scene/scene_fwd.h"
#include "physics_node/contact/led_tool.h"

namespace palpate::physics {

class BodyTool final : public LedTool {
 public:
  /// @param body  index of the body that it is
  BodyTool(const ToolSpec& tool, std::uint32_t index, std::size_t body, NodeMotion& moving);

  void take(const ToolState* state, double dt) noexcept override;
  void find_contact(double) noexcept override {}
  void reset() noexcept override;

  void begin_step() noexcept override { handle_.note(moving_); }
  LeadWork lead(double done, double dt) noexcept override;
  /// What the body took from others in the frame. Force and moment are the impulses over the time, so that they do not
  /// depend on the step; then low-passed twice at low_pass_Hz.
  void end_frame(Collisions* collisions, double frame_seconds) noexcept override;
  bool is_near() const noexcept override { return false; }  // its masses collide: Collisions knows

  /// No facets: the hand feels the wrench.
  void write_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) noexcept override;
  void write_wrench(ToolWrench& wrench, std::uint64_t frame, std::int64_t now_ns,
                    double t) const noexcept override;

  std::size_t body() const { return body_; }
  Vec3 tip() const noexcept override { return to_.p; }
  /// The hand's work goes into its elements, and comes out of them in collisions.
  bool knows_tissue_work() const noexcept override { return false; }
  Wrench wrench() const noexcept override { return felt_.value(); }
  Wrench raw_wrench() const noexcept override { return raw_; }
  std::uint32_t contacts() const noexcept override { return contacts_; }

 private:
  std::size_t body_;
  NodeMotion& moving_;
  Handle handle_;
  double low_pass_Hz_;
  TangentEstimate tangent_;
  bool seen_ = false, engaged_ = false;
  Pose from_, to_;              // of the frame
  Vec3 clutch_ = Vec3::Zero();  // from the hand's tip to the tool's, when the hand first took it [m]
  Eigen::Quaterniond clutch_q_ = Eigen::Quaterniond::Identity();
  Wrench raw_;
  TwiceLowPassedWrench felt_;
  std::uint32_t contacts_ = 0;
};

}  // namespace palpate::physics
