#pragma once
// Hexahedra that yield: which, when, and what is booked. The law is step/fem/hex_plastic.h.
//
// Books. A flow takes D from K + W, and books of it the stress times the plastic strain as `plastic`, which never is negative; the rest,
// from a step that begins below the limit and ends beyond it, as `numerical`. Exact where forces go with displacements.

#include "physics_node/step/explicit_step.h"
#include "physics_node/step/lattice/hex_acting.h"
#include "physics_node/step/lattice/hex_flow.h"
#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

template <class Real>
class HexYield {
 public:
  /// @param body, grid  outlive this
  HexYield(const Body& body, const HexGrid& grid, std::size_t colour);
  /// How many colours of ZeroedArray it takes.
  static constexpr std::size_t n_colours = 2;

  /// Before the forces of a step, after those that break: cells flow, and what their plastic shape does is added to state.f and high.
  /// All runs are looked at in watched steps, those near to their limit and those that have yielded in all. Cost: where no cell is near a
  /// thirteenth of a step, where all flow in every step two. Contract: allocates and throws nothing.
  /// @param stiffness  as it is in this step  (n_cells)
  void begin_step(LatticeState<Real>& state, const HexActing& acting, const ExplicitStep& step,
                  const ZeroedArray<Real>& stiffness, Three<Real>& high) noexcept;

  /// After the step was watched: energy of plastic shapes, to what the kernel has booked.
  void watch(LatticeState<Real>& state) const noexcept;
  /// Adds its part to the bound of the tangent of each run that acts [Pa].
  void stiffen(const HexActing& acting, std::vector<double>& stiffest) const noexcept;

 private:
  void follow(const LatticeState<Real>& state) noexcept;

  const Body& body_;
  const HexGrid& grid_;
  HexConstants<Real> k_;
  Real most_bent_ = 0;                   // see HexFlowContext
  ZeroedArray<Real> limit_, hardening_;  // YieldLimit  (n_cells)
  std::vector<RunYield> of_run_;
  std::uint64_t replacements_ = 0;  // of the state, when last followed
  HexFlowKernel<Real> kernel_;
};

/// Of a cell; all zero where nothing yields.
template <class Real>
Plastic<double> plastic_of(const LatticeState<Real>& state, Index cell) noexcept {
  Plastic<double> plastic{};
  for (std::size_t n = 0; n < state.plastic.memory.size(); ++n)
    plastic[n] = static_cast<double>(state.plastic.memory[n][static_cast<std::size_t>(cell)]);
  return plastic;
}

/// Adds what the plastic shape of a cell does to what the law does. @param w  displacements of its corners [m]
inline void add_plastic(const HexConstants<double>& k, const Corners<Scalar<double>>& w,
                        const Plastic<double>& plastic, HexForces<Scalar<double>>& out) noexcept {
  using One = Scalar<double>;
  Corners<One> more;
  out.energy += plastic_forces<One>(k, hex_strained<One>(k, w), plastic, more);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t a = 0; a < 8; ++a) out.f[c][a] += more[c][a];
}

}  // namespace palpate::physics
