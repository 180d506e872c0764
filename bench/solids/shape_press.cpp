#include "bench/solids/shape_press.h"

#include <cmath>

#include "bench/problems/held_block.h"
#include "bench/problems/stopwatch.h"
#include "bench/solids/driven_body.h"
#include "physics_node/contact/face_press.h"

namespace palpate::bench {
namespace {

physics::Body quarter_of(const ShapePress& how) {
  return held_block({.size = Vec3(how.breadth / 2, how.breadth / 2, how.height),
                     .at = Vec3(how.breadth / 4, how.breadth / 4, -how.height / 2),
                     .edge = how.edge,
                     .modulus = ShapePress::modulus,
                     .density = ShapePress::density,
                     .poisson_ratio = how.poisson_ratio,
                     .model = how.model});
}

}  // namespace

ShapePressed press(const ShapePress& how) {
  DrivenBody block(quarter_of(how), Precision::single_);
  block.share = how.share;
  const double near = 0.1 * how.edge;
  block.drive(
      [&](const Vec3& x) { return (x.x() < near ? 1U : 0U) | (x.y() < near ? 2U : 0U); });  // symmetry
  const physics::Boundary surface(block.model(), 4 * how.edge);
  physics::FacePress faces(surface, block.model(), how.shape);
  std::vector<std::uint32_t> top;
  for (std::uint32_t f = 0; f < surface.surface().facets.size(); ++f)
    if (surface.settled_centroid(f).z() > -near) top.push_back(f);
  const physics::ShapePose pose;
  double force = 0;
  ShapePressed result;
  const Stopwatch watch;
  block.after_step = [&](double dt) {
    const Stopwatch contact;
    faces.list(pose, top);
    faces.press(pose, force / 4, dt);
    result.press_s += contact.cpu_s();
    block.model().kick(faces.forces(), dt);
  };
  for (const double F : how.forces) {
    force = F;
    result.at_rest = block.settle(1e-7, 20000) && result.at_rest;
    result.depth.push_back(faces.depth());
    result.area.push_back(4 * faces.area());
    result.overlap.push_back(faces.overlap());
  }
  result.cpu_s = watch.cpu_s();
  result.steps = block.steps();
  result.cells = block.model().body().n_nodes();
  return result;
}

std::vector<double> depth_on_half_space(const ShapePress& how, const ShapePressed& pressed) {
  ShapePress coarse = how;
  coarse.edge *= 2;
  const ShapePressed here = press(coarse);
  coarse.breadth *= 2;
  coarse.height *= 2;
  const ShapePressed twice = press(coarse);
  std::vector<double> depth = pressed.depth;
  for (std::size_t n = 0; n < depth.size(); ++n) depth[n] += 2 * (twice.depth[n] - here.depth[n]);
  return depth;
}

}  // namespace palpate::bench
