#pragma once
// What the frame, the wire and the record ask of every tool. How it acts on tissue is asked of one that presses it with
// forces (pressing_tool.h) or of one that leads masses itself (led_tool.h): nothing here has a default.

#include "common/message/messages.h"
#include "physics_node/contact/low_pass.h"
#include "physics_node/contact/touch_book.h"
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
  /// Before the steps of a frame: looks for what it touches. @param t  since the world began or was reset [s]
  virtual void find_contact(double t) noexcept = 0;
  /// With the bodies back at the start: as one that has not met its hand yet.
  virtual void reset() noexcept = 0;

  virtual void write_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) noexcept = 0;
  virtual void write_wrench(ToolWrench& wrench, std::uint64_t frame, std::int64_t now_ns,
                            double t) const noexcept = 0;

  virtual Vec3 tip() const noexcept = 0;                // where the hand holds it [m]
  virtual Wrench wrench() const noexcept = 0;           // low-passed
  virtual Wrench raw_wrench() const noexcept = 0;       // of the last frame alone
  virtual std::uint32_t contacts() const noexcept = 0;  // masses that carry or collide
  Vec3 force() const noexcept { return wrench().force; }
  /// By what it touches, in the frame that has ended [N].
  virtual Vec3 borne() const noexcept = 0;
  /// Can its work on tissue be told from that on its own elements?
  virtual bool knows_tissue_work() const noexcept = 0;

  TouchBook& book() noexcept { return book_; }
  const TouchBook& book() const noexcept { return book_; }

 protected:
  Tool(std::uint32_t index, const Vec3& set_point) : index_(index), set_point_(set_point) {}
  /// Remembers which state of the hand the next patch answers, and books it.
  void note(const ToolState& state) noexcept;
  /// A patch without facets that answers that state.
  void begin_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) const noexcept;
  /// A wrench without stiffness that answers it.
  void begin_wrench(ToolWrench& wrench, const Wrench& now, std::uint64_t frame, std::int64_t now_ns,
                    double t) const noexcept;

  std::uint32_t index_;
  Vec3 set_point_;

 private:
  TouchBook book_;
  std::uint64_t tick_ = 0;
  std::int64_t stamp_ns_ = 0;
  Array3 p_WT_{};  // of the hand then [m]
  Array4 q_WT_{1, 0, 0, 0};
};

}  // namespace palpate::physics
