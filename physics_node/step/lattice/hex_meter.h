#pragma once
// Hexahedra measured one by one, in double, for the books and the summary: not for stepping.

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "physics_node/step/fem/hex_constants.h"
#include "physics_node/step/fem/hex_damper.h"
#include "physics_node/step/lattice/hex_failure.h"
#include "physics_node/step/lattice/hex_grid.h"
#include "physics_node/step/lattice/state.h"

namespace palpate::physics {

/// In the precision of the kernel or of the meter.
template <class Real>
HexConstants<Real> hex_constants_of(const Body& body) {
  const SolidElements& solid = *body.solid;
  return hex_constants<Real>(
      {.modulus = solid.modulus, .poisson_ratio = solid.poisson_ratio, .hourglass = solid.hourglass},
      body.lattice.step);
}

/// Terms as a step of dt finds them that comes dt_before after the last.
template <class Real>
std::array<RelaxationTerm<Real>, most_relaxations> relaxation_terms(const Body& body, double dt_before,
                                                                    double dt) {
  std::array<RelaxationTerm<Real>, most_relaxations> terms{};
  for (std::size_t t = 0; t < body.solid->relaxation.size(); ++t) {
    const Relaxation& of = body.solid->relaxation[t];
    terms[t] = {.share = static_cast<Real>(of.share),
                .kept_before = static_cast<Real>(std::exp(-0.5 * dt_before / of.time)),
                .kept_after = static_cast<Real>(std::exp(-0.5 * dt / of.time))};
  }
  return terms;
}

/// Bound of the tangent of law and terms at rest [Pa].
double hex_bound_at_rest(const Body& body);

/// Calls visit(stiffness, corners, run, cell) for each cell of a run that lives, corners as numbers of nodes. Cells that a cut has parted
/// are not of it, but of one more run behind all.
template <class Real, class Visit>
void for_each_cell_of(const Body& body, const HexGrid& grid, const LatticeState<Real>& state, std::size_t r,
                      const Visit& visit) {
  const HexRun& run = grid.runs[r];
  for (Index i = run.first; i < run.first + run.count; ++i) {
    auto stiffness = static_cast<double>(body.solid->stiffness[static_cast<std::size_t>(i)]);
    if (state.failed.damage.size() > 0)
      stiffness *= 1 - static_cast<double>(state.failed.damage[static_cast<std::size_t>(i)]);
    if (stiffness <= 0) continue;
    const CellNet* net = body.cell_net();
    const bool is_parted = net != nullptr && net->is_parted(i);
    visit(stiffness, corners_now(body, grid, run, i), is_parted ? grid.runs.size() : r, i);
  }
}

/// The same of all runs.
template <class Real, class Visit>
void for_each_cell(const Body& body, const HexGrid& grid, const LatticeState<Real>& state,
                   const Visit& visit) {
  for (std::size_t r = 0; r < grid.runs.size(); ++r) for_each_cell_of(body, grid, state, r, visit);
}

/// Of all that may hold energy: where the body is awake in parts, of those.
template <class Real, class Visit>
void for_each_strained_cell(const Body& body, const HexGrid& grid, const LatticeState<Real>& state,
                            const Visit& visit) {
  for (std::size_t r = 0; r < grid.runs.size(); ++r)
    if (state.acts.empty() || state.acts[r] != 0) for_each_cell_of(body, grid, state, r, visit);
}

enum class CellsOf { rest, fast };  // see FastCells; without any, all are the rest

/// Fastest vibration of cells of a cube, within a tenth of what stiffest_mode() finds [1/s].
/// @param stiffness  of them, over that of the body's own material
inline double fastest_of(const Body& body, double at_rest, double stiffness) {
  return std::sqrt(at_rest * stiffness / body.solid->density *
                   body.lattice.step.cwiseInverse().squaredNorm() / 2);
}

/// Energy of some cells, their forces on the nodes, what their terms have lost since the last step and what their dampers take.
struct MeasuredHexahedra {
  double elastic = 0, lost_before = 0;
  std::vector<double> power;          // by run, then of those that a cut has parted [W]
  std::vector<double> power_of_cell;  // of fast ones, in storage order [W]
  ZeroedArray<Vec3> force;            // (n_cells)
  ZeroedArray<Vec3> force_of_rate;    // of dampers alone  (n_cells)
};
/// @param v  velocities of the nodes [m/s]
/// @param broken_soon  stiffness that each cell is about to lose before it acts again, in units of a whole one; empty: none
template <class Real>
MeasuredHexahedra measure_hexahedra(const Body& body, const HexGrid& grid, const LatticeState<Real>& state,
                                    CellsOf which, const Three<Real>& v,
                                    std::span<const double> broken_soon = {});
/// Elastic energy of all cells alone. Contract: takes no memory. @param failure  whose next losses it leaves out, or null [J]
template <class Real>
double measure_elastic(const Body& body, const HexGrid& grid, const LatticeState<Real>& state,
                       const HexFailure<Real>* failure) noexcept;
/// Of the cells of some runs: elastic energy and, as Energies::between has them, dt / 2 of the power of their springs. Contract: takes no
/// memory. [J]
template <class Real>
double measure_between(const Body& body, const HexGrid& grid, const LatticeState<Real>& state,
                       std::span<const Index> runs) noexcept;
/// Of a body without fast cells, with the velocities of the state.
template <class Real>
MeasuredHexahedra measure_hexahedra(const Body& body, const HexGrid& grid, const LatticeState<Real>& state) {
  return measure_hexahedra(body, grid, state, CellsOf::rest, state.v);
}

}  // namespace palpate::physics
