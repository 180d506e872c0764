#pragma once
// Time of a step of tetrahedra per tetrahedron, on a jittered cube that moves gently.

#include <vector>

#include "common/scene/kinds.h"

namespace palpate::bench {

enum class TetElement { plain, nodal, second_order };

struct TetCubeKind {
  TetElement element = TetElement::nodal;
  bool damped = false;
  Precision precision = Precision::single_;
  int cells =
      19;  // along each side, in six tetrahedra each: 41,154; of 24: 82,944; 12 of second order have the nodes of 24
  int threads = 1;

  double tets() const { return 6.0 * cells * cells * cells; }
};

struct TetCost {
  TetCubeKind kind;
  double stable_step = 0;  // near rest, as it is damped [s]
  double flops = 0, bytes = 0;
  double nodes_per_tet = 0;
  std::vector<double> ns;  // per tetrahedron and step, wall time, of each round

  double median_ns() const;
  double least_ns() const;
  /// Tetrahedra that frames of 1 ms can have in real time, in steps of at most 0.8 of the stable one.
  double tets_at_1_kHz() const;
};

/// Complete steps, nodes held at the bottom, one of four watched for the books as a frame of four steps would.
/// All kinds in turns, so that what else the machine does falls on all alike.
std::vector<TetCost> measure_tet_costs(const std::vector<TetCubeKind>& kinds, int rounds);

}  // namespace palpate::bench
