// The element kernel, compiled once per instruction set: element_kernel_{sse2,avx2,avx512}.cpp define PALPATE_KERNEL
// and include this. All sets give the same bits: only IEEE operations, no fused multiply-add, no approximations.
//
// Per element from mass i to its neighbour j, with D the rest vector, L its length, d = u_j - u_i:
//
//   q   = d . (2 D + d)                   = l^2 - L^2, without the cancellation of l - L
//   l   = sqrt(L^2 + q)
//   elastic:  f_s / l = k1 (l - L) / l    = k1 q / (l^2 + L l)
//   damper:   c l' / l = c (dv . x) / l^2,  x = D + d
//
// so a stretch of one part in a million is as exact in single precision as the displacements are.

#include <utility>

#include "physics_node/step/element_context.h"
#include "physics_node/step/pack.h"

namespace palpate::physics::PALPATE_KERNEL {
namespace {

template <class Real, KernelKind kind, int d>
inline __attribute__((always_inline)) void add_element(const ElementContext<Real>& m, Index i, Index o,
                                                       typename Pack<Real>::I masks, const typename Pack<Real>::V (&u)[3],
                                                       const typename Pack<Real>::V (&v)[3], typename Pack<Real>::V (&f)[3]) {
  using P = Pack<Real>;
  using V = typename P::V;
  constexpr int n_half = kind.fcc ? 6 : 9;
  const V L = P::all(m.L[d]);
  const V d0 = P::load(m.u[0] + i + o) - u[0];
  const V d1 = P::load(m.u[1] + i + o) - u[1];
  const V d2 = P::load(m.u[2] + i + o) - u[2];
  const V x0 = d0 + m.D[0][d];
  const V x1 = d1 + m.D[1][d];
  const V x2 = d2 + m.D[2][d];
  V q = d0 * (x0 + m.D[0][d]) + d1 * (x1 + m.D[1][d]) + d2 * (x2 + m.D[2][d]);
  // A collapsed element has no direction: l is never taken below L / 1000.
  q = P::larger(q, P::all(m.L[d] * m.L[d] * Real(-0.999999)));
  const V l2 = L * L + q;
  const V l = P::square_root(l2);
  V s;
  if constexpr (kind.yields) {
    constexpr int h = d % n_half;
    const Index owner = d < n_half ? i : i + o;  // the mass from which the direction is of the first half
    const V l_c = P::load(m.l_c[h] + owner);
    const V y_p = P::load(m.y_p[h] + owner);
    const V stretch = q / (l + L);               // l - L
    const V beyond = stretch - (y_p - Real(1)) * L;  // l - y_p L
    const V elastic = m.k1[d] * (stretch - l_c);
    const V plastic = m.k1[d] * ((y_p - Real(1)) * L - l_c) + m.k2[d] * beyond;
    V force = beyond > V{} ? plastic : elastic;
    if constexpr (kind.damped) {
      const V rate = (P::load(m.v[0] + i + o) - v[0]) * x0 + (P::load(m.v[1] + i + o) - v[1]) * x1 +
                     (P::load(m.v[2] + i + o) - v[2]) * x2;
      force += m.c[d] * rate / l;
    }
    s = force / l;
  } else if constexpr (kind.damped) {
    const V rate = (P::load(m.v[0] + i + o) - v[0]) * x0 + (P::load(m.v[1] + i + o) - v[1]) * x1 +
                   (P::load(m.v[2] + i + o) - v[2]) * x2;
    const V e = l2 + L * l;
    s = (m.k1[d] * q * l2 + m.c[d] * rate * e) / (e * l2);
  } else {
    s = m.k1[d] * q / (l2 + L * l);
  }
  s = P::where_bit(masks, d, s);
  f[0] += s * x0;
  f[1] += s * x1;
  f[2] += s * x2;
}

template <class Real, KernelKind kind, int... d>
void step_rows(const ElementContext<Real>& m, Index first_row, Index last_row,
               std::integer_sequence<int, d...>) {
  using P = Pack<Real>;
  using V = typename P::V;
  for (Index r = first_row; r < last_row; ++r) {
    const RowSegment row = m.rows[r];
    const Index* o = m.offset[row.parity];
    // Whole packs only: the cells beyond a row's end are empty, and stepping an empty cell leaves it as it is.
    for (Index i = row.first; i < row.first + row.count; i += P::width) {
      const typename P::I masks = P::load_masks(m.mask + i);
      const V u[3] = {P::load(m.u[0] + i), P::load(m.u[1] + i), P::load(m.u[2] + i)};
      const V v[3] = {P::load(m.v[0] + i), P::load(m.v[1] + i), P::load(m.v[2] + i)};
      V f[3] = {};
      (add_element<Real, kind, d>(m, i, o[d], masks, u, v, f), ...);
      const V w = P::load(m.inverse_mass + i);
      for (int a = 0; a < 3; ++a) {
        // A held mass has inverse mass zero: neither force nor gravity moves it.
        const V gravity = w > V{} ? P::all(m.g[a]) : V{};
        const V next_v = v[a] + m.dt * (f[a] * w + gravity);
        P::store(m.next_v[a] + i, next_v);
        P::store(m.next_u[a] + i, u[a] + m.dt * next_v);
      }
    }
  }
}

template <class Real, bool fcc, bool damped, bool yields>
void kernel(const ElementContext<Real>& m, Index first_row, Index last_row) {
  step_rows<Real, KernelKind{fcc, damped, yields}>(m, first_row, last_row,
                                                   std::make_integer_sequence<int, fcc ? 12 : 18>());
}

template <class Real, bool fcc>
ElementKernel<Real> by_material(KernelKind kind) {
  if (kind.yields) return kind.damped ? &kernel<Real, fcc, true, true> : &kernel<Real, fcc, false, true>;
  return kind.damped ? &kernel<Real, fcc, true, false> : &kernel<Real, fcc, false, false>;
}

}  // namespace

template <class Real>
ElementKernel<Real> element_kernel(KernelKind kind) {
  return kind.fcc ? by_material<Real, true>(kind) : by_material<Real, false>(kind);
}

template ElementKernel<float> element_kernel<float>(KernelKind);
template ElementKernel<double> element_kernel<double>(KernelKind);

}  // namespace palpate::physics::PALPATE_KERNEL
