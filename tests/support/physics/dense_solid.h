#pragma once
// A small body of hexahedra as two dense matrices, from the element's own forces: what faster ways are measured against.

#include <Eigen/Core>
#include <vector>

#include "physics_node/body/body.h"
#include "physics_node/step/fem/hex_stiffness.h"
#include "physics_node/step/multigrid/grid_level.h"

namespace palpate::physics::test {

struct DenseSolid {
  Eigen::MatrixXd K;             // of what is free, near rest [N/m]
  Eigen::VectorXd M;             // lumped, of each component [kg]
  std::vector<Eigen::Index> at;  // of each node of the body, its first row; -1: held, or none

  DenseSolid(const Body& body, const HexMaterial& material)
      : at(static_cast<std::size_t>(body.capacity()), -1) {
    const BodyGrid grid = body_grid(body);
    Eigen::Index n = 0;
    for (const Index node : grid.storage)
      if (node >= 0 && body.inverse_mass[static_cast<std::size_t>(node)] > 0)
        at[static_cast<std::size_t>(node)] = n, n += 3;
    K = Eigen::MatrixXd::Zero(n, n);
    M.resize(n);
    for (const Index node : grid.storage)
      if (const Eigen::Index row = node < 0 ? -1 : at[static_cast<std::size_t>(node)]; row >= 0)
        M.segment<3>(row).setConstant(node_mass(body, node));
    const HexMatrix unit = hex_stiffness(material, body.lattice.step);
    const auto row = [&](const GridCell& cell, int a) {
      return at[static_cast<std::size_t>(
          grid.storage[static_cast<std::size_t>(cell.corner[static_cast<std::size_t>(a)])])];
    };
    for (const GridCell& cell : grid.level.cells)
      for (int a = 0; a < 8; ++a)
        for (int b = 0; b < 8; ++b)
          if (row(cell, a) >= 0 && row(cell, b) >= 0)
            K.block<3, 3>(row(cell, a), row(cell, b)) += cell.stiffness * unit.block<3, 3>(3 * a, 3 * b);
  }
};

}  // namespace palpate::physics::test
