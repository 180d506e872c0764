#include "physics_node/step/multigrid/start_of_body.h"

#include <fmt/format.h>

#include <cmath>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "physics_node/step/multigrid/equilibrium.h"

namespace palpate::physics {

std::vector<Vec3> start_of_body(const BodySpec& spec, const Body& body, const Vec3& gravity,
                                std::span<const Plane> planes, std::vector<std::string>& remarks) {
  if (spec.start != StartKind::balanced || !body.solid) return {};
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
