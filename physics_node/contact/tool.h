#pragma once
// What the frame, the wire and the record ask of a tool, whatever it is.

#include <limits>
#include <span>

#include "common/message/messages.h"
#include "physics_node/contact/low_pass.h"
#include "physics_node/contact/norton_spring.h"
#include "physics_node/contact/tangent_estimate.h"
#include "physics_node/step/body_model.h"

namespace palpate::physics {

/// On the tool, in right-handed world axes; the moment is about the tool's set point. (EQUATIONS C-15)
struct Wrench {
  Vec3 force = Vec3::Zero();   // [N]
  Vec3 moment = Vec3::Zero();  // [N m]
};

class TwiceLowPassedWrench {
 public:
  void pass(const Wrench& now, double part) noexcept {
    force_.pass(now.force, part);
    moment_.pass(now.moment, part);
  }
  Wrench value() const noexcept { return {force_.value(), moment_.value()}; }

 private:
  TwiceLowPassed<Vec3> force_, moment_;
};

class Tool {
 public:
  virtual ~Tool() = default;

  /// Takes the newest state of the hand, or none where nothing fresh has come.
  /// @param dt  of the frame [s]
  virtual void take(const ToolState* state, double dt) noexcept = 0;
  /// Before the steps of a frame: looks for what it touches.
  virtual void find_contact(double t) noexcept = 0;
  /// Forces on masses of the touched body during the coming frame; a tool that is a body has none, it collides.
  virtual std::span<const NodalForce> forces() const noexcept { return {}; }
  virtual std::size_t touched_body() const noexcept { return 0; }  // meaningful while forces() is not empty
  virtual void reset() noexcept {}

  virtual void write_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) noexcept = 0;
  void write_wrench(ToolWrench& wrench, std::uint64_t frame, std::int64_t now_ns, double t) const noexcept;
  /// How the wrench changes with the pose of the hand; null: the hand feels planes instead.
  virtual const TangentEstimate* tangent() const noexcept { return nullptr; }
  /// The surface beside the tool, touched or not, which then takes the place of the tangent; null: none is known.
  virtual const NortonSpring* spring() const noexcept { return nullptr; }

  /// Of the spring between hand and tool [N/m]; infinite: the tool is where the hand has it.
  virtual double spring_to_hand() const noexcept { return std::numeric_limits<double>::infinity(); }

  virtual Vec3 tip() const noexcept = 0;                // where the hand holds it [m]
  virtual Wrench wrench() const noexcept = 0;           // low-passed
  virtual Wrench raw_wrench() const noexcept = 0;       // of the last frame alone
  virtual std::uint32_t contacts() const noexcept = 0;  // masses that carry or collide
  Vec3 force() const noexcept { return wrench().force; }

 protected:
  Tool(std::uint32_t index, const Vec3& set_point) : index_(index), set_point_(set_point) {}
  /// Remembers which state of the hand the next patch answers.
  void note(const ToolState& state) noexcept;
  /// A patch without facets that answers that state.
  void begin_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) const noexcept;

  std::uint32_t index_;
  Vec3 set_point_;

 private:
  std::uint64_t tick_ = 0;
  std::int64_t stamp_ns_ = 0;
  Array3 p_WT_{};  // of the hand then [m]
  Array4 q_WT_{1, 0, 0, 0};
};

}  // namespace palpate::physics
