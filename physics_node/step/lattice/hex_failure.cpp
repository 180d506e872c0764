#include "physics_node/step/lattice/hex_failure.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "physics_node/material/stable_neo_hookean.h"
#include "physics_node/step/fem/hex_tension.h"
#include "physics_node/step/lattice/hex_meter.h"
#include "physics_node/step/lattice/hex_yield.h"

namespace palpate::physics {
namespace {

using One = Scalar<double>;

/// Bits of the cells around a mass in which an element in this direction lies, or runs along a face or an edge.
Mask cells_along(const Vec3i& direction) {
  Mask cells = 0;
  for (unsigned octant = 0; octant < 8; ++octant) {
    bool holds = true;
    for (int axis = 0; axis < 3; ++axis)
      if (direction[axis] != 0) holds = holds && (direction[axis] > 0) == ((octant >> axis & 1) != 0);
    if (holds) cells |= cell_bit(octant);
  }
  return cells;
}

/// N: the direction of the largest stretch, at rest.
Vec3 stretched_along(const Tensor<double>& h) {
  const Tensor<double> strain = stretching<One>(h);
  Eigen::Matrix3d c_i;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c_i(i, j) = strain[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solved;
  solved.computeDirect(c_i);
  return solved.eigenvectors().col(2);
}

}  // namespace

template <class Real>
struct HexFailure<Real>::Cell {
  Index cell = -1;
  Corners<One> w{};           // displacements of its corners [m]
  Tensor<double> h{};         // gradient of the displacement at its centre
  Plastic<double> plastic{};  // all zero where nothing yields
  // By weigh():
  double energy = 0;  // as if it were whole [J]
  double middle = 0;  // the same in the middle of the step that led here [J]
};

template <class Real>
HexFailure<Real>::HexFailure(const Body& body, const HexGrid& grid, std::size_t colour)
    : body_(body),
      grid_(grid),
      k_(hex_constants_of<double>(body)),
      stretch_(static_cast<std::size_t>(body.capacity()), colour),
      tension_(static_cast<std::size_t>(body.capacity()), colour + 1),
      found_(grid.runs.size(), Strained::far),
      torn_(grid.runs.size(), 0),
      shares_(body),
      kernel_(hex_strain_kernel_here<Real>()) {
  const SolidElements& solid = *body.solid;
  for (std::size_t m = 0; m < solid.failures.size(); ++m)
    limits_.push_back(break_limit(solid.failures[m].ratio,
                                  solid.yields.empty() ? Yielding{} : solid.yields[m], k_.mu, k_.lambda));
  std::vector<Vec3i> half = half_directions(body.lattice.kind);
  for (std::size_t d = 0; d < half.size(); ++d) {
    sharing_[d] = cells_along(half[d]);
    sharing_[d + half.size()] = cells_along(-half[d]);
  }
  breaking_.reserve(body.lattice.masses.size());
  losses_.reserve(body.lattice.masses.size());
}

template <class Real>
TensionLimit<double> HexFailure<Real>::limit_of(Index cell) const noexcept {
  return limits_[body_.solid->material_of[static_cast<std::size_t>(cell)]];
}

/// The state was set from outside: what has begun and what is gone may be other cells.
template <class Real>
void HexFailure<Real>::follow(const LatticeState<Real>& state, ZeroedArray<Real>& stiffness) noexcept {
  if (replacements_ == state.replacements) return;
  replacements_ = state.replacements;
  breaking_.clear();
  for (std::size_t r = 0; r < grid_.runs.size(); ++r) {
    const HexRun& run = grid_.runs[r];
    found_[r] = Strained::near;
    torn_[r] = 0;
    for (Index cell = run.first; cell < run.first + run.count; ++cell) {
      const auto c = static_cast<std::size_t>(cell);
      if (body_.solid->stiffness[c] <= 0) continue;
      const bool begun = state.failed.reached[c] > 0;
      stretch_[c] = begun ? Real(0) : static_cast<Real>(limit_of(cell).stretch);
      // Of what has yielded tension is less than strain tells there: whoever is pulled at all is looked at.
      tension_[c] = static_cast<Real>(any_cells_yield(body_) ? 0.0 : limit_of(cell).tension);
      stiffness[c] = static_cast<Real>(body_.solid->stiffness[c]) * (1 - state.failed.damage[c]);
      if (!begun) continue;
      torn_[r] = 1;
      if (state.failed.damage[c] < 1) breaking_.push_back(cell);
    }
  }
}

template <class Real>
void HexFailure<Real>::look(const LatticeState<Real>& state, const HexActing& acting,
                            const ExplicitStep& step) noexcept {
  HexStrain<Real> m = {};
  m.runs = grid_.runs.data();
  m.acts = acting.flags();
  for (std::size_t a = 0; a < 3; ++a) {
    m.u[a] = state.u[a].data();
    m.per_4h[a] = static_cast<Real>(k_.per_4h[a]);
  }
  m.stretch = stretch_.data();
  m.tension = tension_.data();
  m.up_y = grid_.up_y, m.up_z = grid_.up_z;
  m.of_volume = static_cast<Real>((k_.lambda + k_.mu) / k_.mu);
  m.found = found_.data();
  m.only_near = !step.watch;
  if (m.only_near && std::ranges::all_of(found_, [](Strained s) { return s == Strained::far; })) return;
  const std::span layers = acting.layers();
  const std::span slabs = acting.slabs();
  const auto look_at_slab = [&](std::size_t n) {
    for (std::size_t l = slabs[n].begin; l < slabs[n].end; ++l)
      kernel_(m, layers[l].first_run, layers[l].last_run);
  };
  if (step.team != nullptr && step.threads > 1)
    step.team->each(slabs.size(), step.threads, look_at_slab);
  else
    for (std::size_t n = 0; n < slabs.size(); ++n) look_at_slab(n);
}

template <class Real>
typename HexFailure<Real>::Cell HexFailure<Real>::strained(const LatticeState<Real>& state,
                                                           Index cell) const noexcept {
  const auto corner = corners_of_cell(body_.lattice, cell);
  Cell now;
  now.cell = cell;
  now.plastic = plastic_of(state, cell);
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t c = 0; c < 3; ++c)
      now.w[c][a] = static_cast<double>(state.u[c][static_cast<std::size_t>(corner[a])]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Modes<double> mode = modes_of(now.w[i]);
    now.h[i] = {mode.x * k_.per_4h[0], mode.y * k_.per_4h[1], mode.z * k_.per_4h[2]};
  }
  return now;
}

/// What it holds: several times the cost of strained().
template <class Real>
void HexFailure<Real>::weigh(const LatticeState<Real>& state, Cell& now) const noexcept {
  const auto corner = corners_of_cell(body_.lattice, now.cell);
  HexForces<One> out;
  if (body_.solid->hourglass == HourglassKind::physical)
    hex_forces<One, StableNeoHookean, true, true>(k_, now.w, out);
  else
    hex_forces<One, StableNeoHookean, false, true>(k_, now.w, out);
  if (any_cells_yield(body_)) add_plastic(k_, now.w, now.plastic, out);
  double power = 0;
  for (std::size_t a = 0; a < 8; ++a)
    power += Vec3(out.f[0][a], out.f[1][a], out.f[2][a]).dot(vector_of(state.v, corner[a]));
  const auto stiffness = static_cast<double>(body_.solid->stiffness[static_cast<std::size_t>(now.cell)]);
  now.energy = stiffness * out.energy;
  now.middle = stiffness * (out.energy + 0.5 * state.dt_before * power);
}

template <class Real>
typename HexFailure<Real>::Cell HexFailure<Real>::look_at(const LatticeState<Real>& state,
                                                          Index cell) const noexcept {
  Cell now = strained(state, cell);
  weigh(state, now);
  return now;
}

/// Is it stretched and in tension beyond this? Of what has yielded the two may be along different lines.
template <class Real>
bool HexFailure<Real>::is_pulled(const Cell& now, const TensionLimit<double>& limit) const noexcept {
  const double of_volume = (k_.lambda + k_.mu) / k_.mu;
  if (now.plastic[n_plastic - 1] > 0) return is_pulled_plastic(now.h, now.plastic, limit, of_volume);
  return least_minor<One>(breaking_stretch<One>(limit, of_volume, now.h), stretching<One>(now.h)) <= 0;
}

template <class Real>
bool HexFailure<Real>::comes_to_its_limit(const Cell& now) const noexcept {
  const TensionLimit<double> limit = limit_of(now.cell);
  return limit.stretch > 0 && is_pulled(now, limit) && now.energy > 0;
}

/// Of the crack, of a cell that begins now; 0: it holds more [J].
template <class Real>
double HexFailure<Real>::share_to_begin(const Cell& now, const Vec3& normal) const noexcept {
  const double share = shares_.share_of(now.cell, normal);
  return share > now.energy ? share : 0.0;
}

/// Does this cell begin?
template <class Real>
void HexFailure<Real>::begin(LatticeState<Real>& state, Index cell, std::size_t run) noexcept {
  const auto c = static_cast<std::size_t>(cell);
  const Cell now = look_at(state, cell);
  if (!comes_to_its_limit(now)) return;
  state.failed.reached[c] = static_cast<Real>(now.energy);
  const Vec3 normal = stretched_along(now.h);
  state.failed.left[c] = static_cast<Real>(share_to_begin(now, normal));
  for (int a = 0; a < 3; ++a)
    state.failed.normal[static_cast<std::size_t>(a)][c] = static_cast<Real>(normal[a]);
  stretch_[c] = 0;
  torn_[run] = 1;
  breaking_.push_back(cell);
}

/// Of one that has begun: only what is pulled opens further.
template <class Real>
bool HexFailure<Real>::opens(const Cell& now) const noexcept {
  return is_pulled(now, {.stretch = 0, .tension = limit_of(now.cell).tension});
}

/// s of a cell that has begun, as it is now.
template <class Real>
double HexFailure<Real>::stiffness_left(const LatticeState<Real>& state, const Cell& now) const noexcept {
  const auto c = static_cast<std::size_t>(now.cell);
  const double s = 1 - static_cast<double>(state.failed.damage[c]);
  if (!(state.failed.left[c] > 0)) return 0;
  const auto reached = static_cast<double>(state.failed.reached[c]);
  const double e = std::sqrt(now.energy / reached);
  if (e <= 1 || !opens(now)) return s;
  const double r = shares_.left_to(state, now.cell) / (s * reached);
  return r > e ? s * (r - e) / (e * (r - 1)) : 0.0;
}

/// Of a cell that has not gone: what the next step takes of s.
template <class Real>
double HexFailure<Real>::loss_of(const LatticeState<Real>& state, const Cell& now) const noexcept {
  const auto c = static_cast<std::size_t>(now.cell);
  const double s = 1 - static_cast<double>(state.failed.damage[c]);
  if (state.failed.reached[c] > 0) return s - stiffness_left(state, now);
  return comes_to_its_limit(now) && share_to_begin(now, stretched_along(now.h)) == 0 ? s : 0.0;
}

template <class Real>
double HexFailure<Real>::due_of(const LatticeState<Real>& state, Index cell) const noexcept {
  return loss_of(state, look_at(state, cell));
}

template <class Real>
HexBreaks HexFailure<Real>::due(const LatticeState<Real>& state) const {
  HexBreaks due{std::vector<double>(state.failed.damage.size(), 0.0), 0};
  for (const HexRun& run : grid_.runs)
    for (Index cell = run.first; cell < run.first + run.count; ++cell) {
      const auto c = static_cast<std::size_t>(cell);
      if (body_.solid->stiffness[c] <= 0 || state.failed.damage[c] >= 1) continue;
      const Cell now = look_at(state, cell);
      due.loss[c] = loss_of(state, now);
      due.energy += due.loss[c] * now.middle;
    }
  return due;
}

/// @return what it takes [J]
template <class Real>
double HexFailure<Real>::lose(LatticeState<Real>& state, const Loss& loss,
                              ZeroedArray<Real>& stiffness) noexcept {
  const auto c = static_cast<std::size_t>(loss.cell);
  const double s = 1 - static_cast<double>(state.failed.damage[c]);
  const double takes = std::sqrt(static_cast<double>(state.failed.reached[c]) * loss.reached) * (s - loss.to);
  const auto damage = static_cast<Real>(1 - loss.to);
  state.failed.reached[c] = static_cast<Real>(loss.reached);
  state.failed.damage[c] = damage;
  ++state.failed.changes;
  stiffness[c] = static_cast<Real>(body_.solid->stiffness[c]) * (1 - damage);
  RowLedger& ledger = state.ledger[static_cast<std::size_t>(body_.lattice.row_of(loss.cell))];
  ledger.broken += (static_cast<double>(damage) - (1 - s)) * loss.middle;
  if (damage < 1) return takes;
  ++ledger.breaks;
  take_away(state, loss.cell);
  return takes;
}

/// All that have begun, each as the others were before: their order makes no difference.
template <class Real>
void HexFailure<Real>::go_on(LatticeState<Real>& state, ZeroedArray<Real>& stiffness) noexcept {
  losses_.clear();
  for (const Index cell : breaking_) {
    Cell now = strained(state, cell);
    if (state.failed.left[static_cast<std::size_t>(cell)] > 0 && !opens(now)) continue;
    weigh(state, now);
    const double to = stiffness_left(state, now);
    if (to < 1 - static_cast<double>(state.failed.damage[static_cast<std::size_t>(cell)]))
      losses_.push_back({cell, to, now.energy, now.middle});
  }
  for (Loss& loss : losses_) loss.takes = lose(state, loss, stiffness);
  for (const Loss& loss : losses_)
    if (loss.to > 0) shares_.take(state, loss.cell, loss.takes);
}

/// Its corners lose it, and each other where no other cell joins them.
template <class Real>
void HexFailure<Real>::take_away(LatticeState<Real>& state, Index cell) noexcept {
  const Lattice& lattice = body_.lattice;
  const auto corners = corners_of_cell(lattice, cell);
  for (unsigned a = 0; a < 8; ++a) state.mask[static_cast<std::size_t>(corners[a])] &= ~cell_bit(7 - a);
  state.fresh.add(CellGone{corners});
  for (const Index mass : corners) {
    Mask& mask = state.mask[static_cast<std::size_t>(mass)];
    const auto& offset = lattice.offset[static_cast<std::size_t>(lattice.row_kind(mass))];
    for (std::size_t d = 0; d < static_cast<std::size_t>(2 * lattice.n_half); ++d) {
      if ((mask >> d & 1) == 0 || (mask & sharing_[d]) != 0) continue;
      mask &= ~(Mask{1} << d);
      if (d < static_cast<std::size_t>(lattice.n_half)) state.fresh.add(EdgeGone{mass, mass + offset[d]});
    }
  }
}

template <class Real>
std::int64_t HexFailure<Real>::begin_step(LatticeState<Real>& state, const HexActing& acting,
                                          const ExplicitStep& step, ZeroedArray<Real>& stiffness) noexcept {
  follow(state, stiffness);
  state.fresh.begin_step();
  look(state, acting, step);
  for (std::size_t r = 0; r < found_.size(); ++r) {
    if (found_[r] != Strained::beyond) continue;
    const HexRun& run = grid_.runs[r];
    for (Index cell = run.first; cell < run.first + run.count; ++cell)
      if (stretch_[static_cast<std::size_t>(cell)] > 0) begin(state, cell, r);
    found_[r] = Strained::near;
  }
  std::ranges::sort(breaking_);
  go_on(state, stiffness);
  const std::size_t before = breaking_.size();
  std::erase_if(breaking_,
                [&state](Index cell) { return state.failed.damage[static_cast<std::size_t>(cell)] >= 1; });
  const auto gone = static_cast<std::int64_t>(before - breaking_.size());
  state.breaks += gone;
  return gone;
}

template class HexFailure<float>;
template class HexFailure<double>;

}  // namespace palpate::physics
