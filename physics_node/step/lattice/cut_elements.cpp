#include "physics_node/step/lattice/cut_elements.h"

#include <algorithm>
#include <utility>

#include "physics_node/step/lattice/element_now.h"

namespace palpate::physics {
namespace {

constexpr int no_direction = -1;

/// In which a live element leads from a to b.
template <class Real>
int direction_of(const Lattice& lattice, const LatticeState<Real>& state, Index a, Index b) noexcept {
  if (a < 0 || a >= lattice.n_cells()) return no_direction;
  const Mask live = state.mask[static_cast<std::size_t>(a)] & element_bits;
  if (live == 0) return no_direction;
  const auto& offset = lattice.offset[static_cast<std::size_t>(lattice.row_kind(a))];
  for (int d = 0; d < 2 * lattice.n_half; ++d)
    if ((live >> d & 1) != 0 && a + offset[static_cast<std::size_t>(d)] == b) return d;
  return no_direction;
}

/// What the books have of an element that has not been booked as lost.
template <class Real>
void book_cut(const Body& body, const LatticeState<Real>& state, const ElementNow& e, RowLedger& ledger) {
  const Three<Real>& v = before_the_kick(state);
  const double dt = goes_on_by(state);
  const Losses yielding = due_of_yield(state, e);
  const double between = 0.5 * dt * (damper_power(body, e, state.v, v) - e.f_s * e.along(v));
  const double damped =
      dt * (state.v_seen_known ? passed_power(body, state, e) : -damper_power(body, e, state.v, state.v));
  const double taken = state.v_seen_known ? std::max(0.0, damped) : 0;
  ledger.broken += e.elastic();
  ledger.viscous += taken;
  ledger.plastic += yielding.plastic;
  ledger.numerical += between + damped - taken + yielding.numerical;
  // Both ends know of it at once: mirror_breaks() has nothing to look for.
  ++ledger.breaks;
  ++ledger.mirrored;
}

}  // namespace

template <class Real>
std::int64_t cut_elements(const Body& body, LatticeState<Real>& state, Sleep& sleep,
                          std::span<const EdgeGone> elements) noexcept {
  const Lattice& lattice = body.lattice;
  const bool yields = any_yields(body);
  std::int64_t n = 0;
  for (EdgeGone one : elements) {
    int d = direction_of(lattice, state, one.a, one.b);
    if (d == no_direction) continue;
    if (d >= lattice.n_half) d -= lattice.n_half, std::swap(one.a, one.b);
    const auto row = static_cast<std::size_t>(lattice.row_of(std::min(one.a, one.b)));
    book_cut(body, state, element_now(body, state, one.a, one.b, static_cast<std::size_t>(d), yields),
             state.ledger[row]);
    state.mask[static_cast<std::size_t>(one.a)] &= ~(Mask{1} << d);
    state.mask[static_cast<std::size_t>(one.b)] &= ~(Mask{1} << (d + lattice.n_half));
    state.fresh.add(one);
    for (const Index end : {one.a, one.b}) sleep.wake_cell(body, state, end);
    ++n;
  }
  state.breaks += n;
  return n;
}

template std::int64_t cut_elements(const Body&, LatticeState<float>&, Sleep&,
                                   std::span<const EdgeGone>) noexcept;
template std::int64_t cut_elements(const Body&, LatticeState<double>&, Sleep&,
                                   std::span<const EdgeGone>) noexcept;

}  // namespace palpate::physics
