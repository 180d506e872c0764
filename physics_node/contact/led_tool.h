#pragma once
// A tool that moves tissue by being where the hand has it, in every step: what the hand feels are its contacts.

#include "physics_node/collision/collisions.h"
#include "physics_node/contact/handle.h"
#include "physics_node/contact/tangent_estimate.h"
#include "physics_node/contact/tool.h"

namespace palpate::physics {

/// In a step: by the hand, and what contact made warm.
struct LeadWork {
  double work = 0;  // [J]
  double lost = 0;  // [J]
};

class LedTool : public Tool {
 public:
  /// Before an explicit step moves anything.
  virtual void begin_step() noexcept = 0;
  /// A step of dt that ends after `done` of the frame, in (0, 1], after the elements have moved everything.
  virtual LeadWork lead(double done, double dt) noexcept = 0;
  /// At the end of a frame. @param collisions  of all bodies; null: nothing could touch
  virtual void end_frame(Collisions* collisions, double frame_seconds) noexcept = 0;
  /// In every step it is where the hand has it: its contacts of the frame are what is borne.
  Vec3 borne() const noexcept final { return raw_wrench().force; }
  /// Something may be touched in this frame by the tool itself, which then wants velocities remembered.
  virtual bool is_near() const noexcept = 0;

 protected:
  using Tool::Tool;
  /// As the estimate has it, with the moment about the set point.
  Wrench felt_by(const TangentEstimate& tangent) const noexcept {
    const Vec3 force = tangent.wrench().head<3>();
    return {force, tangent.wrench().tail<3>() + (tip() - set_point_).cross(force)};
  }
};

}  // namespace palpate::physics
