#include "physics_node/step/lattice/lattice_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "physics_node/step/good_state.h"
#include "physics_node/step/lattice/awake_region.h"
#include "physics_node/step/lattice/bounce.h"
#include "physics_node/step/lattice/cut_elements.h"
#include "physics_node/step/lattice/hex_marks.h"
#include "physics_node/step/lattice/hexahedra.h"
#include "physics_node/step/lattice/implicit_step.h"
#include "physics_node/step/lattice/marked_state.h"
#include "physics_node/step/lattice/measure.h"
#include "physics_node/step/lattice/node_kicks.h"
#include "physics_node/step/lattice/part_cells.h"
#include "physics_node/step/lattice/saved_state.h"
#include "physics_node/step/lattice/sleep.h"
#include "physics_node/step/lattice/springs.h"
#include "physics_node/step/lattice/state.h"
#include "physics_node/step/multigrid/implicit_hexahedra.h"

namespace palpate::physics {
namespace {

template <class Real>
std::unique_ptr<LatticeElements<Real>> make_elements(const Body& body, const LatticeState<Real>& state) {
  if (body.solid) return std::make_unique<Hexahedra<Real>>(body, state);
  return std::make_unique<Springs<Real>>();
}

template <class Real>
std::unique_ptr<ImplicitSolver<Real>> make_implicit(const Body& body) {
  if (body.solid) return std::make_unique<ImplicitHexahedra<Real>>(body);
  return std::make_unique<ImplicitStep<Real>>(body);
}

template <class Real>
class LatticeBody final : public BodyModel, private PendingStep {
 public:
  LatticeBody(Body body, Integrator integrator, std::vector<Vec3> start)
      : BodyModel(body_),
        body_(std::move(body)),
        start_(std::move(start)),
        state_(body_),
        elements_(make_elements<Real>(body_, state_)),
        sleep_(body_),
        saved_({body_, state_}, {body_, state_}) {
    NodeMotion::show({state_.u[0].data(), state_.u[1].data(), state_.u[2].data()},
                     {state_.v[0].data(), state_.v[1].data(), state_.v[2].data()});
    Topology::show({body_.lattice, {state_.mask.data(), state_.mask.size()}, body_.cell_net()});
    if (integrator == Integrator::velocity_verlet)
      for (auto& axis : state_.v_half) axis = ZeroedArray<Real>(capacity());
    if (integrator == Integrator::backward_euler) implicit_ = make_implicit<Real>(body_);
    if (is_awake_in_parts(body_)) {
      region_ = std::make_unique<AwakeRegion<Real>>(body_);
      NodeMotion::show(region_->parts());
    }
    if (body_.may_be_cut) marked_.emplace(body_, state_);
    begin();
  }

  StepOutcome advance(const ExplicitStep& step, std::span<const NodalForce> forces) noexcept override {
    if (!implicit_) return integrate(step, forces);
    const StepForces all{forces, {}};
    solve(step, all);
    return end(step, all);
  }
  PendingStep* pending() noexcept override { return implicit_ ? this : nullptr; }

  double power(std::span<const NodalForce> forces) const noexcept override {
    double sum = 0;
    for (const auto& nodal : forces)
      if (!stands(nodal.cell)) sum += nodal.force.dot(vector_of(moving_velocity(state_), nodal.cell));
    return sum;
  }

  void kick(std::span<const NodalForce> forces, double dt) noexcept override {
    if (region_) region_->wake(body_, state_, forces);
    for (const auto& nodal : forces) {
      if (stands(nodal.cell)) continue;
      sleep_.wake_cell(body_, state_, body_.origin(nodal.cell));
      kick_node(body_, state_, nodal, dt, momentum_);
    }
  }

  void push(std::span<const NodalPush> pushes, double dt) noexcept override {
    if (implicit_) dt = 0;
    if (region_) region_->wake(body_, state_, pushes, dt);
    for (const NodalPush& one : pushes) {
      if (stands(one.cell)) continue;
      sleep_.wake_cell(body_, state_, body_.origin(one.cell));
      push_node(body_, state_, one, dt, v_before_, momentum_);
    }
  }

  void prepare_for(Disturbance from_outside) override {
    if (from_outside == Disturbance::impulses) make_room(v_before_);
    if (!implicit_ && any_springs_lose(body_)) make_room(state_.v_seen);
  }
  void remember_velocities() noexcept override {
    if (v_before_[0].size() == 0) return;
    const Three<Real>& moving = moving_velocity(state_);
    each_row([&](std::size_t r) {
      const RowSegment& row = body_.lattice.rows[r];
      for (std::size_t a = 0; a < 3; ++a)
        std::copy_n(moving[a].data() + row.first, row.count, v_before_[a].data() + row.first);
    });
    body_.each_copy([&](Index copy) {
      for (std::size_t a = 0; a < 3; ++a)
        v_before_[a][static_cast<std::size_t>(copy)] = moving[a][static_cast<std::size_t>(copy)];
    });
  }

  Bounces bounce_off(const Plane& plane, double e, double dt) noexcept override {
    if (implicit_ || region_) return {};  // its step has ended on the right side; or it stands
    return bounce(body_, state_, moving_velocity(state_), v_before_, plane, e, dt, momentum_);
  }

  void sleep_and_wake(double seconds) noexcept override {
    if (!region_) return sleep_.look(body_, state_, seconds);
    if (seconds > 0) region_->look(body_, state_, seconds);
  }
  void wake_all() noexcept override {
    if (!region_) sleep_.wake_all(body_, state_);
  }
  double sleeping_fraction() const noexcept override {
    const Index n = body_.lattice.n_masses();
    const Index asleep = region_ ? n - region_->moving_nodes() : sleep_.sleeping_masses();
    return static_cast<double>(asleep) / static_cast<double>(n);
  }

  bool sleeps(Index node) const noexcept override { return is_asleep(body_, state_, parts(), node); }
  bool is_finite() const noexcept override {
    // NaN and infinity survive multiplication by zero, so one sum tells of all.
    Real sum = 0;
    each_row([&](std::size_t r) {
      if (state_.row_state[r] == RowState::asleep) return;
      const auto first = static_cast<std::size_t>(body_.lattice.rows[r].first);
      const std::size_t last = first + static_cast<std::size_t>(body_.lattice.rows[r].count);
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t i = first; i < last; ++i) sum += Real(0) * (state_.u[a][i] + state_.v[a][i]);
    });
    body_.each_copy([&](Index copy) {
      sum += Real(0) * static_cast<Real>((vector_of(state_.u, copy) + vector_of(state_.v, copy)).sum());
    });
    return sum == Real(0);
  }

  Watch watch() const noexcept override {
    Watch sum;
    each_row([&](std::size_t r) { add_watched(state_.ledger[r], sum); });
    if (body_.cell_net() != nullptr) add_watched(state_.ledger.back(), sum);
    if (region_) sum.elastic += region_->rim().watched_elastic();
    sum.speed = std::sqrt(sum.speed);
    return sum;
  }

  /// Where it is awake in parts nothing is saved: it goes back to rest.
  void save(bool good) noexcept override {
    if (region_) return region_->save(good, losses());
    saved_.next(good).take(body_, state_);
  }
  void restore() noexcept override {
    if (region_) {
      region_->go_back(body_, state_);
      state_.forget_last_step();
    } else {
      sleep_.wake_all(body_, state_);
      saved_.good().bring_back(body_, state_);
    }
    if (body_.cell_net() != nullptr)
      body_.cell_net()->begin();  // what has parted stays so, and all know of it
    save(false);
  }

  void reset() noexcept override {
    sleep_.wake_all(body_, state_);
    state_.reset(body_);
    if (body_.cell_net() != nullptr) rejoin_cells(body_, state_);
    unknown_for_ = 2;
    begin();
  }

  void place(Index cell, const Vec3& displacement, const Vec3& velocity) noexcept override {
    const auto c = static_cast<std::size_t>(cell);
    if (region_) region_->wake(body_, state_, std::array{NodalForce{cell, Vec3::UnitX()}});
    if (stands(cell)) return;
    sleep_.wake_cell(body_, state_, body_.origin(cell));
    for (std::size_t a = 0; a < 3; ++a) {
      state_.u[a][c] = static_cast<Real>(displacement[static_cast<Eigen::Index>(a)]);
      state_.v[a][c] = static_cast<Real>(velocity[static_cast<Eigen::Index>(a)]);
      if (state_.v_half[a].size() > 0) state_.v_half[a][c] = state_.v[a][c];
    }
    state_.forget_last_step();
  }

  void read(std::span<const std::uint32_t> which, std::span<const Index> cells, std::span<const Vec3> rest,
            double dt, std::span<Vec3> x, std::span<Vec3> v, std::span<Vec3> v_move) const noexcept override {
    const Three<Real>& moving = moving_velocity(state_);
    const bool known = v_before_[0].size() > 0 && !implicit_;
    for (const std::uint32_t n : which) {
      v_move[n] = pending_dt_ > 0 ? implicit_->velocity(cells[n], pending_dt_) : vector_of(moving, cells[n]);
      const bool moved = known && !stands(cells[n]);
      v[n] = moved ? Vec3(0.5 * (v_move[n] + vector_of(v_before_, cells[n]))) : v_move[n];
      x[n] = rest[n] + vector_of(state_.u, cells[n]);
      if (!implicit_) x[n] -= dt * v_move[n];
    }
  }
  TopologyEvents events() const noexcept override {
    if (const CellNet* net = body_.cell_net()) return {{}, {}, net->splits(), unknown_for_ > 0};
    return {state_.fresh.list, state_.fresh.cells, {}, any_breaks(body_) && state_.fresh.overflow};
  }
  std::int64_t breaks() const noexcept override {
    return body_.cell_net() != nullptr ? body_.cell_net()->n_open() : state_.breaks;
  }
  std::int64_t cut(std::span<const EdgeGone> elements) noexcept override {
    if (!any_cut(body_)) return 0;
    CellNet* net = body_.cell_net();
    if (net == nullptr) return cut_elements(body_, state_, sleep_, elements);
    const std::size_t known = net->splits().size();
    const std::int64_t opened = part_cells(body_, state_, elements, [this](const NodeSplit& split) {
      if (!region_) saved_.each([&](SavedState<Real>& saved) { saved.split(split); });
      copy_value(v_before_, split);
    });
    if (region_) region_->follow_cut(body_, state_, net->splits().subspan(known));
    return opened;
  }
  void mark() noexcept override {
    if (marked_) marked_->take(body_, state_);
  }
  void return_to_mark() noexcept override {
    if (!marked_) return;
    reset();
    if (body_.cell_net() != nullptr) cut(marked_->open());
    marked_->bring_back(body_, state_);
    restart_momentum();
    for (const bool good : {false, true}) save(good);
  }
  void conditions(std::span<const Index> cells, std::span<Condition> out) const noexcept override {
    for (std::size_t n = 0; n < cells.size(); ++n)
      out[n] = condition_of(body_, state_, adjacency(), cells[n]);
  }

  Energies energies(const Vec3& gravity) const override {
    Energies sum = elements_->energies(body_, state_, region_ ? Vec3(Vec3::Zero()) : gravity);
    if (region_) region_->rim().add(state_, sum);
    return sum;
  }
  double energy_now() const noexcept override {
    return elements_->energy_now(body_, state_) + (region_ ? region_->rim().elastic(state_) : 0);
  }
  Losses due() const override {
    Losses sum = elements_->due(body_, state_);
    if (region_) sum.viscous += region_->rim().due(state_);
    return sum;
  }
  Losses losses() const override {
    Losses sum = region_ ? region_->losses(body_, state_) : measure_losses(state_);
    if (body_.cell_net() != nullptr) sum.breaks = breaks();
    return sum;
  }
  Momenta momenta() const override { return measure_momenta(body_, state_, state_.v).momenta; }
  bool touched() const noexcept override { return momentum_.hits() > 0; }
  void restart_momentum() noexcept override {
    momentum_.restart(measure_momenta(body_, state_, moving_velocity(state_)));
  }
  MomentumBalance momentum_balance() const override {
    return momentum_.balance(measure_momenta(body_, state_, moving_velocity(state_)).momenta);
  }
  BodyCounts counts() const override {
    BodyCounts counts = elements_->counts(body_, state_);
    counts.shape_rms = measure_shape_rms(body_, state_);
    return counts;
  }
  std::uint64_t hash(std::uint64_t seed) const noexcept override { return hash_of(body_, state_, seed); }

 private:
  /// With a state as made or reset.
  void begin() noexcept {
    if (region_) region_->clear(body_, state_);
    state_.start_from(body_, start_);
    momentum_ = {};
    restart_momentum();
    for (const bool good : {false, true}) save(good);
  }

  StepOutcome integrate(const ExplicitStep& step, std::span<const NodalForce> forces) noexcept {
    if (region_) return integrate_region(step, forces);
    if (step.verlet && step.dt != state_.dt_before) begin_leapfrog();
    begin_cuts();
    momentum_.step(step.gravity, step.verlet && !state_.v_half_known ? 0.5 * step.dt : step.dt, step.dt);
    const StepOutcome outcome = elements_->step(body_, state_, step);  // sleeping rows are skipped
    // What was balanced by a cell is so no more.
    for (const CellGone& gone : state_.fresh.cells)
      for (const Index corner : gone.corners) sleep_.wake_cell(body_, state_, corner);
    kick(forces, step.dt);
    return outcome;
  }

  /// Without gravity: its weight is balanced.
  StepOutcome integrate_region(ExplicitStep step, std::span<const NodalForce> forces) noexcept {
    step.gravity = Vec3::Zero();
    begin_cuts();
    momentum_.step(step.gravity, step.dt, step.dt);
    StepOutcome outcome;
    if (region_->moving_nodes() > 0) {
      region_->rim().act(state_, step.dt, step.watch);
      outcome = elements_->step(body_, state_, step);
    } else {
      state_.forget_last_step();  // whoever wakes has had none
    }
    kick(forces, step.dt);
    return outcome;
  }

  /// A new list of what a cut splits.
  void begin_cuts() noexcept {
    if (body_.cell_net() != nullptr) body_.cell_net()->begin(), unknown_for_ = std::max(0, unknown_for_ - 1);
  }

  /// Held, or asleep where it is awake in parts and too far from where it is pressed.
  bool stands(Index cell) const noexcept {
    return state_.inverse_mass[static_cast<std::size_t>(cell)] == 0 || (region_ && !region_->moves(cell));
  }

  /// Calls visit(row) for all rows that may be awake.
  template <class Visit>
  void each_row(const Visit& visit) const noexcept {
    if (region_)
      for (const Index row : region_->rows()) visit(static_cast<std::size_t>(row));
    else
      for (std::size_t r = 0; r < body_.lattice.rows.size(); ++r) visit(r);
  }

  void solve(const ExplicitStep& step, const StepForces& forces) noexcept override {
    implicit_->solve(body_, state_, step, forces, pending_dt_ > 0);
    pending_dt_ = step.dt;
  }

  StepOutcome end(const ExplicitStep& step, const StepForces& forces) noexcept override {
    for (const auto& list : {forces.tools, forces.contact})
      for (const NodalForce& nodal : list)
        momentum_.hit(step.dt * nodal.force, position(nodal.cell));  // before it moves on with it
    momentum_.step(step.gravity, step.dt, step.dt);
    const ImplicitReport report = implicit_->finish(body_, state_, step, forces, momentum_);
    pending_dt_ = 0;
    // Commits yield and break where the step ended, and lets the ledger watch.
    ExplicitStep look = step;
    look.dt = 0;
    const StepOutcome looked = elements_->step(body_, state_, look);
    StepOutcome outcome{.broken = looked.broken, .solved = report.converged, .work = report.work};
    outcome.contact_lost = report.contact_lost, outcome.least_corner_J = looked.least_corner_J;
    outcome.newton_iterations = report.newton_iterations, outcome.cg_iterations = report.cg_iterations;
    return outcome;
  }

  /// With another step the velocity half a step ago is another one: the step starts from the one now. Its momentum is another
  /// too, by what acted meanwhile.
  void begin_leapfrog() noexcept {
    const Momenta before = measure_momenta(body_, state_.u, state_.v_half).momenta;
    const Momenta after = measure_momenta(body_, state_.u, state_.v).momenta;
    momentum_.shift(after, before);
    state_.v_half_known = false;
  }

  void make_room(Three<Real>& v) const {
    for (auto& axis : v)
      if (axis.size() == 0) axis = ZeroedArray<Real>(capacity());
  }
  std::size_t capacity() const { return static_cast<std::size_t>(body_.capacity()); }

  Body body_;
  std::vector<Vec3> start_;  // displacements of its nodes; EMPTY: none [m]
  LatticeState<Real> state_;
  std::unique_ptr<LatticeElements<Real>> elements_;
  Three<Real> v_before_;  // that moved the masses in the step before the last; only for contact
  Sleep sleep_;
  MomentumAccount momentum_;
  GoodState<SavedState<Real>> saved_;
  std::optional<MarkedState<Real>> marked_;         // only of a body that may be cut
  std::unique_ptr<ImplicitSolver<Real>> implicit_;  // only for backward_euler
  std::unique_ptr<AwakeRegion<Real>> region_;       // only of a body that is awake in parts
  int unknown_for_ = 2;    // steps: after a reset, at once and after the next, events of cuts tell nothing
  double pending_dt_ = 0;  // of a step that is solved and not over; 0: none [s]
};

}  // namespace

std::unique_ptr<BodyModel> make_lattice_body(Body body, Precision precision, Integrator integrator,
                                             std::vector<Vec3> start) {
  if (precision == Precision::single_)
    return std::make_unique<LatticeBody<float>>(std::move(body), integrator, std::move(start));
  return std::make_unique<LatticeBody<double>>(std::move(body), integrator, std::move(start));
}

}  // namespace palpate::physics
