#pragma once
// [material.NAME] of a scene.

#include <optional>
#include <string>

#include "common/scene/kinds.h"
#include "common/scene/place.h"

namespace palpate {

/// Either per mass and spring (the papers' way) or per volume (a tissue). Exactly one of each group is given.
struct MaterialSpec {
  std::string name;
  std::optional<double> mass;            // of one mass [kg]          | one of these
  std::optional<double> density;         // [kg/m^3]                  |
  std::optional<double> k1;              // of one element [N/m]      | one of these
  std::optional<double> modulus;         // Young's modulus [Pa]      |
  std::optional<double> lambda;          // force per stretch, k1 L of every element [N] |
  double poisson_ratio = 0.45;           // of finite elements; springs have one of their own
  double k2_ratio = 1.0;                 // k2 / k1 in [0, 1]
  std::optional<double> viscosity;       // of one element [N s/m]    | at most one; none: no damper
  std::optional<double> viscosity_bulk;  // [Pa s]                    |
  Damper damper = Damper::axial;
  double drag = 0;                    // of every mass against the world, -b v [N s/m]
  std::optional<double> yield_ratio;  // y_p > 1 |  both or neither: purely elastic
  std::optional<double> break_ratio;  // b_p > y_p
  Place place;
};

}  // namespace palpate
