#include "physics_node/fragments/section.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace palpate::physics {

std::int64_t middle_section(const Body& body) {
  Vec3 centre = Vec3::Zero();
  for (const Index cell : body.nodes()) centre += body.rest_position(cell);
  centre /= static_cast<double>(body.n_nodes());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Index cell : body.nodes()) {
    const Vec3 r = body.rest_position(cell) - centre;
    spread += r * r.transpose();
  }
  const Vec3 axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
  // Not through a layer of masses, where rounding would choose sides.
  const double height = axis.dot(centre) + 1e-3 * body.spacing();
  std::int64_t crossing = 0;
  if (body.solid) {
    for (const Index cell : body.nodes()) {
      if (body.solid->stiffness[static_cast<std::size_t>(cell)] <= 0) continue;
      int below = 0;
      for (int a = 0; a < 8; ++a) {
        const Vec3i corner = body.lattice.grid_of(cell) + Vec3i(a & 1, a >> 1 & 1, a >> 2);
        below += axis.dot(body.rest_position(body.lattice.cell_of(corner))) < height ? 1 : 0;
      }
      crossing += below > 0 && below < 8 ? 1 : 0;
    }
    return std::max<std::int64_t>(crossing, 1);
  }
  const Adjacency whole = body.adjacency();
  for (const Index cell : body.nodes()) {
    const double h = axis.dot(body.rest_position(cell)) - height;
    whole.each_neighbour(cell, [&](Index other) {
      if (h < 0 && axis.dot(body.rest_position(other)) - height >= 0) ++crossing;
    });
  }
  return std::max<std::int64_t>(crossing, 1);
}

}  // namespace palpate::physics
