#include "physics_node/step/measure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>

namespace palpate::physics {
namespace {

template <class Real>
Vec3 vector_of(const Three<Real>& three, Index cell) {
  const auto c = static_cast<std::size_t>(cell);
  return {static_cast<double>(three[0][c]), static_cast<double>(three[1][c]),
          static_cast<double>(three[2][c])};
}

/// Calls visit(cell, half direction, stretch l / L, static force) for every live element.
template <class Real, class Visit>
void for_each_element(const Body& body, const LatticeState<Real>& s, const Visit& visit) {
  const Lattice& lattice = body.lattice;
  for (const Index i : lattice.masses) {
    const auto c = static_cast<std::size_t>(i);
    const auto parity = static_cast<std::size_t>(lattice.row_parity(i));
    for (std::size_t d = 0; d < static_cast<std::size_t>(lattice.n_half); ++d) {
      if (((s.mask[c] >> d) & 1) == 0) continue;
      const Index j = i + lattice.offset[parity][d];
      const double L = lattice.rest_length[d];
      const double l = (lattice.rest_vector[d] + vector_of(s.u, j) - vector_of(s.u, i)).norm();
      double f = body.law.k1[d] * (l - L);
      if (body.law.yields) {
        const auto l_c = static_cast<double>(s.l_c[d][c]);
        const double l_y = static_cast<double>(s.y_p[d][c]) * L;
        f = l > l_y ? body.law.k1[d] * (l_y - L - l_c) + body.law.k1[d] * body.law.k2_ratio * (l - l_y)
                    : body.law.k1[d] * (l - L - l_c);
      }
      visit(i, d, l / L, f);
    }
  }
}

}  // namespace

template <class Real>
Energies measure_energies(const Body& body, const LatticeState<Real>& state, const Vec3& gravity) {
  Energies e;
  for (const Index i : body.lattice.masses) {
    if (body.inverse_mass[static_cast<std::size_t>(i)] == 0) continue;
    e.kinetic += 0.5 * body.law.mass * vector_of(state.v, i).squaredNorm();
    e.gravitational -= body.law.mass * gravity.dot(vector_of(state.u, i));
  }
  for_each_element(body, state, [&](Index, std::size_t d, double, double f) {
    e.elastic += f * f / (2 * body.law.k1[d]);
  });
  return e;
}

template <class Real>
Momenta measure_momenta(const Body& body, const LatticeState<Real>& state) {
  Momenta p;
  for (const Index i : body.lattice.masses) {
    const Vec3 mv = body.law.mass * vector_of(state.v, i);
    p.linear += mv;
    p.angular += (body.lattice.rest_position(i) + vector_of(state.u, i)).cross(mv);
  }
  return p;
}

template <class Real>
BodyCounts measure_counts(const Body& body, const LatticeState<Real>& state) {
  BodyCounts counts;
  counts.elements = body.lattice.n_elements();
  for_each_element(body, state, [&](Index, std::size_t, double stretch, double) {
    ++counts.live_elements;
    counts.max_stretch = std::max(counts.max_stretch, stretch);
  });
  Eigen::Matrix3Xd rest(3, body.lattice.n_masses());
  Eigen::Matrix3Xd now(3, body.lattice.n_masses());
  Eigen::Index column = 0;
  for (const Index i : body.lattice.masses) {
    if ((state.flags[static_cast<std::size_t>(i)] & mass_yielded) != 0) ++counts.yielded_masses;
    rest.col(column) = body.lattice.rest_position(i);
    now.col(column++) = body.lattice.rest_position(i) + vector_of(state.u, i);
  }
  counts.shape_rms = rigid_fit_rms(rest, now);
  return counts;
}

double rigid_fit_rms(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  const Eigen::Matrix4d X = Eigen::umeyama(from, to, false);
  const Eigen::Matrix3Xd moved =
      (X.topLeftCorner<3, 3>() * from).colwise() + Eigen::Vector3d(X.topRightCorner<3, 1>());
  return std::sqrt((moved - to).squaredNorm() / static_cast<double>(from.cols()));
}

template Energies measure_energies(const Body&, const LatticeState<float>&, const Vec3&);
template Energies measure_energies(const Body&, const LatticeState<double>&, const Vec3&);
template Momenta measure_momenta(const Body&, const LatticeState<float>&);
template Momenta measure_momenta(const Body&, const LatticeState<double>&);
template BodyCounts measure_counts(const Body&, const LatticeState<float>&);
template BodyCounts measure_counts(const Body&, const LatticeState<double>&);

}  // namespace palpate::physics
