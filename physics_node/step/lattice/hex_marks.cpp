#include "physics_node/step/lattice/hex_marks.h"

namespace palpate::physics {
namespace {

/// Calls visit(storage cell) for each cell around a mass, gone ones too.
template <class Visit>
void each_cell_at(const Body& body, Index node, const Visit& visit) noexcept {
  const Lattice& lattice = body.lattice;
  const Vec3i at = lattice.grid_of(node);
  for (unsigned corner = 0; corner < 8; ++corner) {
    const auto cell = static_cast<std::size_t>(
        lattice.cell_of(at - Vec3i(corner & 1, corner >> 1 & 1, corner >> 2)));  // at least in the halo
    if (body.solid->stiffness[cell] > 0) visit(cell);
  }
}

template <class Real>
Real lost(const LatticeState<Real>& state, std::size_t cell) noexcept {
  return state.failed.damage.size() > 0 ? state.failed.damage[cell] : Real(0);
}

template <class Real>
bool has_suffered(const LatticeState<Real>& state, std::size_t cell) noexcept {
  return lost(state, cell) > 0 || (!state.plastic.memory.empty() && state.plastic.memory.back()[cell] > 0);
}

}  // namespace

template <class Real>
double marked_share(const Body& body, const LatticeState<Real>& state, Index node) noexcept {
  int live = 0, marked = 0;
  each_cell_at(body, node, [&](std::size_t cell) {
    if (lost(state, cell) == 1) return;
    ++live;
    marked += has_suffered(state, cell) ? 1 : 0;
  });
  return live > 0 ? static_cast<double>(marked) / live : 1.0;
}

template <class Real>
bool is_marked(const Body& body, const LatticeState<Real>& state, Index node) noexcept {
  bool any = false;
  each_cell_at(body, node, [&](std::size_t cell) { any = any || has_suffered(state, cell); });
  return any;
}

template <class Real>
Condition condition_of(const Body& body, const LatticeState<Real>& state, const Adjacency& now,
                       Index node) noexcept {
  Condition out;
  if (body.cell_net() != nullptr) return out;
  if (now.has_lost(node)) out.flags |= mass_broken;
  if (any_yields(body)) {
    if (has_yielded(body, state, node)) out.flags |= mass_yielded;
    out.yielded_share = yielded_share(body, state, node);
  }
  if (!body.solid || !may_change_for_good(body)) return out;
  if (is_marked(body, state, node)) out.flags |= mass_yielded;
  out.yielded_share = marked_share(body, state, node);
  return out;
}

template Condition condition_of(const Body&, const LatticeState<float>&, const Adjacency&, Index) noexcept;
template Condition condition_of(const Body&, const LatticeState<double>&, const Adjacency&, Index) noexcept;
template double marked_share(const Body&, const LatticeState<float>&, Index) noexcept;
template double marked_share(const Body&, const LatticeState<double>&, Index) noexcept;
template bool is_marked(const Body&, const LatticeState<float>&, Index) noexcept;
template bool is_marked(const Body&, const LatticeState<double>&, Index) noexcept;

}  // namespace palpate::physics
