#pragma once
// A body of finite elements as a needle finds it that goes through without parting them: which places are tissue and how
// tough, and how tissue lies there now. That is a mean over a small ball, as a load on a point would turn the elements
// around it inside out:
//
//   x(X) = X + sum of w_n u_n,   w_n = phi_n / sum of phi,   phi_n = m_n (1 - |X - X_n|^2 / r^2)^2
//
// and a force there is shared out by the same weights, so that it does the same work.
// Source: Shepard 1968 (weights).

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "physics_node/step/body_model.h"

namespace palpate::physics {

/// Why not, if a needle cannot go through a body, as a noun with what would do; else null.
const char* not_to_be_pierced(const Body& body) noexcept;

class PiercedTissue {
 public:
  /// A place at rest, and the cell or tetrahedron that it lies in.
  struct Place {
    Vec3 rest = Vec3::Zero();  // [m]
    Index cell = -1;           // of a lattice its lowest corner, in storage; -1: something rigid
  };
  struct Carrier {
    Index node = 0;
    double weight = 0;
  };
  using Carriers = std::vector<Carrier>;
  static constexpr std::size_t most_carriers = 1024;  // of a place; those that come last are left out

  /// @param body  that may be pierced; outlives this  @param diameter  of the needle, by which r goes [m]
  PiercedTissue(const BodyModel& body, double diameter);

  /// Is it tissue? @param beyond  of a cell: so far outside of one it may lie (lattices alone: a smooth skin lies up to
  /// half a cell beyond them)
  std::optional<Place> find(const Vec3& rest, double beyond = 0) const noexcept;
  /// Does something rigid lie there, such as bone?
  bool is_rigid(const Vec3& rest) const noexcept;
  const ElementLaw& law(const Place& place) const noexcept;

  /// Who carries a place. They stay the same while copies() does. @param by  with room for most_carriers
  void gather(const Vec3& rest, Carriers& by) const noexcept;
  /// How many nodes have been copied by cuts.
  Index copies() const noexcept;
  Vec3 displacement(const Carriers& by) const noexcept;  // [m]
  Vec3 velocity(const Carriers& by) const noexcept;      // [m/s]
  /// F = dx / dX
  Eigen::Matrix3d gradient(const Vec3& rest) noexcept;
  /// F^-1; of tissue that is folded, where it says nothing, the identity.
  Eigen::Matrix3d to_rest(const Vec3& rest) noexcept;

  double poisson_ratio() const noexcept { return poisson_ratio_; }
  double reach() const noexcept { return reach_; }      // r [m]
  double spacing() const noexcept { return spacing_; }  // of cells, or the mean edge of tetrahedra [m]
  const BodyModel& body() const noexcept { return *body_; }

 private:
  std::optional<Place> find_cell(const Vec3& rest, double beyond) const noexcept;
  std::optional<Place> find_tet(const Vec3& rest) const noexcept;
  /// Calls visit(node as loaded, where it rests) for those near a place.
  template <class Visit>
  void each_near(const Vec3& rest, const Visit& visit) const noexcept;
  Eigen::Vector4d shares(Index tet, const Vec3& rest) const noexcept;
  void sort_mesh();
  Vec3i box_of(const Vec3& rest) const noexcept;
  std::size_t number_of(const Vec3i& box) const noexcept;

  const BodyModel* body_;
  Vec3i shift_ = Vec3i::Zero();  // from the grid of a lattice to cells
  double spacing_ = 0, reach_ = 0, poisson_ratio_ = 0;
  Carriers scratch_;
  // Of a mesh, by boxes of a grid: which tetrahedra may hold a place, and nodes.
  Vec3 low_ = Vec3::Zero();
  Vec3i n_boxes_ = Vec3i::Ones();
  double box_ = 1;  // edge [m]
  std::vector<std::uint32_t> tets_from_, nodes_from_;
  std::vector<Index> tets_, nodes_;
};

}  // namespace palpate::physics
