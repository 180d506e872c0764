#pragma once
// One tool against all bodies: takes the hand's force into the tissue and offers the hand planes to rest on.
//
// The hand feels planes at 1 kHz (haptic_node); the tissue feels the force that the hand reports, low-passed, so that
// a late network cannot pump energy through the coupling. Each plane goes out as a Norton equivalent: where it would
// be without contact force, and how stiffly the tissue answers, K_o = F / d. For held elastic tissue the first is the
// surface at rest, so the tissue's own swinging drops out of the loop through the hand; for a body that is free or
// yields it is p + F / K_o. Either way the two meet where the tissue's own force equals the hand's.
//
// The papers' ways, for comparison: with raw_planes the plane goes out as it is deflected and as if it did not give, and the
// hand's force comes in unfiltered; with direct physics computes the force itself, K times the depth of the tip, and the
// hand holds it until the next one.
// Source: HAPTICS recipe; Astley & Hayward 1998 (Norton equivalents), Mendoza & Laugier 2001 (facets for the hand).

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/math/vec3.h"
#include "common/message/messages.h"
#include "common/scene/kinds.h"
#include "common/scene/scene_fwd.h"
#include "physics_node/contact/face_press.h"
#include "physics_node/contact/pressing_tool.h"
#include "physics_node/contact/secant_stiffness.h"
#include "physics_node/contact/tool_contact.h"

namespace palpate::physics {

struct TouchableBody {
  const NodeMotion* moving = nullptr;
  std::unique_ptr<Boundary> surface;
};

class PointTool final : public PressingTool {
 public:
  static constexpr std::size_t most_forces = 16384;

  PointTool(const ToolSpec& tool, std::uint32_t index, const std::vector<TouchableBody>& bodies,
            Integrator integrator = Integrator::symplectic_euler);

  /// Takes the newest state of the hand, or none where nothing fresh has come: then the force dies away.
  /// @param dt  of the frame [s]
  void take(const ToolState* state, double dt) noexcept override;

  /// Finds the body, the plane and the masses under the tool.
  void find_contact(double t) noexcept override;
  void reset() noexcept override;

  std::span<const NodalForce> forces() const noexcept override { return forces_; }
  bool may_press() const noexcept override { return !forces_.empty(); }
  std::size_t touched_body() const noexcept override { return touched_; }

  bool follows_steps() const noexcept override { return pressed_by_faces(); }
  void begin_step() noexcept override;
  double press(double dt) noexcept override;
  /// Of the sphere below the surface at rest, where it presses on faces; else 0 [m].
  double depth() const noexcept { return depth_; }

  void write_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) noexcept override;
  /// For the record: the hand feels planes.
  void write_wrench(ToolWrench& wrench, std::uint64_t frame, std::int64_t now_ns,
                    double t) const noexcept override {
    begin_wrench(wrench, this->wrench(), frame, now_ns, t);
  }

  Vec3 tip() const noexcept override { return tip_; }
  Wrench wrench() const noexcept override { return {force_, (tip_ - set_point_).cross(force_)}; }
  Wrench raw_wrench() const noexcept override { return {raw_force_, (tip_ - set_point_).cross(raw_force_)}; }
  std::uint32_t contacts() const noexcept override { return static_cast<std::uint32_t>(forces_.size()); }
  Vec3 borne() const noexcept override { return forces_.empty() ? Vec3(Vec3::Zero()) : force_; }
  bool knows_tissue_work() const noexcept override { return true; }

 private:
  /// By the force of the last frame on the masses under the tip and the displacement that it has brought about: their mean
  /// along the force, by the shares that they take of it. For the first touch a half space under a round patch of the tip's
  /// radius.
  void follow_stiffness() noexcept;
  /// ForceModel::direct: F = K d n under the tip. Where the tissue gives way within a frame, d is that of its end,
  ///   F := F + (K d n - F) / (1 + K C),   C = 1 / (K_o / s^2 + 1 / (dt^2 sum of s_i^2 / m_i)),
  /// C what the change of F moves it by: else a spring stiffer than the tissue would throw it to and fro, frame by frame.
  void compute_force(double t) noexcept;
  void find_compliance() noexcept;

  bool pressed_by_faces() const noexcept { return touched_ < faces_.size() && faces_[touched_].has_value(); }
  /// The sphere over the point where the hand's proxy is.
  void find_faces() noexcept;
  std::span<const MassShare> shares() const noexcept;

  ForceModel model_;
  double stiffness_;                             // of the hand's spring, K [N/m]
  std::vector<ToolContact> contacts_;            // with each body
  std::vector<std::optional<FacePress>> faces_;  // the same, where it presses on faces
  std::vector<std::uint32_t> candidates_;        // facets near it
  std::vector<MassShare> pressed_shares_;        // of the last step; EMPTY: pressed by no face
  ShapePose pose_;
  double depth_ = 0;
  std::vector<const NodeMotion*> moving_;
  bool seen_ = false;
  bool engaged_ = false;
  Vec3 tip_ = Vec3::Zero();
  Vec3 proxy_ = Vec3::Zero();
  Vec3 force_ = Vec3::Zero();      // on the tool, low-passed [N]
  Vec3 raw_force_ = Vec3::Zero();  // the same before that [N]
  Vec3 acted_ = Vec3::Zero();      // force_ of the last frame, which the tissue has answered by now [N]
  std::size_t touched_ = 0;
  double moving_share_ = 0;
  Vec3 indentation_ = Vec3::Zero();  // mean displacement of the masses under the tip [m]
  SecantStiffness K_o_;              // of the tissue under the tip, if it moved throughout
  double frame_dt_ = 0;
  Integrator integrator_;
  double compliance_ = 0;  // C of the masses under the tip; 0 where steps are short [m/N]
  Vec3 plane_velocity_ = Vec3::Zero();
  std::vector<NodalForce> forces_;
};

}  // namespace palpate::physics
