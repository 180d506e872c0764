#pragma once
// Hexahedra on some cells of a box, in equilibrium under large strain: solved by Newton's method from the element alone, without
// stepping, so for some thousand cells. Written apart from the kernels on purpose.

#include <Eigen/SparseCore>
#include <array>
#include <functional>
#include <vector>

#include "physics_node/step/fem/hex_stiffness.h"

namespace palpate::bench {

class HexBlock {
 public:
  /// @param cells  along x, y, z; the box begins in the origin. @param edge  of a cell [m]
  /// @param stiffness  of the cell round this centre, in those of the material; 0: none is there. All 1, where it is empty
  HexBlock(const std::array<int, 3>& cells, const Vec3& edge, const physics::HexMaterial& material,
           const std::function<double(const Vec3&)>& stiffness = {});

  int n_nodes() const { return static_cast<int>(rest_.size()); }
  int n_cells() const { return static_cast<int>(corner_.size()); }
  const Vec3& rest(int node) const { return rest_[static_cast<std::size_t>(node)]; }  // [m]
  /// Of all nodes that it picks by their rest positions.
  std::vector<int> nodes(const std::function<bool(const Vec3&)>& picks) const;
  /// Corners of the faces, four each, that have a cell on one side only, whose outward normal and middle it picks.
  std::vector<std::array<int, 4>> faces(const std::function<bool(const Vec3&, const Vec3&)>& picks) const;

  /// The component `axis` of a node is at `displacement` from the next solve() on [m].
  void hold(int node, int axis, double displacement = 0);
  void place(int node, const Vec3& displacement) { u_.segment<3>(3 * node) = displacement; }  // a start [m]
  void load(int node, const Vec3& force);  // in place of what was there [N]
  /// From where it is. @return has it come to rest, to 1e-8 of the loads? A step of the loads that is too large may have no way there.
  bool solve();

  Vec3 displacement(int node) const { return u_.segment<3>(3 * node); }  // [m]
  /// Of the cells on a node: against its load, or what holds it [N].
  Vec3 force(int node) const;
  double energy() const;          // of the cells [J]
  double least_corner_J() const;  // of all corners, as it is

 private:
  using Cell = Eigen::Matrix<double, 3, 8>;
  Cell corners(std::size_t cell) const;
  void assemble();
  Eigen::SparseMatrix<double> tangent() const;
  bool step();
  double potential() const;  // of cells and loads [J]

  physics::HexMaterial material_;
  physics::HexConstants<double> k_;
  Vec3 edge_;
  std::vector<Vec3> rest_;
  std::vector<std::array<int, 8>> corner_;
  std::vector<double> stiffness_;  // of each cell
  std::vector<char> held_;         // (3 n_nodes)
  Eigen::VectorXd u_, load_, force_;
  std::vector<Eigen::Triplet<double>> entries_;  // of the tangent; 1 on the diagonal of held components
};

}  // namespace palpate::bench
