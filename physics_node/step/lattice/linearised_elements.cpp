#include "physics_node/step/lattice/linearised_elements.h"

#include <algorithm>
#include <cmath>

#include "physics_node/step/lattice/trial_element.h"

namespace palpate::physics {
namespace {

void add_at(Field& field, Index cell, const Vec3& v) {
  for (std::size_t a = 0; a < 3; ++a)
    field[a][static_cast<std::size_t>(cell)] += v[static_cast<Eigen::Index>(a)];
}

/// visit(slot number, slot, cell) for every live element, in storage order.
template <class Real, class Visit>
void for_each_live(const Body& body, const LatticeState<Real>& state, const Visit& visit) {
  for (const RowSegment& row : body.lattice.rows) {
    const SlotList<Real>& list = state.all[static_cast<std::size_t>(row.kind)];
    for (int n = 0; n < list.n; ++n)
      for (Index i = row.first; i < row.first + row.count; ++i)
        if ((state.mask[static_cast<std::size_t>(i)] & list.slot[n].bit) != 0)
          visit(static_cast<std::size_t>(n), list.slot[n], i);
  }
}

/// t := a n (n . y) + b (y - n (n . y)) of a row's elements; out += t at one end, -= t at the other. No sums across
/// lanes and no fused operations, so that every width gives the same bits.
__attribute__((target_clones("avx512f", "avx2", "default"))) void product_of_row(
    Index count, Index offset, const double* const n[3], const double* a, const double* b,
    const double* const y[3], double* const out[3]) {
  constexpr Index block = 64;
  double t[3][block];
  for (Index begin = 0; begin < count; begin += block) {
    const Index size = std::min(block, count - begin);
    for (Index i = 0; i < size; ++i) {
      const Index k = begin + i;
      const double y0 = y[0][k] - y[0][k + offset];
      const double y1 = y[1][k] - y[1][k + offset];
      const double y2 = y[2][k] - y[2][k + offset];
      const double along = (a[k] - b[k]) * (n[0][k] * y0 + n[1][k] * y1 + n[2][k] * y2);
      t[0][i] = b[k] * y0 + along * n[0][k];
      t[1][i] = b[k] * y1 + along * n[1][k];
      t[2][i] = b[k] * y2 + along * n[2][k];
    }
    for (int axis = 0; axis < 3; ++axis) {
      for (Index i = 0; i < size; ++i) out[axis][begin + i] += t[axis][i];
      for (Index i = 0; i < size; ++i) out[axis][begin + i + offset] -= t[axis][i];
    }
  }
}

}  // namespace

template <class Real>
LinearisedElements<Real>::LinearisedElements(const Body& body) {
  const auto n = static_cast<std::size_t>(body.lattice.n_cells());
  std::size_t most = 0;
  for (const auto& forward : body.lattice.forward) most = std::max(most, forward.size());
  std::size_t colour = 0;
  for (std::size_t s = 0; s < most; ++s) {
    for (auto& axis : slots_[s].n) axis = ZeroedArray<double>(n, colour++);
    slots_[s].a = ZeroedArray<double>(n, colour++);
    slots_[s].b = ZeroedArray<double>(n, colour++);
  }
}

template <class Real>
void LinearisedElements<Real>::add_drag(const Body& body, const LatticeState<Real>& state,
                                        ZeroedArray<double>& drag) const {
  for_each_live(body, state, [&](std::size_t, const ElementSlot<Real>& slot, Index i) {
    const double c = trial_element(body, state, slot, i, Vec3::Zero()).c;
    drag[static_cast<std::size_t>(i)] += c;
    drag[static_cast<std::size_t>(i + slot.offset)] += c;
  });
}

template <class Real>
void LinearisedElements<Real>::evaluate(const Body& body, const LatticeState<Real>& state, const Field& D,
                                        double dt, Field& force) {
  const Damper damper = body.law.damper;
  const bool breaks = any_breaks(body);
  // A broken element's a and b must not outlive it.
  for (auto& slot : slots_)
    for (const RowSegment& row : body.lattice.rows)
      if (breaks && slot.a.size() > 0) {
        std::fill_n(slot.a.data() + row.first, row.count, 0.0);
        std::fill_n(slot.b.data() + row.first, row.count, 0.0);
      }
  for_each_live(body, state, [&](std::size_t n, const ElementSlot<Real>& slot, Index i) {
    const Vec3 shift = vector_at(D, i + slot.offset) - vector_at(D, i);
    const TrialElement e = trial_element(body, state, slot, i, shift);
    const double c = damper == Damper::axial ? e.c : 0.0;
    const double c_all = damper == Damper::relative ? e.c : 0.0;
    const double f = e.f_s + c * shift.dot(e.n) / dt;
    const Vec3 pull = f * e.n + c_all / dt * shift;
    add_at(force, i, pull);
    add_at(force, i + slot.offset, -pull);
    const auto cell = static_cast<std::size_t>(i);
    for (std::size_t axis = 0; axis < 3; ++axis)
      slots_[n].n[axis][cell] = e.n[static_cast<Eigen::Index>(axis)];
    slots_[n].a[cell] = e.k + (c + c_all) / dt;
    slots_[n].b[cell] = f / e.l + c_all / dt;
  });
}

template <class Real>
void LinearisedElements<Real>::add_product(const Body& body, const Field& y, Field& out) const {
  for (const RowSegment& row : body.lattice.rows) {
    const auto kind = static_cast<std::size_t>(row.kind);
    for (std::size_t s = 0; s < body.lattice.forward[kind].size(); ++s) {
      const Slot& slot = slots_[s];
      const Index offset = body.lattice.offset[kind][static_cast<std::size_t>(body.lattice.forward[kind][s])];
      const double* const n[3] = {slot.n[0].data() + row.first, slot.n[1].data() + row.first,
                                  slot.n[2].data() + row.first};
      const double* const from[3] = {y[0].data() + row.first, y[1].data() + row.first,
                                     y[2].data() + row.first};
      double* const to[3] = {out[0].data() + row.first, out[1].data() + row.first, out[2].data() + row.first};
      product_of_row(row.count, offset, n, slot.a.data() + row.first, slot.b.data() + row.first, from, to);
    }
  }
}

template <class Real>
void LinearisedElements<Real>::add_blocks(const Body& body,
                                          std::array<ZeroedArray<double>, 6>& blocks) const {
  constexpr int first[6] = {0, 1, 2, 1, 0, 0};
  constexpr int second[6] = {0, 1, 2, 2, 2, 1};
  for (const RowSegment& row : body.lattice.rows) {
    const auto kind = static_cast<std::size_t>(row.kind);
    for (std::size_t s = 0; s < body.lattice.forward[kind].size(); ++s) {
      const Slot& slot = slots_[s];
      const Index offset = body.lattice.offset[kind][static_cast<std::size_t>(body.lattice.forward[kind][s])];
      for (std::size_t e = 0; e < 6; ++e)
        for (Index i = row.first; i < row.first + row.count; ++i) {
          const auto c = static_cast<std::size_t>(i);
          const double b = std::max(0.0, slot.b[c]);
          const double part =
              (slot.a[c] - b) * slot.n[first[e]][c] * slot.n[second[e]][c] + (e < 3 ? b : 0.0);
          blocks[e][c] += part;
          blocks[e][static_cast<std::size_t>(i + offset)] += part;
        }
    }
  }
}

template <class Real>
StepLosses LinearisedElements<Real>::losses(const Body& body, const LatticeState<Real>& state, const Field& D,
                                            double dt) const {
  StepLosses lost;
  for_each_live(body, state, [&](std::size_t, const ElementSlot<Real>& slot, Index i) {
    const Vec3 shift = vector_at(D, i + slot.offset) - vector_at(D, i);
    const TrialElement before = trial_element(body, state, slot, i, Vec3::Zero());
    const TrialElement after = trial_element(body, state, slot, i, shift);
    const double along = shift.dot(after.n);
    if (body.law.damper != Damper::drag)
      lost.viscous += after.c / dt * (body.law.damper == Damper::axial ? along * along : shift.squaredNorm());
    lost.numerical += after.f_s * along - (after.stored - before.stored) - after.taken;
  });
  return lost;
}

template class LinearisedElements<float>;
template class LinearisedElements<double>;

}  // namespace palpate::physics
