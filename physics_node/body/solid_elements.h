#pragma once
// What the finite elements of a body are made of.

#include <cstdint>
#include <memory>
#include <vector>

#include "common/scene/element_kinds.h"
#include "physics_node/lattice/lattice_types.h"

namespace palpate::physics {

class CellNet;

/// A share of the modulus fades with this time.
struct Relaxation {
  double share = 0;
  double time = 0;  // [s]
};

/// When cells of a material break.
struct Failure {
  double ratio = 0;   // stretch of a bar that breaks; 0: never
  double energy = 0;  // that a crack takes, by its area at rest; 0: what the cell holds [J/m^2]
};

/// When cells of a material yield, and what becomes of them.
struct Yielding {
  double ratio = 0;      // stretch of a bar that yields; 0: never
  double hardening = 0;  // slope of its stress over strain after that, over the slope before; below 1
};

/// Cells so stiff that they are stepped on their own, several times in a step of the rest: see step/lattice/hex_fast.h.
struct FastCells {
  std::vector<Index> cells;  // storage cells of their lowest corners, in storage order; EMPTY: none
  double step = 0;           // the longest that is theirs [s]
};

/// Stiffness of a cell and the mass of a node are per cell, as the cells around a node may be of several materials.
struct SolidElements {
  double modulus = 0;                  // Young's, of the body's own material, where it varies its least [Pa]
  double poisson_ratio = 0;            // of all materials in it
  double beta = 0;                     // viscosity / modulus, of all materials in it [s]
  double density = 0;                  // the least of its materials [kg/m^3]
  std::vector<Relaxation> relaxation;  // of all materials in it; at most most_relaxation_terms
  TissueLaw law = TissueLaw::neo_hookean;  // of all materials in it
  HourglassKind hourglass = HourglassKind::physical;
  std::vector<float>
      stiffness;  // modulus of a cell, times the share of it that is filled, over `modulus`, by the storage cell of its lowest corner; 0: none (n_cells)
  std::vector<double> mass;       // of each node, an eighth of each cell around it [kg]  (n_cells)
  double largest_stiffness = 1;   // over density / least density: what bounds the step
  std::vector<Failure> failures;  // of the body's own material and each region's; EMPTY: nothing breaks
  std::vector<Yielding> yields;   // likewise; EMPTY: nothing yields
  std::vector<std::uint8_t>
      material_of;  // of a cell, as stiffness: 0 the body's own, r + 1 that of region r, by which failures, yields and Body::laws go;
                    // EMPTY: one material, which neither breaks nor yields                       (n_cells)
  FastCells fast;
  /// How its cells hang together where they may be cut; else null. Then `mass` and inverse masses have room for those of copies and are as
  /// now, and all the rest is as loaded. Only who steps it changes these.
  std::shared_ptr<CellNet> net;
  std::vector<double> eighth;  // of the mass of a cell, as stiffness; EMPTY without a net [kg]  (n_cells)
  std::vector<float>
      cut_toughness;        // likewise [J/m^2]                                               (n_cells)
  double awake_radius = 0;  // only cells this near to where it is pressed are stepped; 0: all [m]
};

}  // namespace palpate::physics
