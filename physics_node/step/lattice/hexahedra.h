#pragma once
// Finite elements of one point on the cells of a voxel lattice: see step/fem/hex_element.h.

#include <memory>
#include <vector>

#include "physics_node/step/lattice/hex_acting.h"
#include "physics_node/step/lattice/hex_failure.h"
#include "physics_node/step/lattice/hex_fast.h"
#include "physics_node/step/lattice/hex_grid.h"
#include "physics_node/step/lattice/hex_kernel.h"
#include "physics_node/step/lattice/hex_yield.h"
#include "physics_node/step/lattice/lattice_elements.h"
#include "physics_node/step/lattice/parted_cells.h"

namespace palpate::physics {

/// A step is one sweep upwards, or as many as there are slabs: see HexSlab. Symplectic Euler, and its energy is that of
/// the leapfrog: see element_step.h. Cells break and yield: hex_failure.h, hex_yield.h. Few that are much stiffer than the rest take
/// smaller steps: hex_fast.h.
/// Cost: bench/fem.
template <class Real>
class Hexahedra final : public LatticeElements<Real> {
 public:
  Hexahedra(const Body& body, const LatticeState<Real>& state);

  StepOutcome step(const Body& body, LatticeState<Real>& state, const ExplicitStep& step) noexcept override;
  Energies energies(const Body& body, const LatticeState<Real>& state, const Vec3& gravity) const override;
  double energy_now(const Body& body, const LatticeState<Real>& state) const noexcept override;
  Losses due(const Body& body, const LatticeState<Real>& state) const override;
  BodyCounts counts(const Body& body, const LatticeState<Real>& state) const override;

 private:
  /// After rows have fallen asleep or woken: who acts, and which dampers rest.
  void follow_rows(const Body& body, LatticeState<Real>& state) noexcept;
  HexBreaks due_breaks(const LatticeState<Real>& state) const;

  HexGrid grid_;
  HexActing acting_;
  std::uint64_t row_changes_ = 0;  // of the state, when last followed
  HexConstants<Real> constants_;
  ZeroedArray<Real> stiffness_;                   // (n_cells)
  Three<Real> high_;                              // (n_cells)
  std::vector<double> elastic_;                   // by run: see HexContext [J]
  std::vector<double> power_, damped_;            // by run: the same; only where it is damped [W, J]
  std::vector<double> least_J_;                   // by run: the same
  double least_corner_J_ = 1;                     // of all watched steps
  std::vector<double> stiffest_;                  // by run: the same [Pa]
  std::vector<double> lost_before_, lost_after_;  // by run: see HexContext; only where it relaxes [J]
  std::vector<double> passed_;                    // by row [J]
  std::unique_ptr<HexFailure<Real>> failure_;     // only where a material breaks
  std::unique_ptr<HexYield<Real>> yield_;         // only where one yields
  std::unique_ptr<HexFast<Real>> fast_;           // only where cells are stepped on their own
  std::unique_ptr<PartedCells<Real>> parted_;     // only where cells may be cut
  Three<Real> pulled_;                            // see HexContext; only with fast_  (n_cells)
  Three<Real> rate_low_, rate_high_, rate_seen_;  // by node: the same; only where it is damped [N]  (n_cells)
  bool rate_known_ = false;                       // the last step was exact
  HexKernel<Real> kernel_, exact_kernel_;
  double at_rest_ = 0;        // bound of the tangent of the law [Pa]
  double damper_weight_ = 0;  // see Damping [Pa]
};

}  // namespace palpate::physics
