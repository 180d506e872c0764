#include "physics_node/step/multigrid/start_of_body.h"

#include <fmt/format.h>

#include <cmath>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "physics_node/step/fem/tet_statics.h"
#include "physics_node/step/multigrid/equilibrium.h"

namespace palpate::physics {
namespace {

/// Of a mesh, whose balance knows no planes.
std::vector<Vec3> start_of_mesh(const BodySpec& spec, const Body& body, const Vec3& gravity,
                                std::span<const Plane> planes, std::vector<std::string>& remarks) {
  if (body.n_held == 0)
    throw InputError(
        fmt::format("{}: start = \"balanced\", but nothing holds body \"{}\", and a mesh is not balanced on "
                    "a floor; write "
                    "fixed = [\"-z\"], say, or leave \"start\" out",
                    spec.place.text(), spec.name));
  StaticRest found = find_rest(body.mesh->model, {.gravity = gravity});
  if (!found.solved)
    remarks.push_back(fmt::format(
        "{}: body \"{}\" has no balance that Newton's method finds: {:.2g} of its weight is left; it begins "
        "there, and moves on. Take stiffer tissue, or hold more of it",
        spec.place.text(), spec.name, found.residual));
  for (const Plane& plane : planes)
    for (const Index node : body.nodes())
      if (plane.n.dot(body.rest_position(node) + found.displacement[static_cast<std::size_t>(node)]) <
          plane.height - 1e-3 * body.spacing())
        throw InputError(
            fmt::format("{}: start = \"balanced\" would put body \"{}\" through the floor or a wall, which a "
                        "mesh is not balanced "
                        "on; move it away by its at_mm, or leave \"start\" out",
                        spec.place.text(), spec.name));
  return std::move(found.displacement);
}

}  // namespace

std::vector<Vec3> start_of_body(const BodySpec& spec, const Body& body, const Vec3& gravity,
                                std::span<const Plane> planes, std::vector<std::string>& remarks) {
  if (spec.start != StartKind::balanced) return {};
  if (body.mesh) return start_of_mesh(spec, body, gravity, planes, remarks);
  if (!body.solid) return {};
  if (body.n_held == 0 && !std::isfinite(way_down(body, gravity, planes)))
    throw InputError(fmt::format(
        "{}: start = \"balanced\", but nothing holds body \"{}\"; write fixed = [\"-z\"], say, or a [floor] "
        "below it, or leave \"start\" out",
        spec.place.text(), spec.name));
  Equilibrium found = equilibrium(body, gravity, planes);
  if (!found.report.converged)
    remarks.push_back(fmt::format(
        "{}: body \"{}\" has no balance that Newton's method finds: of a weight of {:.3g} N (root of the sum "
        "of squares) {:.2g} N are left; it begins there, and moves on. Take stiffer tissue, or hold more of "
        "it",
        spec.place.text(), spec.name, found.report.scale, found.report.residual));
  return std::move(found.displacement);
}

}  // namespace palpate::physics
