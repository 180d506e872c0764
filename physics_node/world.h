#pragma once
// All bodies of a scene and the frame that moves them. Free of DDS, files and clocks: the same object runs in
// palpate-physics, in `palpate simulate`, in tests and in benchmarks.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/message/messages.h"
#include "common/scene/scene.h"
#include "physics_node/collision/collisions.h"
#include "physics_node/collision/inside_others.h"
#include "physics_node/connection/connection.h"
#include "physics_node/contact/make_tools.h"
#include "physics_node/fragments/fragments.h"
#include "physics_node/guard.h"
#include "physics_node/step/step_report.h"
#include "physics_node/step/strides.h"
#include "physics_node/step/team.h"
#include "physics_node/step/team_choice.h"

namespace palpate::physics {

class World {
 public:
  /// Loads all bodies. @param spare_cores  that the team leaves to others where there are more; a scene that gives `threads`
  /// gets these. @throws InputError
  explicit World(const Scene& scene, int spare_cores = 0);

  /// One frame of 1 / frame_Hz simulated seconds.
  /// @param tools  newest state per tool, absent where nothing fresh has come (n_tools)
  /// Contract: allocates, locks, prints and throws nothing.
  void frame(std::span<const std::optional<ToolState>> tools) noexcept;

  void reset() noexcept;
  /// Tissue and the books of tools as they were when the last stroke of a blade began to cut, to the bit; all tools let go. A stroke
  /// goes on until no blade has met anything for 0.2 s. Once: the stroke before is not known.
  /// @return false: nothing has been cut since the start, a reset or the last time
  bool undo() noexcept;

  const Scene& scene() const { return scene_; }
  double t() const { return t_; }
  double frame_seconds() const { return frame_dt_; }
  double step_seconds() const { return dt_; }
  int threads() const { return choice_.most(); }  // at most; the same bits with any number
  const TeamChoice& team_choice() const { return choice_; }
  double stable_step_seconds() const { return stable_dt_; }
  std::size_t n_bodies() const { return bodies_.size(); }
  const BodyModel& body(std::size_t b) const { return *bodies_[b]; }
  BodyModel& body(std::size_t b) { return *bodies_[b]; }  // to start a test or a benchmark from a given state
  const Surface& surface_as_loaded(std::size_t b) const { return touchable_[b].surface->surface(); }
  /// What has come off; null for a body that cannot break.
  const Fragments* fragments(std::size_t b) const { return fragments_[b].get(); }
  Tool& tool(std::size_t n) { return *toolbox_.tools[n]; }
  const Tool& tool(std::size_t n) const { return *toolbox_.tools[n]; }
  std::size_t n_tools() const { return toolbox_.tools.size(); }
  /// Contact between bodies and fragments; null where nothing could ever touch.
  const Collisions* collisions() const { return collisions_.get(); }
  /// Which bodies have gone into each other, as far as the frames have looked; null where a single body cannot break.
  const InsideOthers* inside_others() const { return inside_.get(); }
  std::size_t n_connections() const noexcept { return connections_.size(); }
  const Connection& connection(std::size_t n) const { return *connections_[n]; }
  /// Facets that opened and that tools do not feel, because there was no room for them.
  std::uint64_t facets_left_out() const noexcept;
  StepReport& report() { return report_; }
  const StepReport& report() const { return report_; }
  std::uint64_t state_hash() const noexcept;
  /// Steps in which the elements of a body have acted: all, or fewer where it needs fewer than the others.
  std::int64_t steps_of_body(std::size_t b) const noexcept { return strides_.acted(b); }
  /// Where the energy went; a pass over all elements.
  EnergyLedger ledger() const;
  /// The same as the kernels saw it when the last step of the frame began, before tools, contact and floor acted. A sum over
  /// rows.
  EnergyLedger watched_ledger() const noexcept;
  /// Has a frame ended as it should since the ledger began? Else nobody has watched yet, or what was watched was thrown away.
  bool is_watched() const noexcept { return is_watched_; }
  /// Begins the ledger, and what the guard measures growth by, from the present state; for who has placed masses.
  void restart_ledger();
  /// Why the scene was given up, if it was: then frames no longer move anything, and the state is the last good one.
  std::optional<std::string> stopped() const;
  bool has_stopped() const noexcept { return guard_.given_up().has_value(); }
  /// What a person should know about this scene: one line each.
  const std::vector<std::string>& remarks() const { return remarks_; }
  void add_remarks(std::vector<std::string> more) {
    remarks_.insert(remarks_.end(), more.begin(), more.end());
  }

 private:
  /// Strands between bodies, which shorten the stable step. @throws InputError: one joins nothing
  void join_bodies();
  /// Which bodies need fewer steps than the world, and in how many steps of a frame they then fit.
  void settle_strides();
  Energies energies() const;
  Losses losses_and_due() const;
  /// Which integrator it is, where the scene leaves that open, and its stable step; bodies hear of stiff cells that step alone.
  Integrator settle_steps(std::vector<Body>& built);
  /// @param left  steps of the frame after this one; the last is watched
  void step(double dt, double done, int left) noexcept;
  void move_bodies(double dt, int left) noexcept;
  bool may_sleep() const noexcept;
  bool any_asleep() const noexcept;
  void wake_disturbed() noexcept;
  void plan_strides(int n, double dt) noexcept;
  void touch(double dt, double done) noexcept;
  double book_tools(double dt, bool begun) noexcept;
  void book_solved(double dt) noexcept;
  double press(double dt) noexcept;
  double cut(PressingTool& tool) noexcept;
  void begin_stroke() noexcept;
  void follow_strokes() noexcept;
  void note_books(std::vector<TouchBook>& books) const noexcept;
  /// Bodies have been set somewhere else.
  void start_anew() noexcept;
  double power(const PressingTool& tool) const noexcept;
  void take_tools(std::span<const std::optional<ToolState>> tools) noexcept;
  void find_contacts() noexcept;
  void divide_frame() noexcept;
  int substeps_of_frame() noexcept;
  bool is_implicit() const noexcept;
  /// May a velocity jump in this frame? Then contact wants to know what it was.
  bool may_be_struck() const noexcept { return near_ || stick_near_ || !planes_.empty(); }
  bool is_pressed() const noexcept;  // by a tool that gives forces
  void gather() noexcept;            // forces of all tools
  void take(const StepOutcome& outcome) noexcept;
  void guard() noexcept;
  void save_all(bool good) noexcept;
  void book_work(double work) noexcept;
  void follow_breaks() noexcept;
  /// Back to the last good state, with half the step; gives up after the step has been halved too often.
  void recover() noexcept;

  Scene scene_;
  BodyModels bodies_;
  std::vector<std::unique_ptr<Fragments>> fragments_;  // of each body that may break, null elsewhere
  std::vector<TouchableBody> touchable_;
  Connections connections_;
  Toolbox toolbox_;
  bool stick_near_ = false;  // one of those that lead may touch in this frame
  std::unique_ptr<Collisions> collisions_;
  std::unique_ptr<InsideOthers> inside_;
  std::vector<Plane> planes_;                      // floor and walls
  std::vector<std::vector<NodalForce>> gathered_;  // forces of all tools, by body
  StepReport report_;
  EnergyAccount account_;
  Booked watched_;    // by tools and contact before the last step of the frame
  Losses cut_since_;  // what cuts have made bodies book after that
  /// Why: as often as frames of 1 kHz look, at their end, and a wake-up is a row further [s].
  static constexpr double look_every = 1e-3;
  double unlooked_ = 0;  // in this frame, since rows at rest were looked at [s]
  bool looks_ = false;   // after this step
  bool is_watched_ = false;
  std::vector<std::string> remarks_;
  double t_ = 0;            // [s]
  double since_reset_ = 0;  // the same, as it was when all began: rounded alike, it decides alike [s]
  double frame_dt_ = 0;
  double dt_ = 0;  // of a step; frame_dt_ / n_substeps_
  double stable_dt_ = 0;
  std::vector<double> stable_alone_,
      unshaken_;  // of each body: stable by itself; for which its elements may act beside its strands [s]
  int n_substeps_ = 1;
  double unrounded_ = 1;  // as many steps as would do at rest, over n_substeps_
  double held_substeps_ = 0,
         held_until_ = 0;  // what stiffening asked for, and until when since_reset_ is [s]
  double stiffening_ = 1;  // largest of the bodies in the last step: see StepOutcome
  Strides strides_;
  std::unique_ptr<Team> team_;  // null: one thread
  TeamChoice choice_ = TeamChoice::always(1);
  bool any_breaks_ = false;
  bool near_ = false;                              // bodies or fragments may touch in this frame
  bool pressed_ = false, pressed_before_ = false;  // by a tool, in this frame and in the one before
  double unmet_ = 0;                               // for how long no blade has met anything [s]
  bool in_stroke_ = false, can_undo_ = false;  // a blade is in what it cuts; what was before is remembered
  std::vector<TouchBook> books_between_,
      books_before_;  // of tools, when no blade last met anything; and before the stroke; EMPTY: none cuts
  Guard guard_;
};

}  // namespace palpate::physics
