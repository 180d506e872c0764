#include "physics_node/step/lattice/state.h"

#include <algorithm>

#include "common/math/state_hash.h"
#include "physics_node/step/fem/hex_plastic.h"
#include "physics_node/step/fem/hex_relaxation.h"
#include "physics_node/step/lattice/element_slots.h"

namespace palpate::physics {

template <class Real>
LatticeState<Real>::LatticeState(const Body& body) : fast(body) {
  const auto n = static_cast<std::size_t>(body.capacity());
  const auto n_half = static_cast<std::size_t>(body.lattice.n_half);
  std::size_t colour = 0;
  for (auto* three : {&u, &v, &f})
    for (auto& array : *three) array = ZeroedArray<Real>(n, colour++);
  mask = ZeroedArray<Mask>(n, colour++);
  inverse_mass = ZeroedArray<Real>(n, colour++);
  mask.will_be_filled();
  inverse_mass.will_be_filled();
  if (any_yields(body)) {
    for (std::size_t h = 0; h < n_half; ++h) {
      l_c[h] = ZeroedArray<Real>(n, colour++);
      hardening[h] = ZeroedArray<Real>(n, colour++);
    }
  }
  for (const Index cell : body.lattice.masses) {
    const auto c = static_cast<std::size_t>(cell);
    inverse_mass[c] = static_cast<Real>(body.inverse_mass[c]);
  }
  if (!body.solid) make_slots(body, all, level, up);
  if (!body.solid && !body.law_of.empty()) varied = make_varied_constants<Real>(body, colour);
  if (body.solid) remembered.resize(n_remembered * body.solid->relaxation.size());
  for (auto& array : remembered) array = ZeroedArray<Real>(n, colour++);
  if (any_cells_yield(body)) plastic.memory.resize(n_plastic);
  for (auto& array : plastic.memory) array = ZeroedArray<Real>(n, colour++);
  row_state.resize(body.lattice.rows.size());
  ledger.resize(body.lattice.rows.size() + (body.cell_net() != nullptr ? 1 : 0));
  if (body.solid && any_breaks(body)) {
    for (auto* array : failed.arrays()) *array = ZeroedArray<Real>(n, colour++);
    fresh.reserve_cells(body.lattice.masses.size());
  }
  if (any_breaks(body)) fresh.reserve(body.lattice.n_elements());
  reset(body);
}

template <class Real>
void LatticeState<Real>::reset(const Body& body) {
  const bool yields = any_yields(body);
  const bool is_new = replacements == 0;  // as made: not even read, so that pages stay free
  for (auto* three : {&u, &v, &f})
    body.each_copy([&](Index copy) {
      for (auto& axis : *three) axis[static_cast<std::size_t>(copy)] = 0;
    });
  for (const Index cell : body.lattice.masses) {
    const auto c = static_cast<std::size_t>(cell);
    const bool held = body.inverse_mass[c] == 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto start = static_cast<Real>(body.velocity[static_cast<Eigen::Index>(a)]);
      // Only what was written: untouched pages stay free.
      if (!is_new && u[a][c] != 0) u[a][c] = 0;
      if (!is_new && f[a][c] != 0) f[a][c] = 0;
      const Real begins = held ? Real(0) : start;
      if (is_new ? begins != 0 : v[a][c] != begins) v[a][c] = begins;
    }
    mask[c] = body.lattice.mask[c];
    if (is_new) continue;
    for (auto& array : remembered) array[c] = 0;
    if (failed.reached.size() > 0 && failed.reached[c] != 0)
      for (auto* array : failed.arrays()) (*array)[c] = 0;
    if (!plastic.memory.empty() && plastic.memory.back()[c] != 0)
      for (auto& array : plastic.memory) array[c] = 0;
    for (std::size_t h = 0; yields && h < static_cast<std::size_t>(body.lattice.n_half); ++h) {
      if (l_c[h][c] != 0) l_c[h][c] = 0;
      if (hardening[h][c] != 0) hardening[h][c] = 0;
    }
  }
  forget_last_step();
  breaks = 0;
  ++replacements;
  ++failed.changes, ++plastic.changes;
  fresh.replace_all();
  std::fill(row_state.begin(), row_state.end(), RowState::awake);
  ++row_changes;
  std::fill(ledger.begin(), ledger.end(), RowLedger{});
}

template <class Real>
void LatticeState<Real>::start_from(const Body& body, std::span<const Vec3> start) {
  for (std::size_t n = 0; n < start.size(); ++n)
    for (std::size_t a = 0; a < 3; ++a)
      u[a][static_cast<std::size_t>(body.nodes()[n])] =
          static_cast<Real>(start[n][static_cast<Eigen::Index>(a)]);
  for (std::size_t a = 0; a < 3 && v_half[a].size() > 0; ++a)
    for (const Index cell : body.lattice.masses)
      v_half[a][static_cast<std::size_t>(cell)] = v[a][static_cast<std::size_t>(cell)];
}

template <class Real>
std::uint64_t hash_of(const Body& body, const LatticeState<Real>& state, std::uint64_t seed) noexcept {
  for (std::size_t r = 0; r < body.lattice.rows.size(); ++r) {
    // Of a body that is awake in parts the rest stands where it rests.
    if (is_awake_in_parts(body) && state.row_state[r] == RowState::asleep) continue;
    const RowSegment& row = body.lattice.rows[r];
    const auto first = static_cast<std::size_t>(row.first);
    const auto count = static_cast<std::size_t>(row.count);
    if (is_awake_in_parts(body)) seed = hash_state(&row.first, sizeof(row.first), seed);
    for (std::size_t a = 0; a < 3; ++a) {
      seed = hash_state(&state.u[a][first], count * sizeof(Real), seed);
      seed = hash_state(&state.v[a][first], count * sizeof(Real), seed);
    }
    seed = hash_state(&state.mask[first], count * sizeof(Mask), seed);
    for (const auto& array : state.remembered) seed = hash_state(&array[first], count * sizeof(Real), seed);
    for (const auto* array : state.failed.arrays())
      if (array->size() > 0) seed = hash_state(&(*array)[first], count * sizeof(Real), seed);
    for (const auto& array : state.plastic.memory)
      seed = hash_state(&array[first], count * sizeof(Real), seed);
    if (!any_yields(body)) continue;
    for (std::size_t d = 0; d < static_cast<std::size_t>(body.lattice.n_half); ++d) {
      seed = hash_state(&state.l_c[d][first], count * sizeof(Real), seed);
      seed = hash_state(&state.hardening[d][first], count * sizeof(Real), seed);
    }
  }
  if (const CellNet* net = body.cell_net())
    for (std::size_t a = 0; a < 3; ++a)
      for (const auto* three : {&state.u, &state.v})
        seed = hash_state(&(*three)[a][static_cast<std::size_t>(net->n_loaded())],
                          static_cast<std::size_t>(net->n_copies()) * sizeof(Real), seed);
  return seed;
}

template <class Real>
bool has_yielded(const Body& body, const LatticeState<Real>& state, Index cell) noexcept {
  const auto n_half = static_cast<std::size_t>(body.lattice.n_half);
  const auto& offset = body.lattice.offset[static_cast<std::size_t>(body.lattice.row_kind(cell))];
  for (std::size_t d = 0; d < 2 * n_half; ++d) {
    if ((body.lattice.mask[static_cast<std::size_t>(cell)] >> d & 1) == 0) continue;
    const Index owner = d < n_half ? cell : cell + offset[d];
    if (state.hardening[d % n_half][static_cast<std::size_t>(owner)] > 0) return true;
  }
  return false;
}

template <class Real>
double yielded_share(const Body& body, const LatticeState<Real>& state, Index cell) noexcept {
  const auto n_half = static_cast<std::size_t>(body.lattice.n_half);
  const auto& offset = body.lattice.offset[static_cast<std::size_t>(body.lattice.row_kind(cell))];
  const Mask live = state.mask[static_cast<std::size_t>(cell)];
  if (live == 0) return has_yielded(body, state, cell) ? 1 : 0;
  int alive = 0, yielded = 0;
  for (std::size_t d = 0; d < 2 * n_half; ++d) {
    if ((live >> d & 1) == 0) continue;
    const Index owner = d < n_half ? cell : cell + offset[d];
    ++alive;
    yielded += state.hardening[d % n_half][static_cast<std::size_t>(owner)] > 0 ? 1 : 0;
  }
  return static_cast<double>(yielded) / alive;
}

template std::uint64_t hash_of(const Body&, const LatticeState<float>&, std::uint64_t) noexcept;
template std::uint64_t hash_of(const Body&, const LatticeState<double>&, std::uint64_t) noexcept;
template struct LatticeState<float>;
template struct LatticeState<double>;
template bool has_yielded(const Body&, const LatticeState<float>&, Index) noexcept;
template bool has_yielded(const Body&, const LatticeState<double>&, Index) noexcept;
template double yielded_share(const Body&, const LatticeState<float>&, Index) noexcept;
template double yielded_share(const Body&, const LatticeState<double>&, Index) noexcept;

}  // namespace palpate::physics
