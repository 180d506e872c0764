#include "physics_node/step/lattice/element_slots.h"

#include <limits>

#include "common/error/error.h"
#include "physics_node/body/element_constants.h"

namespace palpate::physics {
namespace {

/// (ratio - 1) L, or never, where a material does not yield.
template <class Real>
Real stretch_at(double ratio, double L) {
  const double never = std::numeric_limits<Real>::max() / 4;
  return static_cast<Real>(std::min((ratio - 1) * L, never));
}

template <class Real>
ElementSlot<Real> make_slot(const Body& body, std::size_t kind, int direction) {
  const Lattice& lattice = body.lattice;
  const auto d = static_cast<std::size_t>(direction);
  const std::size_t h = d % static_cast<std::size_t>(lattice.n_half);
  ElementSlot<Real> slot;
  slot.offset = lattice.offset[kind][d];
  slot.memory = direction < lattice.n_half ? 0 : slot.offset;
  slot.bit = 1U << d;
  slot.half = static_cast<int>(h);
  for (std::size_t a = 0; a < 3; ++a)
    slot.D[a] = static_cast<Real>(lattice.rest_vector[d][static_cast<Eigen::Index>(a)]);
  const double L = lattice.rest_length[d];
  slot.L = static_cast<Real>(L);
  slot.L2 = slot.L * slot.L;
  slot.least_q = slot.L2 * Real(-0.999999);
  slot.k1 = static_cast<Real>(body.law.k1[h]);
  slot.half_over_k1 = static_cast<Real>(0.5 / body.law.k1[h]);
  slot.k2 = static_cast<Real>(body.law.k1[h] * body.law.k2_ratio);
  slot.c = static_cast<Real>(body.law.c[h]);
  const double never = std::numeric_limits<double>::infinity();
  slot.yield = stretch_at<Real>(body.law.yields ? body.law.y_p : never, L);
  slot.snap = stretch_at<Real>(body.law.yields ? body.law.b_p : never, L);
  return slot;
}

template <class Real>
void add(SlotList<Real>& list, const ElementSlot<Real>& slot) {
  PALPATE_CHECK(list.n < max_slots, "a mass is the first end of at most max_slots elements");
  list.slot[list.n++] = slot;
}

}  // namespace

template <class Real>
void make_slots(const Body& body, std::array<SlotList<Real>, max_row_kinds>& all,
                std::array<SlotList<Real>, max_row_kinds>& level,
                std::array<SlotList<Real>, max_row_kinds>& up) {
  for (std::size_t kind = 0; kind < max_row_kinds; ++kind)
    for (const int d : body.lattice.forward[kind]) {
      const auto slot = make_slot<Real>(body, kind, d);
      add(all[kind], slot);
      add(body.lattice.leads_up(d) ? up[kind] : level[kind], slot);
    }
}

template <class Real>
VariedConstants<Real> make_varied_constants(const Body& body, std::size_t colour) {
  const auto n = static_cast<std::size_t>(body.lattice.n_cells());
  const auto n_half = static_cast<std::size_t>(body.lattice.n_half);
  VariedConstants<Real> varied;
  for (auto* constants : {&varied.k1, &varied.k2, &varied.c, &varied.yield, &varied.snap})
    for (std::size_t h = 0; h < n_half; ++h) (*constants)[h] = ZeroedArray<Real>(n, colour++);
  varied.drag = ZeroedArray<Real>(n, colour);
  for (const Index i : body.lattice.masses) {
    const auto c = static_cast<std::size_t>(i);
    varied.drag[c] = static_cast<Real>(law_at(body, i).drag);
    const auto& offset = body.lattice.offset[static_cast<std::size_t>(body.lattice.row_kind(i))];
    for (std::size_t h = 0; h < n_half; ++h) {
      if ((body.lattice.mask[c] >> h & 1) == 0) continue;
      const ElementConstants e = element_constants(body, i, i + offset[h], h);
      varied.k1[h][c] = static_cast<Real>(e.k1);
      varied.k2[h][c] = static_cast<Real>(e.k2);
      varied.c[h][c] = static_cast<Real>(e.c);
      varied.yield[h][c] = stretch_at<Real>(e.y_p, body.lattice.rest_length[h]);
      varied.snap[h][c] = stretch_at<Real>(e.b_p, body.lattice.rest_length[h]);
    }
  }
  return varied;
}

template void make_slots(const Body&, std::array<SlotList<float>, max_row_kinds>&,
                         std::array<SlotList<float>, max_row_kinds>&,
                         std::array<SlotList<float>, max_row_kinds>&);
template void make_slots(const Body&, std::array<SlotList<double>, max_row_kinds>&,
                         std::array<SlotList<double>, max_row_kinds>&,
                         std::array<SlotList<double>, max_row_kinds>&);
template VariedConstants<float> make_varied_constants(const Body&, std::size_t);
template VariedConstants<double> make_varied_constants(const Body&, std::size_t);

}  // namespace palpate::physics
