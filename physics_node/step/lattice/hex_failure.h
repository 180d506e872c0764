#pragma once
// Hexahedra that break.
//
// A cell that comes to its limit (step/fem/hex_tension.h) loses stiffness, all of it alike: its forces are s times those of a whole
// cell, s from 1 to 0, and it never heals. With W its energy as if it were whole, W_m the most so far while it was in tension, and what
// is left to it of its share of the crack, from G_c A on (hex_crack.h),
//
//   s -> s (r - e) / (e (r - 1)),   e = sqrt(W / W_m) >= 1,   r = left / (s W_m);       e >= r: it is gone
//
// Where stress goes with strain, stress falls on a straight line, to where what is left is used up: each loss of stiffness takes W (- ds), so
//   left -> left - sqrt(W W_m) (s - s').
// A cell alone takes G_c A whatever the path: so a layer of cells takes the fracture energy G_c by its area, whatever their size.
// A = V / sum |N_i| h_i is the share of a cell in a crack across N, the direction of the largest stretch at rest.
// Limit: where a cell holds more at its limit than the crack may take, or no G_c is given, it takes what it holds.
// Large cells of brittle tissue do: edge > G_c / (energy of tissue at its limit by volume). s is then 0 at once.
// Why no ramp over some steps: a cell that lags behind its law is pulled on at full strength, and took up to three times its share.
//
// Books. The step from one force to the next conserves K + sW but for what s falls, times W in the middle of the step:
//   W_mid = W + 1/2 dt sum of f . v, f at its end: exact where forces go with displacements. See element_step.h.
// Source: Bazant & Oh 1983 (crack band), Oliver 1989 (the share of a cell), Simo & Ju 1987 (damage driven by energy).

#include "physics_node/step/explicit_step.h"
#include "physics_node/step/fem/hex_element.h"
#include "physics_node/step/fem/hex_tension.h"
#include "physics_node/step/lattice/hex_acting.h"
#include "physics_node/step/lattice/hex_crack.h"
#include "physics_node/step/lattice/hex_strain.h"
#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

/// What the next step will break before anything acts.
struct HexBreaks {
  std::vector<double> loss;  // of stiffness, in units of that of a whole cell  (n_cells); empty: none
  double energy = 0;         // that is booked for it [J]
};

template <class Real>
class HexFailure {
 public:
  /// @param body, grid  outlive this
  HexFailure(const Body& body, const HexGrid& grid, std::size_t colour);

  /// Before the forces of a step: cells begin to break, go on, and are gone. All cells are looked at in watched steps, those of runs
  /// near to their limit in all. Cost: a tenth of a step, where nothing breaks less. Contract: allocates and throws nothing.
  /// @param stiffness  of each cell in units of the body's own, follows  (n_cells)
  /// @return cells gone
  std::int64_t begin_step(LatticeState<Real>& state, const HexActing& acting, const ExplicitStep& step,
                          ZeroedArray<Real>& stiffness) noexcept;

  HexBreaks due(const LatticeState<Real>& state) const;
  /// Of one cell that has not gone: stiffness, as in HexBreaks::loss. Contract: takes no memory.
  double due_of(const LatticeState<Real>& state, Index cell) const noexcept;

  /// Of each run: 1 where a cell has lost anything.
  const std::uint8_t* torn() const noexcept { return torn_.data(); }

 private:
  struct Cell;  // as it is now
  /// What a cell loses in a step.
  struct Loss {
    Index cell = -1;
    double to = 0;       // s
    double reached = 0;  // energy as if it were whole [J]
    double middle = 0;   // the same in the middle of the step [J]
    double takes = 0;    // [J]
  };
  void follow(const LatticeState<Real>& state, ZeroedArray<Real>& stiffness) noexcept;
  void look(const LatticeState<Real>& state, const HexActing& acting, const ExplicitStep& step) noexcept;
  void begin(LatticeState<Real>& state, Index cell, std::size_t run) noexcept;
  void go_on(LatticeState<Real>& state, ZeroedArray<Real>& stiffness) noexcept;
  double lose(LatticeState<Real>& state, const Loss& loss, ZeroedArray<Real>& stiffness) noexcept;
  void take_away(LatticeState<Real>& state, Index cell) noexcept;
  Cell strained(const LatticeState<Real>& state, Index cell) const noexcept;
  void weigh(const LatticeState<Real>& state, Cell& now) const noexcept;
  Cell look_at(const LatticeState<Real>& state, Index cell) const noexcept;
  bool opens(const Cell& now) const noexcept;
  double stiffness_left(const LatticeState<Real>& state, const Cell& now) const noexcept;
  double loss_of(const LatticeState<Real>& state, const Cell& now) const noexcept;
  TensionLimit<double> limit_of(Index cell) const noexcept;
  bool comes_to_its_limit(const Cell& now) const noexcept;
  double share_to_begin(const Cell& now, const Vec3& normal) const noexcept;
  bool is_pulled(const Cell& now, const TensionLimit<double>& limit) const noexcept;

  const Body& body_;
  const HexGrid& grid_;
  HexConstants<double> k_;
  std::vector<TensionLimit<double>> limits_;  // of body.solid->failures
  ZeroedArray<Real> stretch_, tension_;       // as HexStrain has them  (n_cells)
  std::vector<Strained> found_;               // of each run
  std::vector<std::uint8_t> torn_;            // of each run
  std::vector<Index> breaking_;               // cells that have begun and are not gone, in storage order
  std::vector<Loss> losses_;                  // of this step
  CrackShares<Real> shares_;
  std::array<Mask, max_directions>
      sharing_{};                   // cells around a mass that hold its element in a direction, as cell_bits
  std::uint64_t replacements_ = 0;  // of the state, when last followed
  HexStrainKernel<Real> kernel_;
};

}  // namespace palpate::physics
