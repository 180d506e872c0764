#include "physics_node/step/lattice/lattice_spectrum.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpate::physics {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr int n_waves = 12;  // wave numbers along each axis, between 0 and pi

double largest_of_fcc(const Lattice& lattice, const std::array<double, max_half>& k, const Vec3& q) {
  const auto directions = half_directions(lattice.kind);
  Eigen::Matrix3d D = Eigen::Matrix3d::Zero();
  for (std::size_t h = 0; h < directions.size(); ++h) {
    const Vec3 n = lattice.rest_vector[h] / lattice.rest_length[h];
    D += 2 * k[h] * (1 - std::cos(q.dot(directions[h].cast<double>()))) * n * n.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(D, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

double largest_of_voxels(const Lattice& lattice, const std::array<double, max_half>& k, const Vec3& q) {
  const auto directions = half_directions(lattice.kind);
  Matrix6 D = Matrix6::Zero();  // even masses first
  for (std::size_t h = 0; h < directions.size(); ++h) {
    const Vec3 n = lattice.rest_vector[h] / lattice.rest_length[h];
    const Eigen::Matrix3d two_k = 2 * k[h] * n * n.transpose();
    const double wave = std::cos(q.dot(directions[h].cast<double>()));
    D.topLeftCorner<3, 3>() += two_k;
    if (directions[h].cwiseAbs().sum() == 2) {  // a diagonal joins even masses
      D.topLeftCorner<3, 3>() -= wave * two_k;
    } else {  // an edge joins an even and an odd one
      D.bottomRightCorner<3, 3>() += two_k;
      D.topRightCorner<3, 3>() -= wave * two_k;
      D.bottomLeftCorner<3, 3>() -= wave * two_k;
    }
  }
  return Eigen::SelfAdjointEigenSolver<Matrix6>(D, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

}  // namespace

double largest_eigenvalue(const Lattice& lattice, const std::array<double, max_half>& k) {
  double largest = 0;
  for (int x = 0; x <= n_waves; ++x)
    for (int y = 0; y <= n_waves; ++y)
      for (int z = 0; z <= n_waves; ++z) {
        const Vec3 q = std::numbers::pi / n_waves * Vec3(x, y, z);
        largest = std::max(largest, lattice.kind == LatticeKind::fcc ? largest_of_fcc(lattice, k, q)
                                                                     : largest_of_voxels(lattice, k, q));
      }
  return largest;
}

}  // namespace palpate::physics
