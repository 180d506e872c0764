#pragma once
// A hexahedron that is led from shape to shape and yields on its way, without a body around it.

#include <cmath>

#include "physics_node/material/stable_neo_hookean.h"
#include "physics_node/step/fem/hex_constants.h"
#include "physics_node/step/fem/hex_plastic.h"

namespace palpate::physics::test {

using Eigen::Matrix3d;
inline constexpr double E = 10e3, nu = 0.45;
inline const Vec3 edge(2e-3, 3e-3, 2.5e-3);

template <class Real>
Tensor<Real> tensor_of(const Matrix3d& m) {
  Tensor<Real> t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      t[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = static_cast<Real>(m(i, j));
  return t;
}
template <class Real>
Matrix3d matrix_of(const Tensor<Real>& t) {
  Matrix3d m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      m(i, j) = static_cast<double>(t[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
  return m;
}

/// A cell that is led from shape to shape and flows on its way.
template <class Real>
class PlasticCell {
 public:
  using One = Scalar<Real>;
  explicit PlasticCell(const Yielding& yielding)
      : k_(hex_constants<Real>({.modulus = E, .poisson_ratio = nu}, edge)),
        limit_(yield_limit(yielding, lame_of(E, nu).mu, lame_of(E, nu).lambda)) {}

  /// @param bent  hourglass modes m_xz (x), m_yz (y), m_xyz (z) besides [m]
  HexFlow<One> lead_to(const Matrix3d& F, const Vec3& bent = Vec3::Zero()) {
    return lead_corners(corners(F, bent));
  }
  HexFlow<One> lead_corners(const Corners<One>& w) {
    w_ = w;
    const HexStrained<One> now = hex_strained<One>(k_, w_);
    const HexStressed<One> is = hex_stressed<One>(k_, now, plastic_);
    const Real limit = static_cast<Real>(limit_.stress + limit_.hardening * static_cast<double>(alpha()));
    const HexFlow<One> flow = hex_flow<One>(k_, now, is, std::sqrt(is.stress2), limit,
                                            static_cast<Real>(limit_.hardening), plastic_);
    plastic_work_ +=
        static_cast<double>(flow.strain) *
        (static_cast<double>(limit) + 0.5 * limit_.hardening * static_cast<double>(flow.strain)) * mu_v();
    return flow;
  }
  Real alpha() const { return plastic_[n_plastic - 1]; }
  double mu_v() const { return static_cast<double>(k_.mu * k_.volume); }
  /// Its work so far, stress times plastic strain [J].
  double plastic_work() const { return plastic_work_; }
  /// S, over Y + K alpha.
  double load() const {
    const HexStressed<One> is = hex_stressed<One>(k_, hex_strained<One>(k_, w_), plastic_);
    return std::sqrt(static_cast<double>(is.stress2)) /
           (limit_.stress + limit_.hardening * static_cast<double>(alpha()));
  }
  /// First Piola-Kirchhoff stress over mu.
  Matrix3d stress() const {
    const HexStrained<One> now = hex_strained<One>(k_, w_);
    const StableNeoHookean<One> law{k_.mu, k_.lambda};
    const Matrix3d more = matrix_of(product<One>(now.f, plastic_strain(plastic_)));
    return matrix_of(law.stress(now.h)) / static_cast<double>(k_.mu) + more;
  }
  /// Energy of law and plastic shape at w [J].
  double energy(const Corners<One>& w, Corners<One>& f) const {
    HexForces<One> out;
    hex_forces<One, StableNeoHookean, true, true>(k_, w, out);
    const Real more = plastic_forces<One>(k_, hex_strained<One>(k_, w), plastic_, f);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t a = 0; a < 8; ++a) f[c][a] += out.f[c][a];
    return static_cast<double>(out.energy + more);
  }
  double det_plastic() const {
    return (Matrix3d::Identity() + matrix_of(plastic_strain(plastic_))).determinant();
  }
  const Plastic<Real>& plastic() const { return plastic_; }
  const Corners<One>& corners() const { return w_; }
  const HexConstants<Real>& constants() const { return k_; }

  Corners<One> corners(const Matrix3d& F, const Vec3& bent) const {
    Corners<One> w;
    for (std::size_t a = 0; a < 8; ++a) {
      const Vec3 sign((a & 1) != 0 ? 1 : -1, (a >> 1 & 1) != 0 ? 1 : -1, (a >> 2) != 0 ? 1 : -1);
      const Vec3 X = 0.5 * sign.cwiseProduct(edge);
      Vec3 u = (F - Matrix3d::Identity()) * X;
      u += Vec3(sign.x() * sign.z() * bent.x(), sign.y() * sign.z() * bent.y(), sign.prod() * bent.z()) / 8;
      for (std::size_t c = 0; c < 3; ++c) w[c][a] = static_cast<Real>(u[static_cast<Eigen::Index>(c)]);
    }
    return w;
  }

 private:
  HexConstants<Real> k_;
  YieldLimit limit_;
  Plastic<Real> plastic_{};
  Corners<One> w_{};
  double plastic_work_ = 0;
};

/// A bar whose sides are free: its width t that takes all stress from them, by bisection.
inline double lead_bar(PlasticCell<double>& cell, double stretch) {
  double lo = 0.2, hi = 4;
  for (int n = 0; n < 100; ++n) {
    const double t = 0.5 * (lo + hi);
    PlasticCell<double> trial = cell;
    trial.lead_to(Vec3(stretch, t, t).asDiagonal());
    (trial.stress()(1, 1) > 0 ? hi : lo) = t;
  }
  cell.lead_to(Vec3(stretch, lo, lo).asDiagonal());
  return lo;
}

}  // namespace palpate::physics::test
