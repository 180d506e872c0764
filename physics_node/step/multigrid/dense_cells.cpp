#include "physics_node/step/multigrid/dense_cells.h"

namespace palpate::physics {
namespace {

/// Of corner b of a coarse cell in corner a of one of its parts.
double share_of(const GridCell& part, Eigen::Index a, const GridCell& whole, Eigen::Index b) {
  double share = 1;
  for (int i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    const int local = part.at[axis] + static_cast<int>(a >> i & 1) - 2 * whole.at[axis];
    share *= 0.5 * ((b >> i & 1) != 0 ? local : 2 - local);
  }
  return share;
}

/// Displacements of the corners of a part from those of its coarse cell.
HexMatrix interpolation(const GridLevel& fine, const GridCell& part, const GridCell& whole) {
  HexMatrix q = HexMatrix::Zero();
  for (Eigen::Index a = 0; a < 8; ++a)
    for (Eigen::Index b = 0; b < 8; ++b)
      if (fine.held[static_cast<std::size_t>(part.corner[static_cast<std::size_t>(a)])] == 0)
        q.block<3, 3>(3 * a, 3 * b) = share_of(part, a, whole, b) * Eigen::Matrix3d::Identity();
  return q;
}

/// Is some corner of it held that lies between nodes which are not?
bool says_too_little(const GridLevel& fine, const GridCell& part, const GridLevel& coarse) {
  const GridCell& whole = coarse.cells[static_cast<std::size_t>(part.parent)];
  for (Eigen::Index a = 0; a < 8; ++a) {
    if (fine.held[static_cast<std::size_t>(part.corner[static_cast<std::size_t>(a)])] == 0) continue;
    for (Eigen::Index b = 0; b < 8; ++b)
      if (share_of(part, a, whole, b) > 0 &&
          coarse.held[static_cast<std::size_t>(whole.corner[static_cast<std::size_t>(b)])] == 0)
        return true;
  }
  return false;
}

}  // namespace

std::vector<DenseCell> dense_cells(const GridLevel& fine, std::span<const DenseCell> of_fine,
                                   const HexMatrix& unit, const GridLevel& coarse) {
  std::vector<const HexMatrix*> own(fine.cells.size(), nullptr);
  for (const DenseCell& cell : of_fine) own[static_cast<std::size_t>(cell.cell)] = &cell.stiffness;
  std::vector<Index> number(coarse.cells.size(), -1);
  std::vector<DenseCell> dense;
  for (std::size_t n = 0; n < fine.cells.size(); ++n) {
    const GridCell& part = fine.cells[n];
    bool any = own[n] != nullptr;
    any = any || says_too_little(fine, part, coarse);
    if (any) number[static_cast<std::size_t>(part.parent)] = 0;
  }
  for (std::size_t n = 0; n < number.size(); ++n)
    if (number[n] == 0) {
      number[n] = static_cast<Index>(dense.size());
      dense.push_back({static_cast<Index>(n), HexMatrix::Zero()});
    }
  for (std::size_t n = 0; n < fine.cells.size(); ++n) {
    const GridCell& part = fine.cells[n];
    const Index to = number[static_cast<std::size_t>(part.parent)];
    if (to < 0) continue;
    const HexMatrix q = interpolation(fine, part, coarse.cells[static_cast<std::size_t>(part.parent)]);
    const HexMatrix k = own[n] != nullptr ? *own[n] : HexMatrix(part.stiffness * unit);
    dense[static_cast<std::size_t>(to)].stiffness += q.transpose() * k * q;
  }
  return dense;
}

}  // namespace palpate::physics
