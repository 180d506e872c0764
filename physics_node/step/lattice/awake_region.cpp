#include "physics_node/step/lattice/awake_region.h"

#include <algorithm>
#include <cmath>

#include "physics_node/step/lattice/hex_meter.h"
#include "physics_node/step/lattice/measure.h"
#include "physics_node/step/lattice/near_runs.h"

namespace palpate::physics {
namespace {

// Why: a finger at 0.1 m/s goes a millimetre, by which the rim errs by some percent.
constexpr double period = 0.01;  // between looks at places [s]
// Further than the radius, for what is awake. Why: a finger that trembles shall not move the border.
constexpr double kept_cells = 3;
constexpr double slack_cells = 0.5;  // by which a place may move before the border does

enum : std::uint8_t { acted = 1, shall_act = 2 };

}  // namespace

template <class Real>
AwakeRegion<Real>::AwakeRegion(const Body& body)
    : grid_(make_hex_grid(body)),
      radius_(body.solid->awake_radius),
      places_(0.5 * radius_),
      rim_(body),
      marks_(static_cast<std::size_t>(body.capacity()), 0),
      run_is_(grid_.runs.size(), 0),
      row_is_(body.lattice.rows.size(), 0) {
  border_of_.reserve(PressedPlaces::most);
  for (auto* list : {&acting_, &next_, &changed_}) list->reserve(grid_.runs.size());
  rows_.reserve(row_is_.size());
  waking_.reserve(body.nodes().size());
  began_.reserve(body.nodes().size());
  parts_.marks = marks_.data();
}

template <class Real>
template <class Visit>
void AwakeRegion<Real>::each_corner(const Body& body, Index r, const Visit& visit) const noexcept {
  const HexRun& run = grid_.runs[static_cast<std::size_t>(r)];
  for (Index i = run.first; i < run.first + run.count; ++i) {
    if (body.solid->stiffness[static_cast<std::size_t>(i)] <= 0) continue;
    for (const Index node : corners_now(body, grid_, run, i)) visit(node);
  }
}

template <class Real>
void AwakeRegion<Real>::wake(const Body& body, LatticeState<Real>& state,
                             std::span<const NodalForce> forces) noexcept {
  bool fresh = false;
  for (const NodalForce& nodal : forces)
    if (nodal.force != Vec3::Zero()) fresh |= places_.note(body.rest_position(nodal.cell), nodal.force);
  if (fresh) look(body, state, 0);
}

template <class Real>
void AwakeRegion<Real>::wake(const Body& body, LatticeState<Real>& state, std::span<const NodalPush> pushes,
                             double dt) noexcept {
  bool fresh = false;
  for (const NodalPush& one : pushes) {
    const auto w = static_cast<double>(state.inverse_mass[static_cast<std::size_t>(one.cell)]);
    if (w > 0 && dt > 0 && one.dv != Vec3::Zero())
      fresh |= places_.note(body.rest_position(one.cell), one.dv / (w * dt));
  }
  if (fresh) look(body, state, 0);
}

/// Fills next_. Looks only at rows about the places.
template <class Real>
void AwakeRegion<Real>::choose(const Body& body) noexcept {
  next_.clear();
  for (const PressedPlace& place : places_.now()) {
    const double reach = reach_of(body, grid_, place.at, radius_);
    const double kept = reach + kept_cells * body.spacing();
    each_run_about(body.lattice, grid_, place.at, kept, [&](std::size_t r) {
      if ((run_is_[r] & shall_act) != 0) return;
      if (!comes_within(body, grid_.runs[r], place.at, (run_is_[r] & acted) != 0 ? kept : reach)) return;
      run_is_[r] |= shall_act;
      next_.push_back(static_cast<Index>(r));
    });
  }
  std::ranges::sort(next_);
}

/// A node that wakes begins where the nearest node towards its place is that moved already, the less the further out;
/// at rest where air lies between them, as beside a wall that is bent.
template <class Real>
void AwakeRegion<Real>::begin_near_rim(const Body& body, LatticeState<Real>& state, Index node) noexcept {
  const Vec3 x = body.rest_position(node);
  const PressedPlace* nearest = nullptr;
  for (const PressedPlace& place : places_.now())
    if (nearest == nullptr || (place.at - x).squaredNorm() < (nearest->at - x).squaredNorm())
      nearest = &place;
  Vec3 u = Vec3::Zero();
  const Vec3 way = nearest->at - x;
  const double h = body.lattice.step.minCoeff();
  for (double gone = h; gone < way.norm(); gone += h) {
    const Vec3 at = x + gone / way.norm() * way;
    const Vec3i grid =
        (at - body.lattice.origin).cwiseQuotient(body.lattice.step).array().round().cast<int>();
    const Index inner = body.lattice.mass_at(grid);
    if (inner < 0) break;
    if (!moves(inner)) continue;
    u = vector_of(state.u, inner) * (body.rest_position(inner) - nearest->at).norm() / way.norm();
    break;
  }
  waking_.push_back(node);
  began_.push_back(u);
}

/// @return energy that went with nodes that fall asleep [J]
template <class Real>
double AwakeRegion<Real>::settle_nodes(const Body& body, LatticeState<Real>& state) noexcept {
  constexpr std::uint8_t stays = 4, wakes = 8;
  double gone = 0;
  waking_.clear();
  began_.clear();
  for (const Index r : next_)
    each_corner(body, r, [&](Index node) {
      std::uint8_t& mark = marks_[static_cast<std::size_t>(node)];
      if ((mark & (stays | wakes)) != 0) return;
      mark |= (mark & node_moves) != 0 ? stays : wakes;
      if ((mark & wakes) != 0 && state.inverse_mass[static_cast<std::size_t>(node)] > 0)
        begin_near_rim(body, state, node);
    });
  for (const Index r : acting_)
    each_corner(body, r, [&](Index node) {
      const auto n = static_cast<std::size_t>(node);
      if (marks_[n] == 0 || (marks_[n] & (stays | wakes)) != 0) return;
      marks_[n] = 0;
      if (state.inverse_mass[n] > 0)
        gone += 0.5 / static_cast<double>(state.inverse_mass[n]) * vector_of(state.v, node).squaredNorm();
      for (std::size_t a = 0; a < 3; ++a) state.u[a][n] = state.v[a][n] = state.f[a][n] = 0;
    });
  for (std::size_t n = 0; n < waking_.size(); ++n)
    for (std::size_t a = 0; a < 3; ++a)
      state.u[a][static_cast<std::size_t>(waking_[n])] =
          static_cast<Real>(began_[n][static_cast<Eigen::Index>(a)]);
  n_moving_ = 0;
  for (const Index r : next_)
    each_corner(body, r, [&](Index node) {
      std::uint8_t& mark = marks_[static_cast<std::size_t>(node)];
      n_moving_ += mark != node_moves ? 1 : 0;
      mark = node_moves;
    });
  for (const Index r : next_) {
    const HexRun& run = grid_.runs[static_cast<std::size_t>(r)];
    for (auto i = static_cast<std::size_t>(run.first); i < static_cast<std::size_t>(run.first + run.count);
         ++i)
      if (body.solid->stiffness[i] > 0) marks_[i] |= cell_acts;
  }
  return gone;
}

/// What it has lost is kept here.
template <class Real>
void AwakeRegion<Real>::put_to_sleep(LatticeState<Real>& state, std::size_t row) noexcept {
  slept_.viscous += state.ledger[row].viscous;
  slept_.numerical += state.ledger[row].numerical;
  state.ledger[row] = {};
  state.row_state[row] = RowState::asleep;
}

/// Rows with corners of what acts are awake.
template <class Real>
void AwakeRegion<Real>::settle_rows(LatticeState<Real>& state) noexcept {
  constexpr std::uint8_t stayed = acted | shall_act;
  for (const Index row : rows_) row_is_[static_cast<std::size_t>(row)] = acted;
  for (const Index r : next_)
    for (const Index row : grid_.rows_of(static_cast<std::size_t>(r)))
      row_is_[static_cast<std::size_t>(row)] |= shall_act;
  for (const Index row : rows_) {
    const auto n = static_cast<std::size_t>(row);
    if (row_is_[n] != acted) continue;
    put_to_sleep(state, n);
    row_is_[n] = 0;
  }
  rows_.clear();
  for (const Index r : next_)
    for (const Index row : grid_.rows_of(static_cast<std::size_t>(r))) {
      const auto n = static_cast<std::size_t>(row);
      if (row_is_[n] == 0) continue;
      if (row_is_[n] != stayed && state.woken.size() < state.woken.capacity()) state.woken.push_back(row);
      row_is_[n] = 0;
      rows_.push_back(row);
      state.row_state[n] = RowState::awake;
    }
  std::ranges::sort(rows_);
}

template <class Real>
void AwakeRegion<Real>::move_border(const Body& body, LatticeState<Real>& state) noexcept {
  for (const Index r : acting_) run_is_[static_cast<std::size_t>(r)] = acted;
  choose(body);
  border_of_.clear();
  for (const PressedPlace& place : places_.now()) border_of_.push_back(place.at);
  const auto those_that = [this](const std::vector<Index>& of, std::uint8_t are) -> std::span<const Index> {
    changed_.clear();
    for (const Index r : of)
      if (run_is_[static_cast<std::size_t>(r)] == are) changed_.push_back(r);
    return changed_;
  };
  double lost = measure_between(body, grid_, state, those_that(acting_, acted));
  lost += settle_nodes(body, state);
  lost -= measure_between(body, grid_, state, those_that(next_, shall_act));
  slept_.numerical += lost;
  settle_rows(state);
  for (const Index r : acting_) state.acts[static_cast<std::size_t>(r)] = 0;
  for (const Index r : next_) state.acts[static_cast<std::size_t>(r)] = 1;
  for (const auto* list : {&acting_, &next_})
    for (const Index r : *list) run_is_[static_cast<std::size_t>(r)] = 0;
  acting_.swap(next_);
  ++state.row_changes;
  rim_.find(body, grid_, acting_, marks_, state);
}

/// Of a node or copy. @return whether it lies in the rim, or did
template <class Real>
bool AwakeRegion<Real>::settle_split(const Body& body, LatticeState<Real>& state, Index node) noexcept {
  const auto n = static_cast<std::size_t>(node);
  bool shall_move = false, borders = false;
  body.cell_net()->each_corner(node, [&](Index cell, std::size_t) {
    const bool acts = (marks_[static_cast<std::size_t>(cell)] & cell_acts) != 0;
    shall_move |= acts, borders |= !acts;
  });
  if (moves(node) != shall_move) {
    marks_[n] ^= node_moves;
    n_moving_ += shall_move ? 1 : -1;
  }
  if (shall_move) return borders || rim_.has(node);
  if (state.inverse_mass[n] > 0)
    slept_.numerical +=
        0.5 / static_cast<double>(state.inverse_mass[n]) * vector_of(state.v, node).squaredNorm();
  for (std::size_t a = 0; a < 3; ++a) state.u[a][n] = state.v[a][n] = state.f[a][n] = 0;
  return rim_.has(node);
}

template <class Real>
void AwakeRegion<Real>::follow_cut(const Body& body, LatticeState<Real>& state,
                                   std::span<const NodeSplit> splits) noexcept {
  if (splits.empty()) return;
  const double before = of_rim(state);
  bool in_rim = false;
  for (const NodeSplit& split : splits)
    for (const Index node : {split.node, split.copy}) in_rim |= settle_split(body, state, node);
  if (!in_rim) return;
  rim_.find(body, grid_, acting_, marks_, state);
  rim_.stiffen(body, places_.now());
  slept_.numerical += before - of_rim(state);
}

/// As the ledger has it: m v(-) . v(+) / 2, so a force that goes takes dt / 2 of its power along [J].
template <class Real>
double AwakeRegion<Real>::of_rim(const LatticeState<Real>& state) const noexcept {
  return rim_.elastic(state) + 0.5 * state.dt_before * rim_.power(state);
}

template <class Real>
void AwakeRegion<Real>::measure(const Body& body, const LatticeState<Real>& state) noexcept {
  double u2 = 0, v2 = 0;
  for (const Index row : rows_) {
    const RowSegment& segment = body.lattice.rows[static_cast<std::size_t>(row)];
    for (Index i = segment.first; i < segment.first + segment.count; ++i)
      u2 = std::max(u2, vector_of(state.u, i).squaredNorm());
    v2 = std::max(v2, state.ledger[static_cast<std::size_t>(row)].speed2);
  }
  if (!rows_.empty() && body.cell_net() != nullptr) {
    body.each_copy([&](Index copy) { u2 = std::max(u2, vector_of(state.u, copy).squaredNorm()); });
    v2 = std::max(v2, state.ledger.back().speed2);
  }
  parts_.most_moved = rows_.empty() ? 0 : std::sqrt(u2) + 2 * period * std::sqrt(v2) + body.spacing();
}

template <class Real>
void AwakeRegion<Real>::look(const Body& body, LatticeState<Real>& state, double seconds) noexcept {
  since_ += seconds;
  if (seconds > 0 && since_ < period * (1 - 1e-9)) return;
  if (places_.now().empty()) {
    since_ = 0;
    return;
  }
  places_.look(since_);
  since_ = 0;
  const auto places = places_.now();
  const double slack = slack_cells * body.lattice.step.minCoeff();
  const bool stays =
      std::ranges::equal(places, border_of_, [slack](const PressedPlace& place, const Vec3& at) {
        return (place.at - at).squaredNorm() < slack * slack;
      });
  slept_.numerical += of_rim(state);
  if (!stays) move_border(body, state);
  rim_.stiffen(body, places);
  slept_.numerical -= of_rim(state);
  measure(body, state);
}

template <class Real>
void AwakeRegion<Real>::clear(const Body& body, LatticeState<Real>& state) noexcept {
  places_.clear();
  border_of_.clear();
  rim_.clear();
  for (const Index r : acting_)
    each_corner(body, r, [&](Index node) { marks_[static_cast<std::size_t>(node)] = 0; });
  // All of a row, as what is not a number between masses would come back to them.
  for (const Index row : rows_) {
    const RowSegment& segment = body.lattice.rows[static_cast<std::size_t>(row)];
    for (auto* three : {&state.u, &state.v, &state.f})
      for (auto& axis : *three) std::fill_n(axis.data() + segment.first, row_segment, Real(0));
    state.ledger[static_cast<std::size_t>(row)] = {};
  }
  if (body.cell_net() != nullptr) clear_copies(body, state);
  slept_ = {};
  acting_.clear();
  rows_.clear();
  n_moving_ = 0;
  since_ = 0;
  parts_.most_moved = 0;
  std::ranges::fill(state.row_state, RowState::asleep);
  state.acts.assign(grid_.runs.size(), 0);
  state.woken.reserve(2 * state.row_state.size());
  state.woken.clear();
  ++state.row_changes;
}

template <class Real>
void AwakeRegion<Real>::clear_copies(const Body& body, LatticeState<Real>& state) noexcept {
  const auto first = static_cast<std::size_t>(body.cell_net()->n_loaded());
  const std::size_t n = marks_.size() - first;
  std::fill_n(marks_.begin() + static_cast<std::ptrdiff_t>(first), n, std::uint8_t{0});
  for (auto* three : {&state.u, &state.v, &state.f})
    for (auto& axis : *three) std::fill_n(axis.data() + first, n, Real(0));
  state.ledger.back() = {};
}

template <class Real>
void AwakeRegion<Real>::go_back(const Body& body, LatticeState<Real>& state) noexcept {
  clear(body, state);
  slept_ = saved_.good();
}

template <class Real>
Losses AwakeRegion<Real>::losses(const Body& body, const LatticeState<Real>& state) const noexcept {
  Losses sum = slept_;
  for (const Index row : rows_) add_losses(state.ledger[static_cast<std::size_t>(row)], sum);
  if (body.cell_net() != nullptr) add_losses(state.ledger.back(), sum);
  sum.viscous += rim_.lost();
  return sum;
}

template class AwakeRegion<float>;
template class AwakeRegion<double>;

}  // namespace palpate::physics
