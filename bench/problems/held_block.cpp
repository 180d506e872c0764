#include "bench/problems/held_block.h"

#include <algorithm>

#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"

namespace palpate::bench {

physics::Body held_block(const HeldBlock& block) {
  MaterialSpec tissue;
  tissue.name = "tissue";
  tissue.modulus = block.modulus;
  tissue.density = block.density;
  if (block.model == ElementModel::fem) tissue.poisson_ratio = block.poisson_ratio;
  if (block.viscosity_time > 0) tissue.viscosity_bulk = block.viscosity_time * block.modulus;
  BodySpec spec;
  spec.name = "block";
  spec.lattice = LatticeKind::voxel;
  spec.model = block.model;
  spec.hourglass = block.hourglass;
  spec.spacing = block.edge;
  spec.material = "tissue";
  spec.shape = BoxShape{block.size};
  spec.at = block.at;
  spec.fixed_faces[4] = true;  // -z
  return physics::build_body(spec, tissue);
}

std::vector<physics::MassShare> patch_on_top(const physics::Body& body, double radius) {
  double top = body.rest_position(body.nodes().front()).z();
  for (const physics::Index node : body.nodes()) top = std::max(top, body.rest_position(node).z());
  std::vector<physics::MassShare> found;
  for (const physics::Index node : body.nodes())
    if (const Vec3 x = body.rest_position(node); x.z() > top - 1e-6 && x.head<2>().norm() < radius)
      found.push_back({node, 1});
  for (auto& one : found) one.share /= static_cast<double>(found.size());
  return found;
}

}  // namespace palpate::bench
