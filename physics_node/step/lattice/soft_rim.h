#pragma once
// What stands in for the tissue behind the part of a body that is stepped.

#include <span>
#include <vector>

#include "physics_node/step/books.h"
#include "physics_node/step/lattice/hex_grid.h"
#include "physics_node/step/lattice/pressed_places.h"
#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

/// Of what acts in a body that is awake in parts, a mark of each storage cell.
inline constexpr std::uint8_t node_moves = 1;
inline constexpr std::uint8_t cell_acts = 2;  // by its lowest corner

/// Springs and dampers on the nodes of the faces where cells that act meet cells that rest, unless a cut has opened them. They answer as an
/// unbounded body of the same tissue does that is pressed at one place (Kelvin): on the sphere of radius r about it, per area,
///
///   k_n = mu (2 - nu) / ((1 - nu) r),   k_t = 2 mu (1 - 2 nu) / ((3 - 4 nu) r)    along and across n = (x - p) / r
///   c_n = 2 rho c_s,   c_t = rho c_s
///
/// With the solid angle A . n of the faces in place of the area it holds for a rim of any shape, and since a half space (Boussinesq) is
/// twice a full one, for a press on a flat skin too. Held nodes that lie where the push goes, at the distance H from the place, stiffen what
/// is behind:
///
///   K = s(r / H) (A . n) [k_n n n^T + k_t (1 - n n^T)],   s(x) = min(4, 1 / (1 - 0.86 x))
///
/// Of several places K is the mean of theirs, weighted by force / r. Dampers act with the velocity after the step (1 + dt c / m below the
/// force), so that no step is too long for them.
/// Source: ours; measured in bench/parts.
template <class Real>
class SoftRim {
 public:
  explicit SoftRim(const Body& body);

  /// Of faces between cells that act and cells that do not.
  /// @param acting  runs that act, @param marks  cell_acts of each cell by its lowest corner
  void find(const Body& body, const HexGrid& grid, std::span<const Index> acting,
            std::span<const std::uint8_t> marks, const LatticeState<Real>& state) noexcept;
  /// For these places. Changes what it holds of energy.
  void stiffen(const Body& body, std::span<const PressedPlace> places) noexcept;

  /// Before the elements act: adds its forces to those of the nodes, and books what its dampers took in the step before.
  void act(LatticeState<Real>& state, double dt, bool watch) noexcept;

  double elastic(const LatticeState<Real>& state) const noexcept;  // [J]
  double power(const LatticeState<Real>& state) const noexcept;    // of its springs on nodes that move [W]
  double watched_elastic() const noexcept { return watched_; }     // before the last watched step [J]
  double lost() const noexcept { return lost_; }                   // in dampers, in all [J]
  /// Books what is there now, and what the next step takes of it at once, as Hexahedra::energies() and due() do for cells.
  void add(const LatticeState<Real>& state, Energies& energies) const noexcept;
  double due(const LatticeState<Real>& state) const noexcept;  // [J]
  std::size_t size() const noexcept { return nodes_.size(); }
  bool has(Index node) const noexcept { return number_[static_cast<std::size_t>(node)] != 0; }
  void clear() noexcept;

 private:
  struct Node {
    Index cell = 0;
    Real inverse_mass = 0;
    std::array<Real, 6> K{};      // xx, yy, zz, xy, xz, yz [N/m]
    std::array<Real, 3> c{};      // along the axes [N s/m]
    std::array<Real, 3> c_now{};  // c / (1 + dt c / m)
  };
  struct Faces {
    Vec3 of_modulus = Vec3::Zero();    // area vector, times the modulus behind it over the body's own [m^2]
    Vec3 of_impedance = Vec3::Zero();  // times its root
  };
  double way_to_held(const PressedPlace& place) const noexcept;  // infinite: none lies where it goes [m]
  std::array<Real, 3> pull(const Node& node, const LatticeState<Real>& state) const noexcept;
  void use_step(double dt) noexcept;

  double k_n_ = 0, k_t_ = 0, c_ = 0;  // mu (2 - nu) / (1 - nu), 2 mu (1 - 2 nu) / (3 - 4 nu) [Pa], rho c_s
  std::vector<Vec3> held_;            // where held nodes are [m]
  std::vector<Node> nodes_;
  std::vector<Faces> faces_;                 // of each
  std::vector<Index> before_nodes_;          // of the rim before
  ZeroedArray<std::int32_t> number_;         // 1 + place in nodes_; 0: none  (n_cells)
  std::array<ZeroedArray<Real>, 3> before_;  // force of dampers in the step before [N]  (n_cells)
  double dt_ = 0, lost_ = 0, watched_ = 0;
};

}  // namespace palpate::physics
