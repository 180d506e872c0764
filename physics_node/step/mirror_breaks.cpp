#include "physics_node/step/mirror_breaks.h"

namespace palpate::physics {
namespace {

/// Clears the bits of elements that this mass is the second end of and that its first ends no longer have.
template <class Real>
void mirror_mass(const Lattice& lattice, LatticeState<Real>& state, Index cell, const Index* offset) {
  const auto n_half = static_cast<std::size_t>(lattice.n_half);
  Mask& mine = state.mask[static_cast<std::size_t>(cell)];
  for (std::size_t d = 0; d < 2 * n_half; ++d) {
    if (offset[d] > 0 || (mine >> d & 1) == 0) continue;
    const std::size_t back = d < n_half ? d + n_half : d - n_half;
    const Mask theirs = state.mask[static_cast<std::size_t>(cell + offset[d])];
    if ((theirs >> back & 1) == 0) mine &= ~(1U << d);
  }
}

}  // namespace

template <class Real>
std::int64_t mirror_breaks(const Body& body, LatticeState<Real>& state) noexcept {
  std::int64_t breaks = 0;
  for (const RowLedger& row : state.ledger) breaks += row.breaks;
  const std::int64_t fresh = breaks - state.breaks;
  state.breaks = breaks;
  if (fresh == 0) return 0;
  for (const RowSegment& row : body.lattice.rows) {
    const Index* offset = body.lattice.offset[static_cast<std::size_t>(row.kind)].data();
    for (Index i = row.first; i < row.first + row.count; ++i) mirror_mass(body.lattice, state, i, offset);
  }
  return fresh;
}

template std::int64_t mirror_breaks(const Body&, LatticeState<float>&) noexcept;
template std::int64_t mirror_breaks(const Body&, LatticeState<double>&) noexcept;

}  // namespace palpate::physics
