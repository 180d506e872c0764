#pragma once
// A rigid shape that presses tissue by the hand's recorded motion, through the spring and damper that the hand feels: what the hand feels and what
// the tissue bears are one force, of one sample. The hand has no answer to wait for: it presses a copy of the tissue, which is told here, at
// the end of each frame, with the state that the motion has brought the tissue to.
//
//   copy: nine modes of the body (finite elements on a lattice; else none), the compliance of all else, the depth that both lie on, and how
//   the tissue flows (contact_flow.h)
//
// While physics hears nothing the hand stands, and after Hands::silence the spring lets go, within 200 ms.
// Bodies that it spans bear it together; the copy is of the one that bears most.
// It turns as the handle does. It is led by the same spring in all directions and goes where the pressure pushes it
// (tip_lean.h); it rubs with Coulomb's friction (tip_friction.h). A ball has its middle on the handle a radius from the tip,
// on the side where it has come to a surface; where it slides that follows the surface.
// Limits: its turns are known from state to state alone. Cells that break or yield leave the modes as they were: the depth that they lie on takes it up.

#include <memory>
#include <optional>
#include <vector>

#include "common/math/growing_contact.h"
#include "physics_node/contact/contact_flow.h"
#include "physics_node/contact/face_press.h"
#include "physics_node/contact/hand_play.h"
#include "physics_node/contact/held_shape.h"
#include "physics_node/contact/point_tool.h"
#include "physics_node/contact/pressing_tool.h"
#include "physics_node/contact/residual_compliance.h"
#include "physics_node/contact/tip_friction.h"
#include "physics_node/contact/tool_contact.h"
#include "physics_node/reduced/body_modes.h"

namespace palpate::physics {

class TissueTool final : public PressingTool {
 public:
  /// @param period  of the hand's samples [s]
  /// @param frame   how long it is; facets are sought as far as a hand may come within it [s]
  /// @throws InputError  a body whose cells do not follow a shape of this size
  TissueTool(const ToolSpec& tool, std::uint32_t index, const std::vector<TouchableBody>& bodies,
             double period, double frame, Integrator integrator, const Crew& crew = {});

  void take(const ToolState* state, double dt) noexcept override;
  void find_contact(double t) noexcept override;
  void reset() noexcept override;

  std::span<const NodalForce> forces() const noexcept override { return forces_on(touched_); }
  std::span<const NodalForce> forces_on(std::size_t body) const noexcept override {
    return body < bodies_.size() ? faces_.forces(body) : std::span<const NodalForce>();
  }
  bool presses() const noexcept override { return faces_.n_forces() > 0; }
  bool may_press() const noexcept override { return found_ && engaged_; }
  std::size_t touched_body() const noexcept override { return touched_; }
  bool follows_steps() const noexcept override { return true; }
  void begin_step() noexcept override;
  double press(double dt) noexcept override;

  void write_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) noexcept override;
  /// For the record.
  void write_wrench(ToolWrench& wrench, std::uint64_t frame, std::int64_t now_ns,
                    double t) const noexcept override {
    begin_wrench(wrench, this->wrench(), frame, now_ns, t);
  }

  Vec3 tip() const noexcept override { return hand_.x; }
  Wrench wrench() const noexcept override { return {borne(), (tip() + arm_ - set_point_).cross(borne())}; }
  Wrench raw_wrench() const noexcept override { return wrench(); }
  std::uint32_t contacts() const noexcept override { return static_cast<std::uint32_t>(faces_.n_forces()); }
  Vec3 borne() const noexcept override { return presses() ? Vec3(-on_tissue_) : Vec3(Vec3::Zero()); }
  bool knows_tissue_work() const noexcept override { return true; }
  /// Of the hand, that borne() belongs to.
  std::uint64_t sample() const noexcept { return play_.sample(); }

 private:
  using Modal = std::array<double, max_tissue_modes>;
  using Shapes = std::array<Vec3, max_tissue_modes>;  // psi
  struct Touchable {
    const NodeMotion* moving;
    ToolContact contact;
    BodyModes modes;
    ToolContact::Nearest nearest{};  // of the last look
  };
  /// At the end of a frame.
  struct Told {
    Vec3 tip = Vec3::Zero();  // where it lies [m]
    double force = 0;         // along the normal [N]
    double stays = 0;         // of it: ContactFlow [N]
    Modal q{}, w{};
  };
  void let_go() noexcept;
  void flow(double dt) noexcept;
  void place(double share) noexcept;
  void face(const Vec3& tip) noexcept;
  void roll(double slid) noexcept;
  std::optional<Vec3> look(const Vec3& tip, double t) noexcept;
  bool looks(std::size_t body) const noexcept;
  std::size_t bears_most() const noexcept;
  void find_guide(const LocalPlane& plane) noexcept;
  Vec3 tip_now() const noexcept;
  /// Of the hand, since the last answer [s].
  double since_told() const noexcept {
    return static_cast<double>(play_.sample() - told_at_) * play_.period();
  }
  Shapes find_shapes(const Touchable& body) const noexcept;
  void take_offsets(const Touchable& body, const Shapes& psi, Modal& q) noexcept;
  void follow_compliance(const Touchable& body, const Shapes& psi, const GrowingContact& law,
                         const Told& now) noexcept;
  GrowingContact closed_form(const Touchable& body) const noexcept;
  double lasting_stiffness(const Touchable& body, std::size_t mode) const noexcept;
  double modal_compliance(const Touchable& body, const Shapes& psi) const noexcept;
  void tell_flow(const Touchable& body, const Shapes& psi, TouchedTissue& tissue) const noexcept;
  void follow_first_touch(const Touchable& body, const Shapes& psi, const GrowingContact& law,
                          const Vec3& way, double gives) noexcept;
  double stiffer_than_deep(const Touchable& body, double depth) const noexcept;
  double share_beside_modes(const Touchable& body, const Shapes& psi,
                            const GrowingContact& law) const noexcept;
  void tell(TouchedTissue& tissue) noexcept;

  HeldShape held_;
  Integrator integrator_;
  HandPlay play_;
  std::vector<std::unique_ptr<Touchable>> bodies_;
  FacePress faces_;                               // of all
  std::vector<std::vector<std::uint32_t>> near_;  // of each body, the facets near the tool
  PressBy spring_;
  bool engaged_ = false;
  double keep_ = 1;                    // of the spring, after silence
  double frame_dt_ = 0, elapsed_ = 0;  // of it [s]
  HandPlay::Moment hand_;              // now
  double depth_ = 0;                   // of the tip below the hand; out of contact of the surface [m]
  double force_ = 0;                   // along the normal [N]
  Vec3 on_tissue_ = Vec3::Zero();      // F [N]
  TipFriction rubbing_;
  Vec3 arm_ = Vec3::Zero();  // from the tip to where it bears; 0 of a sphere [m]
  std::size_t touched_ = 0;
  bool found_ = false;     // a surface, in this frame
  bool knows_up_ = false;  // up_ is of the frame before
  bool outside_ = false;   // it touches, or has been outside in each frame since it was
  ShapePose pose_;
  Vec3 guide_ = Vec3::UnitZ();  // normal of the faces around
  double flat_ = 0;             // of these: LocalPlane
  Vec3 up_ = Vec3::UnitZ();     // of a ball, from its tip to its middle, unit
  std::uint64_t told_at_ = 0;   // the sample of the last answer
  /// Of every body, whether it has as many or not. Why: a hand that touches takes no other number.
  std::uint32_t told_modes_ = 0, told_branches_ = 0;
  Told told_;
  Modal offsets_{};           // o
  Vec3 rest_ = Vec3::Zero();  // that was told, low-passed [m]
  ResidualCompliance residual_;
  ContactFlow flow_;
  Vec3 pressed_at_ = Vec3::Zero();  // where it flows [m]
  FirstTouch first_;
  std::size_t learns_of_ = max_bodies;  // the body that it learns of
  struct Moment {
    double force = 0;         // along the normal [N]
    double stays = 0;         // of it [N]
    Vec3 tip = Vec3::Zero();  // [m]
  };
  Moment hardest_;               // of this frame
  std::optional<Vec3> free_at_;  // where what touches now last lay on a free surface [m]
};

}  // namespace palpate::physics
