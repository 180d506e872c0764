#pragma once
// A block of tissue on a voxel lattice that stands on its lower face, which is held: what is pressed and swings in many a row.

#include <vector>

#include "common/scene/element_kinds.h"
#include "physics_node/body/mass_share.h"

namespace palpate::bench {

struct HeldBlock {
  Vec3 size = Vec3::Zero();               // [m]
  Vec3 at = Vec3::Zero();                 // its middle [m]
  double edge = 0.0025;                   // of a cell [m]
  double modulus = 10e3, density = 1000;  // [Pa], [kg/m^3]
  double poisson_ratio = 0.45;            // of springs: their own
  double viscosity_time = 0;              // viscosity over modulus; 0: no damper [s]
  ElementModel model = ElementModel::fem;
  HourglassKind hourglass = HourglassKind::physical;
};
physics::Body held_block(const HeldBlock& block);

/// Nodes of its upper face within a radius of the z axis, all alike. @param radius  [m]
std::vector<physics::MassShare> patch_on_top(const physics::Body& body, double radius);

}  // namespace palpate::bench
