#include "bench/problems/hex_beam.h"

#include <Eigen/SparseCholesky>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "physics_node/step/fem/hex_stiffness.h"

namespace palpate::bench {

HexBeam::HexBeam(const Cantilever& how) : how_(how), edge_(height / how.cells) { solve(); }

double HexBeam::timoshenko() const {
  const double area = height * height, inertia = area * area / 12, q = density * gravity * area;
  const double shear_modulus = modulus / (2 * (1 + how_.poisson_ratio)), kappa = 5.0 / 6;
  return q * std::pow(length, 4) / (8 * modulus * inertia) +
         q * length * length / (2 * kappa * shear_modulus * area);
}

double HexBeam::calculix() const {
  if (how_.poisson_ratio == 0.3) return 0.246570e-3;
  if (how_.poisson_ratio == 0.45) return 0.242376e-3;
  if (how_.poisson_ratio == 0.49) return 0.240330e-3;
  throw std::invalid_argument("no reference for this Poisson's ratio");
}

Vec3 HexBeam::displacement(const Vec3& x) const {
  const Eigen::Vector3i at = ((x + Vec3(0, height / 2, height / 2)) / edge_).array().round().cast<int>();
  return at.x() == 0 ? Vec3::Zero() : Vec3(u_.segment<3>(3 * node(at.x(), at.y(), at.z())));
}

int HexBeam::node(int i, int j, int k) const {
  return (i - 1) + 8 * how_.cells * (j + (how_.cells + 1) * k);  // i > 0: the end is held
}

void HexBeam::solve() {
  const physics::HexMatrix stiffness = physics::hex_stiffness(
      {.modulus = modulus, .poisson_ratio = how_.poisson_ratio, .hourglass = how_.hourglass},
      Vec3::Constant(edge_));
  const int n = how_.cells, nx = 8 * n, n_nodes = nx * (n + 1) * (n + 1);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * n_nodes);
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < nx; ++i) {
        std::array<int, 8> at;
        for (int a = 0; a < 8; ++a)
          at[static_cast<std::size_t>(a)] =
              i + (a & 1) == 0 ? -1 : node(i + (a & 1), j + (a >> 1 & 1), k + (a >> 2));
        for (int a = 0; a < 8; ++a) {
          const int p = at[static_cast<std::size_t>(a)];
          if (p < 0) continue;
          f[3 * p + 2] -= density * gravity * std::pow(edge_, 3) / 8;
          for (int b = 0; b < 8; ++b) {
            const int q = at[static_cast<std::size_t>(b)];
            if (q < 0) continue;
            for (int c = 0; c < 9; ++c)
              entries.emplace_back(3 * p + c / 3, 3 * q + c % 3, stiffness(3 * a + c / 3, 3 * b + c % 3));
          }
        }
      }
  Eigen::SparseMatrix<double> K(3 * n_nodes, 3 * n_nodes);
  K.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(K);
  u_ = solver.solve(f);
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j) tip_ -= u_[3 * node(nx, j, k) + 2] / ((n + 1) * (n + 1));
}

}  // namespace palpate::bench
