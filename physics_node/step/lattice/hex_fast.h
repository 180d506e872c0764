#pragma once
// Stiff cells that take several small steps in each step of the body.

#include <array>
#include <cstdint>
#include <vector>

#include "physics_node/step/books.h"
#include "physics_node/step/explicit_step.h"
#include "physics_node/step/fem/fast_kernel.h"
#include "physics_node/step/lattice/fast_lumps.h"
#include "physics_node/step/lattice/hex_grid.h"
#include "physics_node/step/lattice/hex_meter.h"
#include "physics_node/step/lattice/state.h"
#include "physics_node/step/zeroed_array.h"

namespace palpate::physics {

/// Where a hard lump lies in soft tissue, its cells alone ask for steps that the rest could do without. The sweep of the body leaves
/// these cells out and their nodes standing. Then, with a of all other forces at the beginning of the step, these nodes take n
/// substeps of h = H / n:
///
///   v := w + (H - h)/2 a;   n times { v := v + h (a + f / m), u := u + h v };   w := v - (H - h)/2 a
///
/// So a is there all the time: what rests stays at rest, however stiff it is. Impulses once a step would make it ring, and its
/// dampers would be fed from them. A node on which fast cells do nothing moves as in the leapfrog of the body, and w is the velocity of its
/// half step; the sum of m w changes by H m a exactly. With n = 1 this is the step of the body.
///   State v of these nodes is the mean of a step, (u - u_before) / H: what dampers of other cells, contact and the hand see.
///   Momentum: m w. The moment of a, which stays while nodes move on, is put right by a turn of each lump without held nodes.
///   Energy: with v(-) = w + (H - h)/2 a and v(+) = v(-) + h (a + f / m), K = sum of m v(-) . v(+) / 2 is that of a leapfrog of h; what a does over a
///   step differs from the trapezoid of the books by a term of the second order in H.
/// Forces of tools are known after a step. It takes those of the last to go on, and what they differ moves the nodes as elsewhere.
/// Stability: a that lags behind feeds vibrations, at most by (H w_s)^2 / 24 of H as a negative lag, and viscosity eats them: see
/// fast_choice.h.
/// Source: of substeps in a region, Belytschko, Yen & Mullen 1979.
/// Deviation: forces of the rest are held, not the velocities of its nodes, so that linear momentum is exact.
template <class Real>
class HexFast {
 public:
  /// @param at_rest  bound of the tangent there [Pa]
  HexFast(const Body& body, const LatticeState<Real>& state, const HexConstants<Real>& constants,
          double at_rest);

  /// Before the sweep. Takes back what no tool has given.
  void begin(LatticeState<Real>& state) noexcept;
  /// After it. @param pulled  forces of all other cells, by storage cell [N]; @param passed  see HexContext: of each row
  void step(LatticeState<Real>& state, const ExplicitStep& step, const Three<Real>& pulled,
            std::vector<double>& passed) noexcept;

  double least_corner_J() const noexcept { return least_corner_J_; }  // of all watched steps
  const Real* swept_inverse_mass() const noexcept { return swept_.data(); }

  /// What they add to the body's energies. @param rest  of all other cells
  void add(const Body& body, const HexGrid& grid, const LatticeState<Real>& state, const Vec3& gravity,
           const MeasuredHexahedra& rest, Energies& sum) const;
  /// Of their dampers: see Books::due() [J]
  double due(const Body& body, const HexGrid& grid, const LatticeState<Real>& state,
             const MeasuredHexahedra& rest) const;

 private:
  using Four = ZeroedArray<Real>;  // four numbers a node
  void index_cells(const Body& body, const LatticeState<Real>& state);
  void choose_substeps(double dt) noexcept;
  bool start(LatticeState<Real>& state, const ExplicitStep& step, const Three<Real>& pulled) noexcept;
  /// Takes a moment from each lump. @param moment  per mass, by node, of the velocities that it changes
  template <class Moment>
  void turn(const Real* u, const Moment& moment, Four& velocity) noexcept;
  void turn_back(double dt) noexcept;
  void begin_anew(double lead) noexcept;
  void substep(const ExplicitStep& step, bool watched) noexcept;
  void look(LatticeState<Real>& state, const ExplicitStep& step, double dt_before, double h_before) noexcept;
  void finish(LatticeState<Real>& state, const ExplicitStep& step) noexcept;
  void book(LatticeState<Real>& state, const ExplicitStep& step, std::vector<double>& passed) noexcept;
  std::array<double, 3> force_on(std::size_t n) const noexcept;
  Three<Real> velocities(const Body& body, const LatticeState<Real>& state, const Vec3& gravity,
                         const MeasuredHexahedra& rest) const;

  FastKernel<Real> kernel_;
  FastContext<Real> m_ = {};
  double longest_ = 0;  // substep at rest [s]
  double at_rest_ = 0;  // [Pa]
  std::size_t n_nodes_ = 0, n_batches_ = 0;
  std::vector<std::int32_t> corner_, incident_;
  std::vector<Real> stiffness_, power_, lost_, elastic_, least_change_, stiffest_;
  Four force_, u_, v_, kick_, sum_v_, sum_sum_v_;
  ZeroedArray<Real> swept_;                      // inverse masses, 0 also of the nodes here  (n_cells)
  std::vector<Real> dt_over_mass_;               // by node
  std::vector<double> inverse_mass_;             // by node; 0: held [1/kg]
  std::vector<Index> row_, row_of_lane_;         // by node; by lane, of the lowest corner
  std::vector<Vec3> rest_;                       // by node: where it rests [m]
  std::vector<std::uint8_t> moves_;              // by node, 1: in this step
  std::vector<std::array<Real, 3>> a_;           // by node: of all other forces [m/s^2]
  std::vector<std::array<double, 3>> u_before_;  // by node [m]
  FastLumps lumps_;
  std::vector<Vec3> place_, moment_, change_;  // by node: see FastLumps
  double h_ = 0;                               // of the last step's substeps; 0: there was none [s]
  Vec3 gravity_ = Vec3::Zero();                // of the last step [m/s^2]
  int n_ = 1;                                  // substeps
  double wanted_ = 1, wanted_for_ = 0;         // stiffening that is allowed for, and how long yet [s]
  double least_corner_J_ = 1;
};

}  // namespace palpate::physics
