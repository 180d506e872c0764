#include "physics_node/step/lattice/saved_state.h"

#include <algorithm>
#include <limits>

namespace palpate::physics {
namespace {

template <class Real>
void copy_cells(const Body& body, const FailedCells<Real>& from, FailedCells<Real>& to) noexcept {
  for (std::size_t a = 0; a < from.arrays().size(); ++a) copy_rows(body, *from.arrays()[a], *to.arrays()[a]);
}

}  // namespace

template <class Real>
SavedState<Real>::SavedState(const Body& body, const LatticeState<Real>& state) {
  if (is_awake_in_parts(body)) return;
  ledger_ = state.ledger;
  const auto n = static_cast<std::size_t>(body.capacity());
  for (auto& axis : u_) axis = ZeroedArray<Real>(n);
  remembered_.resize(state.remembered.size());
  for (auto& array : remembered_) array = ZeroedArray<Real>(n);
  plastic_.memory.resize(state.plastic.memory.size());
  for (auto& array : plastic_.memory) array = ZeroedArray<Real>(n);
  if (!any_breaks(body)) return;
  mask_ = ZeroedArray<Mask>(n);
  if (body.solid)
    for (auto* array : failed_.arrays()) *array = ZeroedArray<Real>(n);
  if (!any_yields(body)) return;
  for (std::size_t h = 0; h < static_cast<std::size_t>(body.lattice.n_half); ++h) {
    l_c_[h] = ZeroedArray<Real>(n);
    hardening_[h] = ZeroedArray<Real>(n);
  }
}

template <class Real>
void SavedState<Real>::take(const Body& body, const LatticeState<Real>& state) noexcept {
  for (std::size_t a = 0; a < 3; ++a) copy_nodes(body, state.u[a], u_[a]);
  for (std::size_t m = 0; m < remembered_.size(); ++m) copy_rows(body, state.remembered[m], remembered_[m]);
  ledger_ = state.ledger;
  if (body.solid && any_breaks(body) && failed_.changes != state.failed.changes) {
    failed_.changes = state.failed.changes;
    breaks_ = state.breaks;
    copy_rows(body, state.mask, mask_);
    copy_cells(body, state.failed, failed_);
  }
  if (plastic_.changes != state.plastic.changes) {
    plastic_.changes = state.plastic.changes;
    for (std::size_t m = 0; m < plastic_.memory.size(); ++m)
      copy_rows(body, state.plastic.memory[m], plastic_.memory[m]);
  }
  if (body.solid || !any_breaks(body)) return;
  std::int64_t yields = 0;
  for (const RowLedger& row : ledger_) yields += row.yields;
  if (yields == yields_ && state.breaks == breaks_) return;
  yields_ = yields;
  breaks_ = state.breaks;
  copy_rows(body, state.mask, mask_);
  if (!any_yields(body)) return;
  for (std::size_t h = 0; h < static_cast<std::size_t>(body.lattice.n_half); ++h) {
    copy_rows(body, state.l_c[h], l_c_[h]);
    copy_rows(body, state.hardening[h], hardening_[h]);
  }
}

template <class Real>
void SavedState<Real>::split(const NodeSplit& split) noexcept {
  for (auto& axis : u_)
    axis[static_cast<std::size_t>(split.copy)] = axis[static_cast<std::size_t>(split.node)];
}

template <class Real>
void SavedState<Real>::bring_back(const Body& body, LatticeState<Real>& state) const noexcept {
  // Storage between rows too: what is not a number there, nothing times infinity, would come back with the next step.
  for (std::size_t a = 0; a < 3; ++a) {
    for (auto* three : {&state.u, &state.v, &state.v_half, &state.f})
      std::fill_n((*three)[a].data(), (*three)[a].size(), Real(0));
    copy_nodes(body, u_[a], state.u[a]);
  }
  for (std::size_t m = 0; m < remembered_.size(); ++m) copy_rows(body, remembered_[m], state.remembered[m]);
  state.forget_last_step();
  state.ledger = ledger_;
  for (RowLedger& row : state.ledger) {
    row.speed2 = row.kinetic = row.between = 0;
    row.acceleration2 =
        std::numeric_limits<double>::max();  // not known: nothing may sleep before the next look
  }
  state.breaks = breaks_;
  ++state.replacements;
  state.fresh.replace_all();
  for (std::size_t m = 0; m < plastic_.memory.size(); ++m)
    copy_rows(body, plastic_.memory[m], state.plastic.memory[m]);
  ++state.plastic.changes;
  if (!any_breaks(body)) return;
  copy_rows(body, mask_, state.mask);
  if (body.solid) {
    copy_cells(body, failed_, state.failed);
    ++state.failed.changes;
  }
  if (!any_yields(body)) return;
  for (std::size_t h = 0; h < static_cast<std::size_t>(body.lattice.n_half); ++h) {
    copy_rows(body, l_c_[h], state.l_c[h]);
    copy_rows(body, hardening_[h], state.hardening[h]);
  }
}

template class SavedState<float>;
template class SavedState<double>;

}  // namespace palpate::physics
