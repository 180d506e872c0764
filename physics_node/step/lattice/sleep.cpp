#include "physics_node/step/lattice/sleep.h"

#include <algorithm>
#include <limits>

#include "physics_node/step/lattice/hex_grid.h"

namespace palpate::physics {
namespace {

constexpr double slow = 5e-5;       // [m/s]
constexpr double balanced = 0.02;   // [m/s^2]
constexpr double disturbed = 0.08;  // [m/s^2]
constexpr float patience = 0.2F;    // [s]
// Of viscosity over modulus. Why: what creeps to its place at `slow` is by this times that short of it, 25 um.
constexpr double longest_creep = 0.5;  // [s]

std::vector<Index> rows_beside(const Lattice& lattice, const RowSegment& row) {
  std::vector<Index> beside;
  for (std::size_t d = 0; d < static_cast<std::size_t>(2 * lattice.n_half); ++d) {
    Index end = 0;  // of the last row found: cells before it need no search
    for (Index i = row.first; i < row.first + row.count; ++i) {
      if ((lattice.mask[static_cast<std::size_t>(i)] >> d & 1) == 0) continue;
      const Index other = i + lattice.offset[static_cast<std::size_t>(row.kind)][d];
      if (other < end) continue;
      beside.push_back(lattice.row_of(other));
      const RowSegment& found = lattice.rows[static_cast<std::size_t>(beside.back())];
      end = found.first + found.count;
    }
  }
  std::sort(beside.begin(), beside.end());
  beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  return beside;
}

/// By row: those that share a run of cells with it.
std::vector<std::vector<Index>> rows_beside_by_cells(const Body& body) {
  const HexGrid grid = make_hex_grid(body);
  std::vector<std::vector<Index>> beside(body.lattice.rows.size());
  for (std::size_t run = 0; run < grid.runs.size(); ++run)
    for (const Index row : grid.rows_of(run)) {
      auto& others = beside[static_cast<std::size_t>(row)];
      others.insert(others.end(), grid.rows_of(run).begin(), grid.rows_of(run).end());
    }
  for (std::size_t r = 0; r < beside.size(); ++r) {
    std::sort(beside[r].begin(), beside[r].end());
    beside[r].erase(std::unique(beside[r].begin(), beside[r].end()), beside[r].end());
    std::erase(beside[r], static_cast<Index>(r));
  }
  return beside;
}

/// As slow as to be taken for at rest far from there?
bool creeps(const Body& body) {
  if (body.solid) return !body.solid->relaxation.empty() || body.solid->beta > longest_creep;
  return std::ranges::any_of(body.laws, [](const ElementLaw& law) {
    for (std::size_t h = 0; h < law.c.size(); ++h)
      if (law.c[h] > longest_creep * law.k1[h]) return true;
    return false;
  });
}

}  // namespace

Sleep::Sleep(const Body& body)
    : may_sleep_(body.n_held > 0 && !creeps(body) && !(body.solid && body.solid->awake_radius > 0) &&
                 body.cell_net() == nullptr),
      quiet_s_(body.lattice.rows.size()),
      masses_of_(body.lattice.rows.size(), 0),
      before_(body.lattice.rows.size()) {
  if (!may_sleep_) return;
  for (const Index cell : body.lattice.masses)
    ++masses_of_[static_cast<std::size_t>(body.lattice.row_of(cell))];
  std::vector<std::vector<Index>> of_cells;
  if (body.solid) of_cells = rows_beside_by_cells(body);
  for (std::size_t r = 0; r < body.lattice.rows.size(); ++r) {
    beside_begin_.push_back(static_cast<Index>(beside_.size()));
    const auto rows = body.solid ? of_cells[r] : rows_beside(body.lattice, body.lattice.rows[r]);
    beside_.insert(beside_.end(), rows.begin(), rows.end());
  }
  beside_begin_.push_back(static_cast<Index>(beside_.size()));
}

/// What the row was last seen to do says nothing about what it will do now.
template <class Real>
void Sleep::disturb(LatticeState<Real>& state, std::size_t row) noexcept {
  quiet_s_[row] = 0;
  state.ledger[row].acceleration2 = std::numeric_limits<double>::max();
}

template <class Real>
void Sleep::wake_row(const Body& body, LatticeState<Real>& state, Index row) noexcept {
  const auto r = static_cast<std::size_t>(row);
  disturb(state, r);
  if (state.row_state[r] == RowState::awake) return;
  const RowSegment& segment = body.lattice.rows[r];
  for (auto& axis : state.f) std::fill_n(axis.data() + segment.first, segment.count, Real(0));
  state.row_state[r] = RowState::awake;
}

template <class Real>
void Sleep::classify(const Body& body, LatticeState<Real>& state) noexcept {
  ++state.row_changes;
  auto& rows = state.row_state;
  before_ = rows;
  const auto has_beside = [&](std::size_t r, RowState wanted) {
    for (Index n = beside_begin_[r]; n < beside_begin_[r + 1]; ++n)
      if (rows[static_cast<std::size_t>(beside_[static_cast<std::size_t>(n)])] == wanted) return true;
    return false;
  };
  sleeping_masses_ = 0;
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (rows[r] != RowState::awake)
      rows[r] = has_beside(r, RowState::awake) ? RowState::rim : RowState::asleep;
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (rows[r] == RowState::asleep && has_beside(r, RowState::rim)) rows[r] = RowState::far_rim;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (rows[r] == RowState::awake) continue;
    const RowSegment& segment = body.lattice.rows[r];
    sleeping_masses_ += masses_of_[r];
    // What rims beside it have added to a row that did not clear it is not part of any sum.
    if (before_[r] == RowState::asleep && rows[r] != RowState::asleep)
      for (auto& axis : state.f) std::fill_n(axis.data() + segment.first, segment.count, Real(0));
  }
}

template <class Real>
void Sleep::look(const Body& body, LatticeState<Real>& state, double seconds) noexcept {
  if (!may_sleep_) return;
  bool changed = false;
  for (std::size_t r = 0; r < state.row_state.size(); ++r) {
    const RowLedger& seen = state.ledger[r];
    if (state.row_state[r] == RowState::awake) {
      if (seconds <= 0) continue;
      const bool quiet = seen.speed2 < slow * slow && seen.acceleration2 < balanced * balanced;
      quiet_s_[r] = quiet ? quiet_s_[r] + static_cast<float>(seconds) : 0;
      // What neither moves nor is pushed at all, as a body at its start, need not prove it.
      if (seen.speed2 == 0 && seen.acceleration2 == 0) quiet_s_[r] = patience;
      if (quiet_s_[r] < patience) continue;
      const RowSegment& segment = body.lattice.rows[r];
      for (auto* three : {&state.v, &state.v_half, &state.v_seen})
        for (auto& axis : *three)
          if (axis.size() > 0) std::fill_n(axis.data() + segment.first, segment.count, Real(0));
      RowLedger& ledger = state.ledger[r];
      ledger.numerical += ledger.kinetic;  // what little it still moved
      ledger.speed2 = ledger.kinetic = ledger.between = ledger.acceleration2 = 0;
      ledger.fallen_before = ledger.fallen;
      state.row_state[r] = RowState::rim;
      changed = true;
    } else if (state.row_state[r] == RowState::rim && seen.acceleration2 > disturbed * disturbed) {
      wake_row(body, state, static_cast<Index>(r));
      for (Index n = beside_begin_[r]; n < beside_begin_[r + 1]; ++n)
        wake_row(body, state, beside_[static_cast<std::size_t>(n)]);
      changed = true;
    }
  }
  if (changed) classify(body, state);
}

template <class Real>
void Sleep::wake_cell(const Body& body, LatticeState<Real>& state, Index cell) noexcept {
  if (!any_asleep()) return;
  const auto r = static_cast<std::size_t>(body.lattice.row_of(cell));
  if (state.row_state[r] == RowState::awake) {
    disturb(state, r);
    return;
  }
  wake_row(body, state, static_cast<Index>(r));
  for (Index n = beside_begin_[r]; n < beside_begin_[r + 1]; ++n)
    wake_row(body, state, beside_[static_cast<std::size_t>(n)]);
  classify(body, state);
}

template <class Real>
void Sleep::wake_all(const Body& body, LatticeState<Real>& state) noexcept {
  for (std::size_t r = 0; r < state.row_state.size(); ++r) wake_row(body, state, static_cast<Index>(r));
  sleeping_masses_ = 0;
  ++state.row_changes;
}

template void Sleep::look(const Body&, LatticeState<float>&, double) noexcept;
template void Sleep::look(const Body&, LatticeState<double>&, double) noexcept;
template void Sleep::wake_cell(const Body&, LatticeState<float>&, Index) noexcept;
template void Sleep::wake_cell(const Body&, LatticeState<double>&, Index) noexcept;
template void Sleep::wake_all(const Body&, LatticeState<float>&) noexcept;
template void Sleep::wake_all(const Body&, LatticeState<double>&) noexcept;

}  // namespace palpate::physics
