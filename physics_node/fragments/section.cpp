#include "physics_node/fragments/section.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>

namespace palpate::physics {

std::int64_t middle_section(const Lattice& lattice) {
  Vec3 centre = Vec3::Zero();
  for (const Index cell : lattice.masses) centre += lattice.rest_position(cell);
  centre /= static_cast<double>(lattice.n_masses());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Index cell : lattice.masses) {
    const Vec3 r = lattice.rest_position(cell) - centre;
    spread += r * r.transpose();
  }
  const Vec3 axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
  // Not through a layer of masses, where rounding would choose sides.
  const double height = axis.dot(centre) + 1e-3 * lattice.spacing();
  std::int64_t crossing = 0;
  for (const Index cell : lattice.masses) {
    const double h = axis.dot(lattice.rest_position(cell)) - height;
    Mask half = lattice.mask[static_cast<std::size_t>(cell)] & ((Mask{1} << lattice.n_half) - 1);
    for (; half != 0; half &= half - 1)
      if ((h < 0) !=
          (h + axis.dot(lattice.rest_vector[static_cast<std::size_t>(std::countr_zero(half))]) < 0))
        ++crossing;
  }
  return std::max<std::int64_t>(crossing, 1);
}

}  // namespace palpate::physics
