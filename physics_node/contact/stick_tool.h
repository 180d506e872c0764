#pragma once
// A rigid stick: the hand has it, tissue gives way. Masses that it meets are carried by its surface without friction until
// they leave it by themselves; what they press is what the hand feels.
//
//   B = A - L R e_z   (EQUATIONS C-34),     x := x + dt dv n,  J = m dv,     F = -sum J / T,   M = -sum (x - A) x J / T
//
// Source: Takada & Abe et al. (P2, P3): collided vertices moved to the stick, their forces summed over the list. Deviation:
// the test is a swept capsule (C-33) and the side by which a mass leaves is the one it came from (C-35).
//
// Between hand and stick is the spring K that is between hand and proxy of every tool: the stick is where the proxy is,
// p = x + F / K. The hand is offered one plane to rest on, a Norton equivalent (point_tool.h), and the same with what turns the
// stick (norton_spring.h) as it feels it through that spring: at x = p - F / K,   K_s = K_t - K_t E (K + E^T K_t E)^-1 E^T K_t,
// E the three ways. Where no surface is found, the tangent of the contacts stands in (tangent_estimate.h).
// With force_model = "direct" there is no such spring: the stick is where the hand is.

#include <vector>

#include "common/math/vec3.h"
#include "common/scene/scene_fwd.h"
#include "physics_node/contact/led_tool.h"
#include "physics_node/contact/stick_faces.h"
#include "physics_node/contact/stick_spring.h"

namespace palpate::physics {

class StickTool final : public LedTool {
 public:
  /// @param bodies, surfaces  of each body; outlive the tool
  StickTool(const ToolSpec& tool, std::uint32_t index, const BodyModels& bodies,
            const std::vector<TouchableBody>& surfaces);

  void take(const ToolState* state, double dt) noexcept override;
  /// Lists the masses near the stick; the list is used again until the stick or tissue may have left it.
  void find_contact(double t) noexcept override;
  void reset() noexcept override;

  void begin_step() noexcept override {}  // it remembers where it was
  LeadWork lead(double done, double dt) noexcept override;
  void end_frame(Collisions* collisions, double frame_seconds) noexcept override;
  bool is_near() const noexcept override { return n_near_ > 0; }

  /// The plane under the stick as two triangles about the tip. A device that gives torques feels the spring instead.
  void write_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) noexcept override;
  /// The spring of the surface beside the stick, touched or not, else the tangent; both through the hand's spring.
  void write_wrench(ToolWrench& wrench, std::uint64_t frame, std::int64_t now_ns,
                    double t) const noexcept override;

  Vec3 tip() const noexcept override { return to_.p; }
  bool knows_tissue_work() const noexcept override { return true; }
  Wrench wrench() const noexcept override { return felt_.value(); }
  Wrench raw_wrench() const noexcept override { return raw_; }
  std::uint32_t contacts() const noexcept override { return contacts_; }  // collided masses in the last frame
  Stick stick_at(const Pose& pose) const noexcept;
  const TangentEstimate& tangent() const noexcept { return tangent_; }

 private:
  /// Masses of one body near the stick; arrays of one length.
  struct Near {
    NodeMotion* moving = nullptr;
    std::vector<std::uint32_t> all;  // 0, 1, 2 ...
    std::vector<Index> cell;
    std::vector<Vec3> rest, x, v, v_move;
    std::vector<double> mass;
    PushBatch pushes;
    std::size_t n = 0;
  };
  void list(Near& near) noexcept;
  LeadWork lead_body(Near& near, const Stick& before, const Stick& now, double dt) noexcept;
  /// The surface beside it, touched or not; null: none is known.
  const NortonSpring* spring() const noexcept { return surface_.spring() ? &*surface_.spring() : nullptr; }
  Pose pose_at(double done) const noexcept {
    return {from_.p + done * (to_.p - from_.p), from_.q.slerp(done, to_.q)};
  }

  double length_, radius_;
  Eigen::Quaterniond attitude_;
  double low_pass_Hz_;
  double hand_spring_;  // to the hand, K [N/m]; infinite: none
  bool seen_ = false;
  Pose from_, to_;   // of the frame
  double done_ = 0;  // of the frame, so far
  std::vector<Near> near_;
  std::vector<StickFaces> faces_;  // of each body
  std::size_t n_near_ = 0;
  StickSearch search_;
  StickSpring surface_;
  ContactSum sum_;  // of the frame, about the tip at its end
  Wrench raw_;
  TwiceLowPassedWrench felt_;
  TangentEstimate tangent_;
  std::uint32_t contacts_ = 0;
};

}  // namespace palpate::physics
