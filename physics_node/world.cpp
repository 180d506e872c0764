#include "physics_node/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error/error.h"
#include "common/math/hash.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"
#include "common/scene/tool_spec.h"

namespace palpate::physics {
namespace {

constexpr int most_substeps = 256;  // of a frame in which something fast is near
constexpr int most_times = 8;       // as many as at rest, where those are many
// The same in frames of any length. Why: a frame of 1 ms that takes 8 steps at rest may take 256, and the damper of a cell that
// is turned inside out asks for that.
constexpr int most_stiffening = 32;

}  // namespace

bool World::is_implicit() const noexcept { return scene_.physics->integrator == Integrator::backward_euler; }

void World::restart_ledger() {
  for (auto& body : bodies_) body->restart_momentum();
  account_.restart(energies(), losses_and_due(), report_);
  watched_ = Booked(report_);
  cut_since_ = {};
  is_watched_ = false;
  guard_.begin();
  save_all(false);
  save_all(true);
}

EnergyLedger World::ledger() const { return account_.book(energies(), losses_and_due(), Booked(report_)); }

Energies World::energies() const {
  Energies sum = sum_energies(bodies_, scene_.gravity);
  for (const auto& connection : connections_) sum.elastic += connection->energy();
  return sum;
}

Losses World::losses_and_due() const {
  Losses sum = sum_losses_and_due(bodies_);
  for (const auto& connection : connections_) {
    sum.broken += connection->broken();
    sum.viscous += connection->viscous();
  }
  return sum;
}

EnergyLedger World::watched_ledger() const noexcept {
  Energies now;
  for (const auto& body : bodies_) {
    const Watch watch = body->watch();
    now.between += watch.between;
    now.elastic += watch.elastic;
    now.gravitational -= watch.fallen_before;
  }
  Losses lost = sum_losses(bodies_) - cut_since_;
  for (const auto& connection : connections_) {
    now.elastic += connection->watched();
    lost.broken += connection->broken();
    lost.viscous += connection->watched_viscous();
  }
  return account_.book(now, lost, watched_);
}

void World::book_work(double work) noexcept {
  if (!std::isfinite(work)) {
    guard_.note_unusable_work();
    return;
  }
  report_.tool_work += work;
  report_.tool_exchange += std::abs(work);
}

void World::follow_breaks() noexcept {
  if (!any_breaks_) {
    ++report_[Stage::yield_and_break].skipped;
    return;
  }
  const StageTimer timer(report_, Stage::yield_and_break);  // of the fragments; the rest is part of the pass
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    if (fragments_[b]) fragments_[b]->update(*bodies_[b]);
  for (auto& body : touchable_) body.surface->follow();
  for (auto& connection : connections_) connection->follow();
  if (collisions_) collisions_->follow_breaks();
}

void World::take(const StepOutcome& outcome) noexcept {
  report_.broken += outcome.broken;
  stiffening_ = std::max(stiffening_, outcome.stiffening);
  report_.least_corner_J = std::min(report_.least_corner_J, outcome.least_corner_J);
  report_.newton_iterations += outcome.newton_iterations;
  report_.cg_iterations += outcome.cg_iterations;
  if (!outcome.solved) ++report_.unsolved;
  book_work(outcome.work);
  report_.contact_lost += outcome.contact_lost;
}

void World::move_bodies(double dt, int left) noexcept {
  // Why: what a cut lets go of moves otherwise in the next step than in this, and a damper's power tells too much then.
  const bool parts = std::ranges::any_of(toolbox_.pressing, [this](const PressingTool* tool) {
    const Body& body = bodies_[tool->touched_body()]->body();
    return tool->follows_steps() && tool->may_press() && is_of_finite_elements(body) && any_cut(body);
  });
  ExplicitStep how{.dt = dt,
                   .gravity = scene_.gravity,
                   .team = team_.get(),
                   .threads = choice_.threads(),
                   .verlet = scene_.physics->integrator == Integrator::velocity_verlet,
                   .watch = left == 0 || looks_,
                   .exact = may_be_struck() || pressed_ || pressed_before_,
                   .struck = may_be_struck() || parts,
                   .planes = planes_,
                   .restitution = scene_.contact->restitution};
  stiffening_ = 1;
  gather();
  const Stage stage = is_implicit() ? Stage::integrate : Stage::element_forces;
  const std::int64_t before = report_[stage].total_ns;
  {
    const StageTimer timer(report_, stage);
    const bool joint = is_implicit() && near_;
    if (joint && !collisions_->solve(how, gathered_)) ++report_.unsolved;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      how.acts_for = strides_.acts_for(b, left, dt, how.struck);
      take(joint ? bodies_[b]->pending()->end(how, {gathered_[b], collisions_->contact(b)})
                 : bodies_[b]->advance(how, gathered_[b]));
    }
    if (joint) book_work(collisions_->driven_work());
  }
  choice_.took(report_[stage].total_ns - before);
  ++report_[is_implicit() ? Stage::element_forces : Stage::integrate].skipped;  // one pass does both
}

void World::touch(double dt, double done) noexcept {
  if (!near_ && planes_.empty() && toolbox_.led.empty()) {
    ++report_[Stage::contact_forces].skipped;
    return;
  }
  const StageTimer timer(report_, Stage::contact_forces);
  for (LedTool* tool : toolbox_.led) {
    const LeadWork led = tool->lead(done, dt);
    book_work(led.work);
    tool->book().tissue(led.work - led.lost);
    report_.contact_lost += led.lost;
  }
  if (near_ && !is_implicit()) {
    const CollisionWork work = collisions_->step(dt);
    book_work(work.driven);
    report_.contact_lost += work.lost;
  }
  if (is_implicit()) return;  // planes are in its equations, as is contact
  for (const Plane& plane : planes_)
    for (auto& body : bodies_)
      report_.contact_lost += body->bounce_off(plane, scene_.contact->restitution, dt).lost;
}

void World::step(double dt, double done, int left) noexcept {
  if (may_be_struck())
    for (auto& body : bodies_) body->remember_velocities();
  if (!is_implicit())
    for (LedTool* tool : toolbox_.led) tool->begin_step();
  for (PressingTool* tool : toolbox_.pressing) tool->begin_step();
  double work = book_tools(dt, false);
  for (auto& connection : connections_) connection->find_forces(dt);
  move_bodies(dt, left);
  if (left == 0) watched_ = Booked(report_), cut_since_ = {};
  for (auto& connection : connections_) connection->act(dt);
  work += press(dt);
  follow_breaks();
  touch(dt, done);
  if (work += book_tools(dt, true); work != 0) book_work(work);
  if (is_implicit()) book_solved(dt);
  ++report_.steps;
}

void World::save_all(bool good) noexcept {
  for (auto& body : bodies_) body->save(good);
  for (auto& connection : connections_) connection->save(good);
  account_.save(good, report_);
  guard_.saved();
}

void World::guard() noexcept {
  const StageTimer timer(report_, Stage::guard_finite);
  switch (guard_.look(bodies_, dt_, account_, report_)) {
    case Guard::Verdict::go_back:
      return recover();
    case Guard::Verdict::save:
      save_all(guard_.sound());
      break;
    case Guard::Verdict::sound:
      break;
  }
  is_watched_ = true;
}

void World::recover() noexcept {
  is_watched_ = false;
  cut_since_ = {};
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    bodies_[b]->restore();
    bodies_[b]->restart_momentum();
    if (fragments_[b]) fragments_[b]->update(*bodies_[b]);
    touchable_[b].surface->follow();
  }
  for (auto& connection : connections_) connection->restore();
  strides_.restart();
  if (collisions_) collisions_->restart();
  guard_.begin();
  ++report_.restored;
  account_.restore(report_);
  account_.write_off(ledger());
  if (!guard_.may_try_again()) return;
  n_substeps_ *= 2;
  dt_ = frame_dt_ / n_substeps_;
  ++report_.halved;
}

std::optional<std::string> World::stopped() const {
  if (!guard_.given_up()) return std::nullopt;
  return fmt::format(
      "body \"{}\" cannot be stepped: its energy grew or was not finite {} times although the step was "
      "halved to "
      "{:.3g} ms; look at its material, its first positions and what its tools do",
      bodies_[*guard_.given_up()]->body().name, report_.restored, 1e3 * dt_);
}

void World::take_tools(std::span<const std::optional<ToolState>> tools) noexcept {
  if (toolbox_.tools.empty()) {
    ++report_[Stage::take_tools].skipped;
    return;
  }
  const StageTimer timer(report_, Stage::take_tools);
  for (std::size_t n = 0; n < toolbox_.tools.size(); ++n) {
    const bool fresh = n < tools.size() && tools[n].has_value();
    toolbox_.tools[n]->take(fresh ? &*tools[n] : nullptr, frame_dt_);
  }
}

void World::find_contacts() noexcept {
  near_ = stick_near_ = false;
  pressed_before_ = pressed_;
  if (toolbox_.tools.empty() && !collisions_) {
    ++report_[Stage::find_contacts].skipped;
    return;
  }
  const StageTimer timer(report_, Stage::find_contacts);
  for (auto& body : touchable_) body.surface->update();
  for (auto& tool : toolbox_.tools) tool->find_contact(since_reset_);
  for (const LedTool* tool : toolbox_.led) stick_near_ = stick_near_ || tool->is_near();
  pressed_ = is_pressed();
  if (collisions_) near_ = collisions_->begin_frame(frame_dt_);
}

/// Of a whole frame, as things are now.
int World::substeps_of_frame() noexcept {
  // Why held: a step of another length is one that leapfrog does not keep energy through, and what swings stiffens twice a period.
  constexpr double held_s = 0.2;
  // Why not its root, as a frequency goes: a cell that is crushed is also where the step errs most, and with the root a fall onto
  // the floor at 3 m/s keeps its books to 2.5 %, with this to 1 %.
  const double most = std::max(most_substeps, most_times * n_substeps_);
  const double most_stiff = std::max(most_substeps, most_stiffening * n_substeps_);
  const double stiff = std::ceil(std::min(n_substeps_ * unrounded_ * stiffening_, most_stiff) - 1e-9);
  if (stiff >= held_substeps_ || since_reset_ >= held_until_)
    held_substeps_ = stiff, held_until_ = since_reset_ + held_s;
  double wanted = held_substeps_;
  if (near_) wanted = std::max(wanted, std::min(frame_dt_ / collisions_->wanted_step(), most));
  const int n = std::max(n_substeps_, static_cast<int>(std::ceil(wanted)));
  return n > n_substeps_ ? strides_.shared(n) : n;
}

/// n steps of dt come.
void World::plan_strides(int n, double dt) noexcept {
  // Why held: strides of another length are steps that leapfrog does not keep energy through, as above.
  const double stiffening = std::max(1.0, held_substeps_ / (n_substeps_ * unrounded_));
  strides_.divide(n, dt, std::ldexp(stiffening, guard_.recoveries()));
  for (const PressingTool* tool : toolbox_.pressing)
    for (std::size_t b = 0; tool->presses() && b < bodies_.size(); ++b)
      if (!tool->forces_on(b).empty()) strides_.act_in_every_step(b);
}

/// backward_euler solves for all masses at once: none of them can be left out.
bool World::may_sleep() const noexcept { return scene_.physics->sleep && !is_implicit(); }

bool World::any_asleep() const noexcept {
  return may_sleep() &&
         std::ranges::any_of(bodies_, [](const auto& body) { return body->sleeping_fraction() > 0; });
}

/// What a tool presses in the midst of a frame must not meet tissue that stands until the frame ends.
void World::wake_disturbed() noexcept {
  for (auto& body : bodies_) body->sleep_and_wake(0);
  unlooked_ = 0;
}

/// As many steps as the frame needs when it begins; where elements stiffen meanwhile, what is left of it is divided anew.
void World::divide_frame() noexcept {
  constexpr double rounding = 1e-9;
  int n_substeps = substeps_of_frame();
  double begun = 0;  // share of the frame before it was divided last
  unlooked_ = 0;
  plan_strides(n_substeps, frame_dt_ / n_substeps);
  for (int n = 1; n <= n_substeps; ++n) {
    const double share = begun + (1 - begun) * n / n_substeps, dt = (1 - begun) * frame_dt_ / n_substeps;
    unlooked_ += dt;
    looks_ = n < n_substeps && unlooked_ > look_every - 0.5 * dt && any_asleep();
    step(dt, share, n_substeps - n);
    if (looks_) wake_disturbed();
    const int wanted = static_cast<int>(std::ceil((1 - share) * substeps_of_frame() - rounding));
    if (wanted <= n_substeps - n) continue;
    begun = share;
    n_substeps = wanted;
    n = 0;
    plan_strides(n_substeps, (1 - begun) * frame_dt_ / n_substeps);
  }
}

void World::frame(std::span<const std::optional<ToolState>> tools) noexcept {
  if (has_stopped()) return;
  take_tools(tools);
  find_contacts();
  divide_frame();
  for (LedTool* tool : toolbox_.led) tool->end_frame(collisions_.get(), frame_dt_);
  for (auto& tool : toolbox_.tools) tool->book().frame(tool->borne());
  guard();
  if (!books_between_.empty()) follow_strokes();
  if (collisions_ && collisions_->bodies_are_near()) inside_->look_now_and_then();
  if (may_sleep())
    for (auto& body : bodies_) body->sleep_and_wake(frame_dt_);
  t_ += frame_dt_;
  since_reset_ += frame_dt_;
  ++report_.frames;
}

void World::reset() noexcept {
  for (auto& body : bodies_) body->reset();
  for (auto& connection : connections_) connection->reset();
  for (auto& tool : toolbox_.tools) tool->reset(), tool->book() = {};
  n_substeps_ = std::max(1, n_substeps_ >> guard_.recoveries());
  held_substeps_ = held_until_ = since_reset_ = 0;
  dt_ = frame_dt_ / n_substeps_;
  guard_.reset();
  start_anew();
}

std::uint64_t World::facets_left_out() const noexcept {
  std::uint64_t n = 0;
  for (const auto& body : touchable_) n += body.surface->left_out();
  return n;
}

std::uint64_t World::state_hash() const noexcept {
  std::uint64_t seed = hash_seed;
  for (const auto& body : bodies_) seed = body->hash(seed);
  for (const auto& connection : connections_) seed = connection->hash(seed);
  return seed;
}

}  // namespace palpate::physics
