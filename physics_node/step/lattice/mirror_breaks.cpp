#include "physics_node/step/lattice/mirror_breaks.h"

namespace palpate::physics {
namespace {

/// Of the elements that this mass is the first end of, those that only the other end still has.
template <class Real>
void mirror_mass(const Lattice& lattice, LatticeState<Real>& state, Index cell, int kind) {
  const Mask mine = state.mask[static_cast<std::size_t>(cell)];
  for (const int d : lattice.forward[static_cast<std::size_t>(kind)]) {
    if ((mine >> d & 1) != 0) continue;
    const int half = d % lattice.n_half;
    const int back = d < lattice.n_half ? d + lattice.n_half : half;
    const Index other = cell + lattice.offset[static_cast<std::size_t>(kind)][static_cast<std::size_t>(d)];
    Mask& theirs = state.mask[static_cast<std::size_t>(other)];
    if ((theirs >> back & 1) == 0) continue;
    theirs &= ~(1U << back);
    state.fresh.add(d < lattice.n_half ? EdgeGone{cell, other} : EdgeGone{other, cell});
  }
}

}  // namespace

template <class Real>
std::int64_t mirror_breaks(const Body& body, LatticeState<Real>& state) noexcept {
  state.fresh.begin_step();
  std::int64_t fresh = 0;
  for (std::size_t r = 0; r < state.ledger.size(); ++r) {
    RowLedger& ledger = state.ledger[r];
    if (ledger.breaks == ledger.mirrored) continue;
    fresh += ledger.breaks - ledger.mirrored;
    ledger.mirrored = ledger.breaks;
    const RowSegment& row = body.lattice.rows[r];
    for (Index i = row.first; i < row.first + row.count; ++i) mirror_mass(body.lattice, state, i, row.kind);
  }
  state.breaks += fresh;
  return fresh;
}

template std::int64_t mirror_breaks(const Body&, LatticeState<float>&) noexcept;
template std::int64_t mirror_breaks(const Body&, LatticeState<double>&) noexcept;

}  // namespace palpate::physics
