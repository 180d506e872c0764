#pragma once
// Words of a scene file that many files use without the rest of their table. A new key of a table does not
// compile those files again.

namespace palpate {

/// automatic: physics takes one of the others when it has loaded the bodies (physics_node/forecast/integrator_choice.h).
enum class Integrator { symplectic_euler, velocity_verlet, backward_euler, automatic };
enum class Precision { single_, double_ };

enum class LatticeKind { fcc, voxel };

/// How a damper of constant c acts on mass i of an element toward j (EQUATIONS C-31).
///   axial     c ((v_j - v_i) . u) u   along the element: sound                              P0
///   relative  c (v_j - v_i)           the whole vector: takes angular momentum away           P3
///   drag      -c v_i                  against the world: takes momentum away                  P2
enum class Damper { axial, relative, drag };

/// norton: planes at zero force. tangent: wrench and its 6 x 6 stiffness. raw_planes, direct: as in the papers. tissue: a copy of the tissue,
/// which the hand's recorded motion presses.
enum class ForceModel { norton, tangent, raw_planes, direct, tissue };

}  // namespace palpate
