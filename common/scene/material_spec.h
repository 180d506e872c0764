#pragma once
// [material.NAME] of a scene.

#include <optional>
#include <string>
#include <vector>

#include "common/scene/element_kinds.h"
#include "common/scene/kinds.h"
#include "common/scene/place.h"

namespace palpate {

/// A share of the modulus that fades with a time: a term of a Prony series.
struct RelaxationSpec {
  double share = 0;  // in (0, 1)
  double time = 0;   // [s]
};
inline constexpr std::size_t most_relaxation_terms = 4;  // Why: a fit over five decades of time takes as many
inline constexpr double shortest_relaxation = 1e-3;      // Why: what fades within a frame is a viscosity [s]
inline constexpr double most_puncture_ratio = 100;
inline constexpr double longest_relaxation = 1e6;    // [s]
inline constexpr double most_relaxing_share = 0.95;  // Why: the law alone resists being turned inside out

/// Young's modulus where an image is so bright; between two points it is linear, beyond the outermost it stays.
struct ModulusPoint {
  double intensity = 0;
  double modulus = 0;  // [Pa]
};
inline constexpr std::size_t most_modulus_points = 32;  // Why: more than a table of tissues has
inline constexpr double largest_modulus_contrast =
    1e6;  // Why: beyond it single precision has no digit left for the soft part

/// Either per mass and spring (the papers' way) or per volume (a tissue). Exactly one of each group is given.
struct MaterialSpec {
  std::string name;
  std::optional<double> mass;              // of one mass [kg]          | one of these
  std::optional<double> density;           // [kg/m^3]                  |
  std::optional<double> k1;                // of one element [N/m]      | one of these
  std::optional<double> modulus;           // Young's modulus [Pa]      | of modulus_by_intensity the least
  std::optional<double> lambda;            // force per stretch, k1 L of every element [N] |
  double poisson_ratio = 0.45;             // of finite elements; springs have one of their own
  std::vector<RelaxationSpec> relaxation;  // of finite elements; shares below 1 in all
  TissueLaw law = TissueLaw::neo_hookean;  // of finite elements
  std::vector<ModulusPoint>
      modulus_by_intensity;              // of finite elements in an image, rising; EMPTY: modulus everywhere
  double k2_ratio = 1.0;                 // k2 / k1 in [0, 1]
  std::optional<double> viscosity;       // of one element [N s/m]    | at most one; none: no damper
  std::optional<double> viscosity_bulk;  // [Pa s]                    |
  Damper damper = Damper::axial;
  double drag = 0;                    // of every mass against the world, -b v [N s/m]
  std::optional<double> yield_ratio;  // y_p > 1 |  of springs both or neither: purely elastic
  std::optional<double> break_ratio;  // b_p > y_p; of finite elements each may stand alone
  std::optional<double>
      fracture_energy;                  // of finite elements that break: what a crack takes, by area [J/m^2]
  std::optional<double> cut_toughness;  // what a blade or a needle takes, by area [J/m^2]
  double puncture_ratio = 1.5;          // force on a tip that enters, over that of one which goes on
  Place place;
};

/// What a material of finite elements does besides being elastic by the default law, and damped: backward_euler and tetrahedra do not
/// follow that. As a verb with its object; empty: nothing.
std::string beyond_elastic(const MaterialSpec& material);

}  // namespace palpate
