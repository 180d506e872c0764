#include "physics_node/step/lattice/hexahedra.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "physics_node/step/lattice/hex_marks.h"
#include "physics_node/step/lattice/hex_meter.h"

namespace palpate::physics {

namespace {

HexKind kind_of(const Body& body, bool exact) {
  return {.law = body.solid->law,
          .physical = body.solid->hourglass == HourglassKind::physical,
          .damped = body.solid->beta > 0,
          .relaxing = !body.solid->relaxation.empty(),
          .exact = exact};
}

/// Calls visit(node, inverse mass) for all nodes that may move.
template <class Real, class Visit>
void for_each_moving_node(const Body& body, const LatticeState<Real>& state, const Visit& visit) {
  const auto look_at = [&](Index node) {
    if (const double w = body.inverse_mass[static_cast<std::size_t>(node)]; w > 0) visit(node, w);
  };
  if (!is_awake_in_parts(body)) return body.each_node(look_at);
  for (std::size_t r = 0; r < body.lattice.rows.size(); ++r) {
    const RowSegment& row = body.lattice.rows[r];
    for (Index i = row.first; state.row_state[r] != RowState::asleep && i < row.first + row.count; ++i)
      look_at(i);
  }
  body.each_copy(look_at);
}

}  // namespace

template <class Real>
Hexahedra<Real>::Hexahedra(const Body& body, const LatticeState<Real>& state)
    : grid_(make_hex_grid(body)),
      acting_(grid_),
      elastic_(grid_.runs.size()),
      least_J_(grid_.runs.size(), 1.0),
      stiffest_(grid_.runs.size()),
      passed_(body.lattice.rows.size()),
      kernel_(hex_kernel_here<Real>(kind_of(body, false))),
      exact_kernel_(hex_kernel_here<Real>(kind_of(body, true))) {
  const SolidElements& solid = *body.solid;
  const auto n = static_cast<std::size_t>(body.capacity());
  constants_ = hex_constants_of<Real>(body);
  at_rest_ = hex_bound_at_rest(body);
  std::size_t colour = 8 + n_remembered * solid.relaxation.size();  // after those of LatticeState
  stiffness_ = ZeroedArray<Real>(n, colour++);
  stiffness_.will_be_filled();
  for (const Index cell : body.lattice.masses)
    stiffness_[static_cast<std::size_t>(cell)] =
        static_cast<Real>(solid.stiffness[static_cast<std::size_t>(cell)]);
  double largest = solid.fast.cells.empty() ? solid.largest_stiffness : 0;
  if (!solid.fast.cells.empty()) {
    fast_ = std::make_unique<HexFast<Real>>(body, state, constants_, at_rest_);
    for (const Index cell : solid.fast.cells) stiffness_[static_cast<std::size_t>(cell)] = 0;
    for (const Index cell : body.lattice.masses)
      largest = std::max(largest, static_cast<double>(stiffness_[static_cast<std::size_t>(cell)]));
    for (auto& axis : pulled_) axis = ZeroedArray<Real>(n, colour++);
  }
  for (auto& axis : high_) axis = ZeroedArray<Real>(n, colour++);
  if (!solid.relaxation.empty())
    for (auto* lost : {&lost_before_, &lost_after_}) lost->resize(grid_.runs.size());
  if (body.cell_net() != nullptr) parted_ = std::make_unique<PartedCells<Real>>(body);
  if (any_breaks(body)) {
    failure_ = std::make_unique<HexFailure<Real>>(body, grid_, colour);
    colour += 2;
  }
  if (any_cells_yield(body)) {
    yield_ = std::make_unique<HexYield<Real>>(body, grid_, colour);
    colour += HexYield<Real>::n_colours;
  }
  if (solid.beta == 0) return;
  for (auto* three : {&rate_low_, &rate_high_, &rate_seen_})
    for (auto& axis : *three) axis = ZeroedArray<Real>(n, colour++);
  for (auto* one : {&power_, &damped_}) one->resize(grid_.runs.size());
  damper_weight_ = hex_damper_weight(at_rest_, solid.beta, fastest_of(body, at_rest_, largest));
}

template <class Real>
void Hexahedra<Real>::follow_rows(const Body& body, LatticeState<Real>& state) noexcept {
  if (row_changes_ == state.row_changes) return;
  row_changes_ = state.row_changes;
  // Beside runs of its row that act, one that rests is asked for nothing: it must hold nothing.
  for (std::size_t run = 0; run < state.acts.size(); ++run)
    if (state.acts[run] == 0 && acting_.acts(static_cast<Index>(run))) {
      elastic_[run] = stiffest_[run] = 0, least_J_[run] = 1;
      if (body.solid->beta != 0) power_[run] = damped_[run] = 0;
    }
  acting_.follow(grid_, state.row_state, state.acts);
  if (body.solid->beta == 0 || !state.acts.empty()) return;
  for (std::size_t run = 0; run < grid_.runs.size(); ++run)
    if (!acting_.acts(static_cast<Index>(run))) power_[run] = damped_[run] = 0;
}

template <class Real>
StepOutcome Hexahedra<Real>::step(const Body& body, LatticeState<Real>& state,
                                  const ExplicitStep& step) noexcept {
  follow_rows(body, state);
  for (const Index row : state.woken)
    passed_[static_cast<std::size_t>(row)] = state.ledger[static_cast<std::size_t>(row)].viscous;
  state.woken.clear();
  const std::int64_t broken = failure_ ? failure_->begin_step(state, acting_, step, stiffness_) : 0;
  if (yield_) yield_->begin_step(state, acting_, step, stiffness_, high_);
  if (fast_) fast_->begin(state);
  if (parted_) parted_->follow(body, grid_, state, stiffness_);
  HexContext<Real> m = {};
  ElementContext<Real>& masses = m.masses;
  masses.rows = body.lattice.rows.data();
  masses.row_state = state.row_state.data();
  masses.ledger = state.ledger.data();
  masses.inverse_mass = fast_ ? fast_->swept_inverse_mass() : state.inverse_mass.data();
  for (std::size_t a = 0; a < 3; ++a) {
    masses.u[a] = state.u[a].data();
    masses.v[a] = state.v[a].data();
    masses.f[a] = state.f[a].data();
    masses.g[a] = static_cast<Real>(step.gravity[static_cast<Eigen::Index>(a)]);
    m.high[a] = high_[a].data();
    m.pulled[a] = pulled_[a].data();
    m.rate_low[a] = rate_low_[a].data();
    m.rate_high[a] = rate_high_[a].data();
    m.rate_seen[a] = rate_seen_[a].data();
  }
  masses.dt = static_cast<Real>(step.dt);
  masses.dt_before = static_cast<Real>(state.dt_before);
  masses.begins = step.dt != state.dt_before;
  masses.watch = step.watch;
  m.runs = grid_.runs.data();
  m.runs_of_row = grid_.runs_of_row.data();
  m.acts = acting_.flags();
  m.stiffness = stiffness_.data();
  if (failure_) m.torn = failure_->torn(), m.damage = state.failed.damage.data();
  m.elastic = elastic_.data();
  m.power = power_.data();
  m.damped = damped_.data();
  m.least_J = least_J_.data();
  m.stiffest = stiffest_.data();
  m.passed = passed_.data();
  m.n_terms = body.solid->relaxation.size();
  std::ranges::copy(relaxation_terms<Real>(body, state.dt_before, step.dt), m.terms);
  for (std::size_t n = 0; n < state.remembered.size(); ++n)
    m.remembered[n / n_remembered][n % n_remembered] = state.remembered[n].data();
  m.lost_before = lost_before_.data();
  m.lost_after = lost_after_.data();
  m.up_y = grid_.up_y;
  m.up_z = grid_.up_z;
  m.beta = static_cast<Real>(body.solid->beta);
  m.damper_weight = static_cast<Real>(damper_weight_);
  m.dt_before = state.dt_before;
  m.books = state.dt_before > 0;
  m.rate_known = m.books && rate_known_;
  rate_known_ = step.struck && body.solid->beta != 0;  // else it has none
  m.k = constants_;
  const HexKernel<Real>& kernel = step.struck ? exact_kernel_ : kernel_;
  const bool any_parted = parted_ && parted_->any();
  if (any_parted) parted_->forces(body, state, m, kernel);
  const auto forces = [&](const HexLayer& l) { kernel.forces(m, l.first_run, l.last_run); };
  const auto move = [&](const HexLayer& l) { kernel.move(m, l.first_row, l.last_row); };
  const std::span layers = acting_.layers();
  const std::span slabs = acting_.slabs();
  const auto sweep = [&](std::size_t n) {
    for (std::size_t l = slabs[n].begin; l < slabs[n].end; ++l) {
      forces(layers[l]);
      if (l > slabs[n].begin) move(layers[l]);
    }
  };
  const auto move_lowest = [&](std::size_t n) { move(layers[slabs[n].begin]); };
  if (step.team != nullptr && step.threads > 1) {
    step.team->each(slabs.size(), step.threads, sweep);
    step.team->each(slabs.size(), step.threads, move_lowest);
  } else {
    for (const HexLayer& layer : layers) forces(layer), move(layer);
  }
  if (any_parted) parted_->move(body, state, m, kernel);
  if (fast_) fast_->step(state, step, pulled_, passed_);
  if (yield_) yield_->stiffen(acting_, stiffest_);
  if (yield_ && step.watch) yield_->watch(state);
  state.dt_before = step.dt;
  double stiffest = 0;
  for (const HexLayer& layer : layers)
    for (auto r = static_cast<std::size_t>(layer.first_run); r < static_cast<std::size_t>(layer.last_run);
         ++r) {
      if (acting_.acts(static_cast<Index>(r))) stiffest = std::max(stiffest, stiffest_[r]);
      if (step.watch) least_corner_J_ = std::min(least_corner_J_, least_J_[r]);
    }
  if (fast_) least_corner_J_ = std::min(least_corner_J_, fast_->least_corner_J());
  if (any_parted) {
    stiffest = std::max(stiffest, parted_->stiffest());
    least_corner_J_ = std::min(least_corner_J_, parted_->least_J());
  }
  return {.broken = broken, .stiffening = stiffest / at_rest_, .least_corner_J = least_corner_J_};
}

/// As the next step finds it: what a cell breaks by first never acts, however far a light mass has flown in the last step.
template <class Real>
HexBreaks Hexahedra<Real>::due_breaks(const LatticeState<Real>& state) const {
  return failure_ ? failure_->due(state) : HexBreaks{};
}

template <class Real>
Energies Hexahedra<Real>::energies(const Body& body, const LatticeState<Real>& state,
                                   const Vec3& gravity) const {
  const MeasuredHexahedra now =
      measure_hexahedra(body, grid_, state, CellsOf::rest, state.v, due_breaks(state).loss);
  Energies e;
  e.elastic = now.elastic;
  double power = 0;
  for_each_moving_node(body, state, [&](Index i, double w) {
    const Vec3 v = vector_of(state.v, i);
    e.gravitational -= gravity.dot(vector_of(state.u, i)) / w;
    if (state.fast.has(i)) return;
    e.kinetic += 0.5 / w * v.squaredNorm();
    power += v.dot(gravity) / w + v.dot(now.force[static_cast<std::size_t>(i)]);
  });
  e.between = e.kinetic + 0.5 * state.dt_before * power;
  if (fast_) fast_->add(body, grid_, state, gravity, now, e);
  return e;
}

template <class Real>
double Hexahedra<Real>::energy_now(const Body& body, const LatticeState<Real>& state) const noexcept {
  double energy = measure_elastic(body, grid_, state, failure_.get());
  for_each_moving_node(body, state,
                       [&](Index i, double w) { energy += 0.5 / w * vector_of(state.v, i).squaredNorm(); });
  return energy;
}

template <class Real>
Losses Hexahedra<Real>::due(const Body& body, const LatticeState<Real>& state) const {
  Losses due;
  const HexBreaks soon = due_breaks(state);
  due.broken = soon.energy;
  if ((body.solid->beta == 0 && body.solid->relaxation.empty()) || state.dt_before == 0) return due;
  const MeasuredHexahedra now = measure_hexahedra(body, grid_, state, CellsOf::rest, state.v, soon.loss);
  if (fast_) due.viscous = fast_->due(body, grid_, state, now);
  due.viscous += now.lost_before + std::accumulate(lost_after_.begin(), lost_after_.end(), 0.0);
  if (rate_known_)
    body.each_node([&](Index i) {
      due.viscous -= 0.5 * state.dt_before *
                     (now.force_of_rate[static_cast<std::size_t>(i)] + vector_of(rate_seen_, i))
                         .dot(vector_of(state.v, i));
    });
  for (std::size_t run = 0; run < power_.size() && !rate_known_; ++run)
    due.viscous += damper_loss(state.dt_before, power_[run], now.power[run]);
  if (parted_ && parted_->any() && !rate_known_)
    due.viscous += damper_loss(state.dt_before, parted_->power(), now.power.back());
  return due;
}

template <class Real>
BodyCounts Hexahedra<Real>::counts(const Body& body, const LatticeState<Real>& state) const {
  BodyCounts counts;
  counts.least_corner_J = least_corner_J_;
  const HexConstants<double> k = hex_constants_of<double>(body);
  for (const HexRun& run : grid_.runs)
    for (Index i = run.first; i < run.first + run.count; ++i)
      counts.elements += body.solid->stiffness[static_cast<std::size_t>(i)] > 0 ? 1 : 0;
  if (may_change_for_good(body))
    for (const Index node : body.nodes()) counts.yielded_masses += is_marked(body, state, node) ? 1 : 0;
  for_each_cell(body, grid_, state,
                [&](double, const std::array<Index, 8>&, std::size_t, Index) { ++counts.live_elements; });
  for_each_strained_cell(
      body, grid_, state, [&](double, const std::array<Index, 8>& corner, std::size_t, Index) {
        Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
        for (std::size_t a = 0; a < 8; ++a)
          for (std::size_t j = 0; j < 3; ++j)
            f.col(static_cast<Eigen::Index>(j)) +=
                ((a >> j & 1) != 0 ? k.per_4h[j] : -k.per_4h[j]) * vector_of(state.u, corner[a]);
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> squared(f.transpose() * f,
                                                                     Eigen::EigenvaluesOnly);
        counts.max_stretch = std::max(counts.max_stretch, std::sqrt(squared.eigenvalues()[2]));
      });
  return counts;
}

template class Hexahedra<float>;
template class Hexahedra<double>;

}  // namespace palpate::physics
