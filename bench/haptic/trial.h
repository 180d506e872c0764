#pragma once
// A hand presses an object through a network, all in simulated time: device, hand and tissue in steps of 20 us, the
// renderer at 1 kHz, patches at their own rate over a link. The same case gives the same bits.

#include <cstdint>
#include <functional>
#include <optional>

#include "bench/haptic/energy_book.h"
#include "bench/haptic/link.h"
#include "bench/haptic/models.h"
#include "bench/haptic/plant.h"
#include "bench/haptic/pressed_tissue.h"
#include "bench/haptic/renderer.h"
#include "bench/haptic/tissue.h"
#include "bench/haptic/world_object.h"
#include "haptic_node/tissue/tissue_touch.h"
#include "physics_node/loop/hands.h"

namespace palpate::bench {

struct Case {
  DeviceModel device = device_models[0];
  HandSpring hand = hand_springs[0];
  ObjectModel object = object_models[0];
  const SlabModel* slab =
      nullptr;  // the real physics library instead of `object`, whose stiffness is then only aimed by
  const SpecimenModel* specimen = nullptr;  // of a mode that presses by motion, instead of `object`
  ModelError told;                          // there, what is told wrong
  double rate_Hz = 60;                      // of patches
  LinkModel link;                           // each way
  double clock_ahead = 0;                   // the clock of physics before the hand's [s]
  double stiffness = 500;
  double damping = 1;
  double friction = 0;      // of a point on a slab
  double torque_limit = 0;  // above 0 a stick is felt by its wrench, without torques by its plane [N m]
  RenderMode mode = RenderMode::local;
  std::optional<ForceModel> feels;  // of a slab, instead of what the mode would name
  int io_latency = 1;               // ticks from a sample to its force
  std::uint64_t seed = 1;
};

/// Where the hand wants to be, and how fast.
struct Aim {
  Vec3 q = Vec3::Zero();
  Vec3 q_dot = Vec3::Zero();
};
using Path = std::function<Aim(double t)>;

class Trial {
 public:
  static constexpr std::int64_t tick_ns = 1'000'000;
  static constexpr double lead_in =
      0.8;  // before t = 0: patches arrive, the controller arms, its ramp ends [s]

  /// The hand starts where the path does and waits there until t = 0.
  Trial(const Case& c, Path path);

  /// Ticks until t = `until` [s].
  /// @param each  after each tick
  void run(double until, const std::function<void()>& each = {});

  /// Turned off: no patches are sent any more.
  bool physics_alive = true;
  /// Force from outside on the handle [N].
  Vec3 push = Vec3::Zero();
  /// Physics begins anew: its count of frames does, too.
  void restart_physics() noexcept { frame_ = 0, physics_alive = true; }
  /// The hand follows its path exactly, whatever force it feels.
  bool kinematic = false;
  /// Called on each sample before the renderer sees it, on each patch before it is sent, on the object each 20 us.
  std::function<void(haptic::DeviceSample&)> spoil_sample;
  std::function<void(ContactPatch&, const Vec3& known_proxy)> alter_patch;
  std::function<void(Tissue&, double t)> move_object;
  /// The same on tissue that motion presses, in its own time, which is the hand's: that of the newest sample it has.
  std::function<void(Specimen&, double t)> alter_specimen;

  double t() const noexcept { return 1e-9 * static_cast<double>(now_ns_ - start_ns); }  // 0 after lead_in [s]
  const Plant& plant() const noexcept { return plant_; }
  const EnergyBook& energy() const noexcept { return energy_; }
  const haptic::Controller& controller() const noexcept { return controller_; }
  const Rendered& rendered() const noexcept { return rendered_; }
  const WorldObject* world() const noexcept { return world_.get(); }
  const Tissue& tissue() const noexcept { return tissue_; }
  /// Null in modes of another kind.
  const PressedTissue* pressed() const noexcept { return pressed_.get(); }
  const haptic::TissueTouch& touch() const noexcept { return touch_; }
  /// Largest force change in a tick; the same less K (v T + q), v the hand's speed then, q the resolution [N].
  double force_step() const noexcept { return force_step_; }
  double force_step_beyond_motion() const noexcept { return step_beyond_; }

 private:
  static constexpr std::int64_t start_ns = 1'000'000'000;
  struct HandReport {
    double force = 0;       // along z [N]
    Vec3 x = Vec3::Zero();  // [m]
    Vec3 proxy = Vec3::Zero();
    ToolState state{};  // of which the three above are parts
    std::shared_ptr<const HandSamples> samples{};
  };
  struct Answer {  // physics -> hand
    ContactPatch patch;
    double force = 0;  // computed by physics; RenderMode::direct holds it [N]
    ToolWrench wrench{};
    haptic::TissueAnswer tissue{};
  };

  void exchange();
  std::int64_t physics_clock_ns() const noexcept {
    return now_ns_ + static_cast<std::int64_t>(case_.clock_ahead * 1e9);
  }
  HandReport report();
  void answer_of_world();
  void answer_of_pressed();
  void render_pressed();
  void render();
  void book_force_step(const Vec3& force);
  void advance_plant();

  Case case_;
  Path path_;
  Plant plant_;
  Tissue tissue_;
  std::unique_ptr<WorldObject> world_;  // null: `tissue_`
  std::unique_ptr<PressedTissue> pressed_;
  haptic::ControllerSettings settings_;
  haptic::Controller controller_;
  haptic::MotionWatch motion_;  // of all modes but local: the same velocity as the controller's
  haptic::TissueTouch touch_;
  haptic::AnswerWatch<haptic::TissueAnswer> answers_{0};
  Link<HandReport> up_;
  Link<Answer> down_;
  EnergyBook energy_;
  Rendered rendered_;
  std::int64_t now_ns_;
  std::int64_t next_frame_ns_;
  std::uint64_t frame_ = 0;
  HandReport known_;         // to physics
  physics::Hands hands_{1};  // the same to the world, as long as it counts
  std::uint64_t tick_ = 0;
  std::optional<Answer> newest_;
  bool powered_ = false;
  std::array<Vec3, 3> in_flight_{Vec3::Zero(), Vec3::Zero(),
                                 Vec3::Zero()};  // forces on their way to the motors
  double force_step_ = 0, step_beyond_ = -1;
};

/// 1 N pressed from 20 mm above within 0.3 s, held to 4 s, slid 20 mm sideways to 5 s, retracted to 5.3 s.
Path press_path(const Case& c, double force = 1.0, double hold_until = 4.0);

}  // namespace palpate::bench
