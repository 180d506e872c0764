// The kernels of a level that go from node to node. Loops as they stand: the compiler makes vectors of them, and every number is a
// node's own but for sums, which have sixteen parts on all machines.

#if defined(__clang__)
#define PALPATE_NO_ALIAS _Pragma("clang loop vectorize(assume_safety)")
#else
#define PALPATE_NO_ALIAS _Pragma("GCC ivdep")
#endif

namespace palpate::physics::PALPATE_KERNEL {
namespace {

/// A p of one component of one node, and leaves nothing behind.
template <class Real>
inline Real take(const LevelContext<Real>& m, const NodeVector<Real>& p, std::size_t c, Index i) {
  const Real y = m.free[i] * (m.mass[i] * p[c][i] + (m.low[c][i] + m.high[c][i]));
  m.low[c][i] = m.high[c][i] = 0;
  return y;
}

/// Entry c of D^-1 r of a node.
template <class Real>
inline std::array<Real, 3> scaled(const LevelContext<Real>& m, Index i) {
  const Real x = m.r[0][i], y = m.r[1][i], z = m.r[2][i];
  return {m.inverse[0][i] * x + m.inverse[5][i] * y + m.inverse[4][i] * z,
          m.inverse[5][i] * x + m.inverse[1][i] * y + m.inverse[3][i] * z,
          m.inverse[4][i] * x + m.inverse[3][i] * y + m.inverse[2][i] * z};
}

template <class Real>
void invert_blocks(const LevelContext<Real>& m, Index plane) {
  for (Index i = m.planes[plane].first; i < m.planes[plane].last; ++i) {
    Real b[6];
    for (std::size_t e = 0; e < 6; ++e) {
      b[e] = m.inverse[e][i] + m.block_high[e][i] + (e < 3 ? m.mass[i] : Real(0));
      m.block_high[e][i] = 0;
    }
    // Scaled, so that float does not overflow.
    const Real size = b[0] + b[1] + b[2], over = m.free[i] > 0 && size > 0 ? 1 / size : Real(0);
    for (Real& e : b) e *= over;
    const Real XX = b[1] * b[2] - b[3] * b[3], XY = b[4] * b[3] - b[5] * b[2], XZ = b[5] * b[3] - b[4] * b[1];
    const Real det = b[0] * XX + b[5] * XY + b[4] * XZ;
    const Real scale = det > 0 ? over / det : Real(0);
    m.inverse[0][i] = scale * XX;
    m.inverse[1][i] = scale * (b[0] * b[2] - b[4] * b[4]);
    m.inverse[2][i] = scale * (b[0] * b[1] - b[5] * b[5]);
    m.inverse[3][i] = scale * (b[5] * b[4] - b[0] * b[3]);
    m.inverse[4][i] = scale * XZ;
    m.inverse[5][i] = scale * XY;
  }
}

template <class Real>
void begin(const LevelContext<Real>& m, Index plane, Real c) {
  PALPATE_NO_ALIAS
  for (Index i = m.planes[plane].first; i < m.planes[plane].last; ++i) {
    const std::array<Real, 3> step = scaled(m, i);
    for (std::size_t a = 0; a < 3; ++a) m.x[a][i] = m.d[a][i] = c * step[a];
  }
}

template <class Real>
void smooth(const LevelContext<Real>& m, Index plane, Real c1, Real c2) {
  PALPATE_NO_ALIAS
  for (Index i = m.planes[plane].first; i < m.planes[plane].last; ++i) {
    for (std::size_t a = 0; a < 3; ++a) m.r[a][i] -= take(m, m.d, a, i);
    const std::array<Real, 3> step = scaled(m, i);
    for (std::size_t a = 0; a < 3; ++a) {
      const Real d = c1 * m.d[a][i] + c2 * step[a];
      m.d[a][i] = d;
      m.x[a][i] += d;
    }
  }
}

template <class Real>
void residual(const LevelContext<Real>& m, Index plane) {
  PALPATE_NO_ALIAS
  for (Index i = m.planes[plane].first; i < m.planes[plane].last; ++i)
    for (std::size_t a = 0; a < 3; ++a) m.r[a][i] -= take(m, m.d, a, i);
}

/// Sum over the nodes of a plane, in sixteen parts.
template <class Real>
double plane_dot(const NodeVector<Real>& p, const NodeVector<Real>& q, const GridPlane& plane) {
  double parts[16] = {};
  for (std::size_t a = 0; a < 3; ++a) {
    Index i = plane.first;
    for (; i + 16 <= plane.last; i += 16)
      for (int n = 0; n < 16; ++n)
        parts[n] += static_cast<double>(p[a][i + n]) * static_cast<double>(q[a][i + n]);
    for (int n = 0; i < plane.last; ++i, ++n)
      parts[n] += static_cast<double>(p[a][i]) * static_cast<double>(q[a][i]);
  }
  double sum = 0;
  for (const double part : parts) sum += part;
  return sum;
}

template <class Real>
double keep(const LevelContext<Real>& m, const NodeVector<Real>& p, const NodeVector<Real>& q, Index plane) {
  PALPATE_NO_ALIAS
  for (Index i = m.planes[plane].first; i < m.planes[plane].last; ++i)
    for (std::size_t a = 0; a < 3; ++a) q[a][i] = take(m, p, a, i);
  return plane_dot(p, q, m.planes[plane]);
}

template <class Real>
void gather(const LevelContext<Real>& m, const NodeVector<Real>& f, Index plane) {
  PALPATE_NO_ALIAS
  for (Index i = m.planes[plane].first; i < m.planes[plane].last; ++i)
    for (std::size_t a = 0; a < 3; ++a) {
      f[a][i] = m.free[i] * (m.low[a][i] + m.high[a][i]);
      m.low[a][i] = m.high[a][i] = 0;
    }
}

}  // namespace
}  // namespace palpate::physics::PALPATE_KERNEL
