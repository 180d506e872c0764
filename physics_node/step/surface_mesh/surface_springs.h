#pragma once
// A closed surface of springs that moves: its state, its step and its books. See body/spring_surface.h.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "physics_node/body/spring_surface.h"
#include "physics_node/step/books.h"
#include "physics_node/step/explicit_step.h"
#include "physics_node/step/stepper.h"
#include "physics_node/step/zeroed_array.h"

namespace palpate::physics {

/// Symplectic Euler, and its energy is that of the leapfrog: see lattice/element_step.h. The damper and the drag are
/// booked by their forces on the nodes at either end of a step, which is exact; what that would give in place of taking
/// is `numerical`. What the pressure at rest gives counts with what gravity gives.
/// Where it may be cut, its triangles part along their edges (surface_separation.cpp); once two have, what it was filled
/// with has gone.
/// Cost of a step: a pass over springs, one over nodes and their springs; where it is filled, one more over nodes and triangles.
template <class Real>
class SurfaceSprings {
 public:
  using Net = TriangleNet;

  /// @param inverse_mass  of each node, 0: held; where it may be cut with room for copies, whatever that holds [1/kg]
  SurfaceSprings(const SpringSurface& surface, const std::vector<double>& inverse_mass);

  /// A step. Of ExplicitStep `verlet`, `exact` and `struck` mean nothing here. Allocates, locks and throws nothing.
  /// @return of what was watched by how much omega2() exceeds that at rest
  StepOutcome step(const ExplicitStep& step) noexcept;

  Vec3 displacement(Index node) const noexcept;  // [m]
  Vec3 velocity(Index node) const noexcept;      // [m/s]
  void place(Index node, const Vec3& displacement, const Vec3& velocity) noexcept;
  /// An impulse at the beginning of the step of dt just integrated: v += dv, u += dt dv.
  void push(Index node, const Vec3& dv, double dt) noexcept;
  /// Four numbers of each node: x, y, z and 0.
  const Real* displacements() const noexcept { return u_.data(); }
  const Real* velocities() const noexcept { return v_.data(); }

  struct Saved {
    ZeroedArray<Real> u;
    double viscous = 0, numerical = 0;  // [J]
    Watch watch{};
  };
  Saved saved() const;  // room for it
  void save(Saved& to) const noexcept;
  /// At rest where it was.
  void bring_back(const Saved& from) noexcept;
  /// Begins the books anew.
  void forget() noexcept;

  /// Takes copies of nodes, and the corners of triangles as they are now. Allocates nothing.
  /// @param splits  since the last call @return elastic energy that there is more now [J]
  double separate(std::span<const NodeSplit> splits, const TriangleNet& net) noexcept;
  /// What of a saved state belongs to a copy.
  void copy_saved(Saved& saved, Index node, Index copy) const noexcept;
  /// As loaded.
  void rejoin() noexcept;
  /// By the triangles that it has since separate() or rejoin() [kg].
  double mass(Index node, const TriangleNet&) const noexcept {
    return mass_at(static_cast<std::size_t>(node));
  }

  Energies energies(const Vec3& gravity) noexcept;
  Losses losses() const noexcept { return {.viscous = viscous_, .numerical = numerical_}; }
  /// What the next step books of damper and drag that `losses` do not have yet.
  Losses due() noexcept;
  Watch watch() const noexcept { return watch_; }
  std::uint64_t hash(std::uint64_t seed) const noexcept;
  bool is_finite() const noexcept;
  double volume() noexcept;    // that it encloses now [m^3]
  double pressure() noexcept;  // of what it is filled with [Pa]

  double largest_stretch() noexcept;  // l / L of a spring

  /// No vibration about where it is now is faster, squared; with S_i the sum over springs of node i of k u u^T, and, of
  /// those that pull, k (l - L) / l (1 - u u^T):
  ///   w^2 <= max over nodes of (2 largest eigenvalue of S_i + |p| / 3 sum of |edges across|) / m_i
  ///          + K / V_0 sum of |dV/dp_i|^2 / m_i
  /// since each spring takes (u . (x_a - x_b))^2 <= 2 (u . x_a)^2 + 2 (u . x_b)^2. Of six equal springs in a plane it
  /// is exact.
  double omega2() noexcept;
  /// As fast as damper and drag alone slow a node down, at most, near rest [1/s].
  double gamma() noexcept;

 private:
  using Four = Eigen::Array<Real, 4, 1>;  // x, y, z and 0
  struct Spring {
    Four rest = Four::Zero();  // from the first to the second node [m]
    std::array<Index, 2> node{};
    Real k = 0, length = 0;
  };
  struct SpringNow {
    Four u = Four::Zero();  // unit vector from the first to the second node
    Real tension = 0;       // k (l - L) [N]
    Real length = 0;        // l [m]
  };
  /// What its nodes read of a spring, in one line of cache: forces on the first, and 0.
  struct alignas(64) Pull {
    Eigen::Array4d elastic = Eigen::Array4d::Zero();  // tension along u [N]
    Eigen::Array4d damping = Eigen::Array4d::Zero();  // c l' along u [N]
  };
  struct Incident {
    double sign = 0;  // 1: the node is its first
    Index spring = 0;
  };
  /// A triangle at a node, and its two other corners, in their order.
  struct Around {
    Index triangle = 0;
    std::array<Index, 2> others{};
  };
  struct Range {
    std::size_t begin = 0, end = 0;
  };
  /// What of it a cut changes.
  struct Joints {
    std::vector<Spring> springs;
    std::vector<MeshTriangle> triangles;
    std::vector<Range> of_node, around_node;  // of incident, around
    std::vector<Incident> incident;
    std::vector<Around> around;
    std::vector<Index> spring_of;  // of each side of each triangle; EMPTY: it is not cut
  };
  /// What one node feels.
  struct Felt {
    Vec3 elastic = Vec3::Zero();  // of springs and pressure [N]
    Vec3 damping = Vec3::Zero();  // of springs and drag [N]
  };
  /// The two parts of the bound of omega2() [1/s^2].
  struct Fastest {
    double of_nodes = 0, of_content = 0;
    void add(const Fastest& more) noexcept;
    double omega2() const noexcept { return of_nodes + of_content; }
  };
  struct Ledger {
    double kinetic = 0, between = 0, fallen = 0, fallen_before = 0, speed2 = 0, of_damper = 0, numerical = 0;
    Fastest fastest;
  };
  bool is_filled() const noexcept { return !leaks_ && physics::is_filled(membrane_); }
  template <class Work>
  static void each(const ExplicitStep& step, std::size_t n, const Work& work) noexcept;
  void look_at_springs(const ExplicitStep& step) noexcept;
  void look_at_volume(const ExplicitStep& step) noexcept;
  Vec3 swelling(std::size_t node) const noexcept;  // dV/dp: a third of the area vectors around it [m^2]
  Felt felt(std::size_t node) const noexcept;
  double stiffness(std::size_t node) const noexcept;  // largest eigenvalue of S_i, see omega2() [N/m]
  Fastest fastest(std::size_t node) const noexcept;
  void kick(const ExplicitStep& step, std::size_t begin, std::size_t end, Ledger& ledger) noexcept;
  void book(const ExplicitStep& step) noexcept;
  void look(const ExplicitStep& step) noexcept;
  double elastic() const noexcept;
  double given_by_pressure() const noexcept;
  std::size_t n_nodes() const noexcept { return rest_.size(); }
  std::size_t capacity() const noexcept { return inverse_mass_.size(); }
  void list_springs(const SpringSurface& surface);
  void prepare_for_cuts(const SpringSurface& surface);
  void part_spring(std::size_t triangle, std::size_t side, const TriangleNet& net) noexcept;
  void list_anew(Index origin, const TriangleNet& net) noexcept;
  double mass_at(std::size_t node) const noexcept;

  Membrane membrane_;
  double rest_volume_ = 0;  // [m^3]
  Joints joints_, loaded_;  // loaded_: EMPTY where it is not cut
  std::vector<Vec3> rest_;  // of nodes in use, from the middle of its box, so that no digits are lost [m]
  std::vector<double> area_at_rest_;  // of triangles; EMPTY where it is not cut [m^2]
  std::vector<double> drag_;          // b of nodes, which copies share by their mass [N s/m]
  std::vector<Index> copied_;         // nodes of one as loaded, while they are listed
  std::vector<std::uint8_t> wanted_;  // of nodes as loaded: to be listed
  bool leaks_ = false;
  std::vector<double> inverse_mass_;
  double omega2_at_rest_ = 0;

  ZeroedArray<Real> u_, v_;
  std::vector<SpringNow> now_;
  std::vector<Pull> pulls_;
  // As last looked at; only where it is filled:
  std::vector<Vec3> x_;     // of nodes, as rest_ [m]
  std::vector<Vec3> area_;  // of triangles, outwards [m^2]
  std::vector<Vec3> damping_,
      damping_before_;  // forces of damper and drag on nodes, in this step and in the last [N]
  std::vector<double> elastic_, volumes_;  // by piece
  std::vector<Ledger> ledger_;             // by piece
  double volume_ = 0, pressure_ = 0;       // as last looked at
  double dt_before_ = 0;                   // [s]
  Watch watch_;
  double passed_ = 0, viscous_ = 0, numerical_ = 0;  // passed_: viscous, of unwatched steps, too [J]
  double stiffening_ = 1;
};

}  // namespace palpate::physics
