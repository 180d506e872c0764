#pragma once
// Forceps: jaws that hold what is between them while a button is pressed, so that a hand can pull tissue and let it go.
//
//   x = sum of w_n x_n,   F = K (h - o - x),   on mass n: w_n F,   w_n ~ m_n (1 - (d_n / R)^2)^2, sum 1
//   |F| <= grip: where it would be more, o follows until it is not;   |o - o_0| > R: out of the jaws
//
// h is the hand, K its spring, R the radius of the jaws, d_n how far a mass was from their middle when they closed, o_0
// what makes F zero then. With weights as the masses, a free lump between the jaws goes as one. F is that of the end of
// the step, solved with what it moves:
//
//   F = K (h - o - x) / (1 + K C),   C = dt^2 sum of w_n^2 / m_n
//
// Cut through, both sides of it stay between the jaws. Only one body is held, that of which most lies between the jaws.
// They do not push, and do not hold against turning.

#include <vector>

#include "physics_node/contact/hand_play.h"
#include "physics_node/contact/pressing_tool.h"

namespace palpate::physics {

class GripTool final : public PressingTool {
 public:
  static constexpr std::size_t most_held = 16384;  // masses

  /// @param bodies  all of a scene; outlive this  @param period  of the hand's samples [s]
  GripTool(const ToolSpec& tool, std::uint32_t index, const BodyModels& bodies, double period);

  void take(const ToolState* state, double dt) noexcept override;
  /// Closes and opens. Cost: a pass over all masses in the frame in which the jaws close; else none.
  void find_contact(double t) noexcept override;
  void reset() noexcept override;

  std::span<const NodalForce> forces() const noexcept override { return forces_; }
  bool may_press() const noexcept override { return !held_.empty(); }
  std::size_t touched_body() const noexcept override { return touched_; }
  bool follows_steps() const noexcept override { return true; }
  void begin_step() noexcept override;
  double press(double dt) noexcept override;

  void write_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) noexcept override {
    begin_patch(patch, frame, now_ns);
  }
  void write_wrench(ToolWrench& wrench, std::uint64_t frame, std::int64_t now_ns,
                    double t) const noexcept override;

  Vec3 tip() const noexcept override { return hand_; }
  Wrench wrench() const noexcept override;
  Wrench raw_wrench() const noexcept override { return wrench(); }
  std::uint32_t contacts() const noexcept override { return static_cast<std::uint32_t>(held_.size()); }
  Vec3 borne() const noexcept override { return -force_; }
  bool knows_tissue_work() const noexcept override { return true; }

 private:
  struct Held {
    Index node = 0;
    double share = 0;
  };
  void close() noexcept;
  void hold(const BodyModel& body) noexcept;
  void open() noexcept;
  void follow_cuts() noexcept;
  void find_mobility() noexcept;
  Vec3 held_place() const noexcept;

  double radius_, grip_, stiffness_;
  HandPlay play_;
  std::vector<const BodyModel*> bodies_;
  bool wants_ = false;   // the button is pressed
  bool closed_ = false;  // and has been since the jaws closed, whether they still hold something or not
  double keep_ = 1;      // of the spring, after silence
  double frame_dt_ = 0, elapsed_ = 0;
  std::size_t touched_ = 0;
  std::vector<Held> held_;
  double mobility_ = 0;  // sum of w^2 / m [1/kg]
  Vec3 offset_ = Vec3::Zero(), offset_at_first_ = Vec3::Zero();
  Vec3 hand_ = Vec3::Zero(), at_ = Vec3::Zero();  // at_: of what is held
  Vec3 v_before_ = Vec3::Zero();                  // of that, before the step
  Vec3 force_ = Vec3::Zero();                     // on tissue, of the last step
  std::vector<NodalForce> forces_;
};

}  // namespace palpate::physics
