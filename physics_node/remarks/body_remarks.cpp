// What holds bodies, and what they begin in.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/scene/body_spec.h"
#include "common/scene/connection_spec.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"
#include "physics_node/material/lame.h"
#include "physics_node/remarks/enclosure.h"
#include "physics_node/remarks/remarks.h"
#include "physics_node/step/fem/hex_plastic.h"

namespace palpate::physics {
namespace {

constexpr double least_awake_cells = 4;

std::string who(const Scene& scene, std::size_t b) {
  return fmt::format("{}: body \"{}\"", scene.bodies[b].place.text(), scene.bodies[b].name);
}

/// By a connection, whatever holds the other.
bool is_joined(const Scene& scene, const std::string& body) {
  return std::ranges::any_of(scene.connections, [&](const ConnectionSpec& connection) {
    return connection.from == body || connection.to == body;
  });
}

bool anything_moves(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const BodySpec& body) { return !body.velocity.isZero(); });
}

void add_holds(const Scene& scene, const Bodies& bodies, Remarks& remarks) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Body& body = bodies[b]->body();
    const BodySpec& spec = scene.bodies[b];
    if (is_tool(scene, body)) continue;
    if (body.n_held == body.n_nodes())
      remarks.push_back(who(scene, b) +
                        " is held at all of its masses: nothing of it moves; hold a face, or a smaller box");
    for (const FixedBox& box : spec.fixed_boxes) {
      const Eigen::AlignedBox3d held(box.min, box.max);
      const bool any = std::any_of(body.nodes().begin(), body.nodes().end(),
                                   [&](Index cell) { return held.contains(body.rest_position(cell)); });
      if (!any)
        remarks.push_back(who(scene, b) +
                          ": a box of \"fixed\" holds none of its masses; lengths are in millimetres");
    }
    if (is_awake_in_parts(body) && body.solid->awake_radius < least_awake_cells * body.spacing())
      remarks.push_back(
          fmt::format("{}: awake_mm = {:.3g} is less than {:g} of its cells, within which the rim errs; "
                      "write {:.3g} or more",
                      who(scene, b), 1e3 * body.solid->awake_radius, least_awake_cells,
                      1e3 * least_awake_cells * body.spacing()));
    if (is_awake_in_parts(body) && n_pieces(*body.cells) > 1)
      remarks.push_back(who(scene, b) +
                        " is of several pieces, and what hangs on nothing flies off while it is awake; write "
                        "largest_component = "
                        "true");
    if (is_anchored(body) || is_joined(scene, spec.name)) continue;
    if (falls_for_ever(scene))
      remarks.push_back(
          who(scene, b) +
          " falls: nothing holds it and nothing lies below; give it fixed = [\"-z\"], a [floor], or "
          "gravity_m_per_s2 = [0, 0, 0]");
    else if (scene.gravity.isZero() && !scene.floor && scene.walls.empty() && !anything_moves(scene))
      remarks.push_back(who(scene, b) +
                        " drifts away once it is touched: nothing holds it; give it fixed = [\"-z\"]");
  }
}

/// Groups of nodes that no tetrahedron joins.
int n_parts(const MeshBody& mesh) {
  std::vector<std::uint8_t> seen(mesh.nodes.size(), 0);
  std::vector<Index> open;
  int parts = 0;
  for (const Index first : mesh.nodes) {
    if (seen[static_cast<std::size_t>(first)] != 0) continue;
    ++parts;
    open.push_back(first);
    seen[static_cast<std::size_t>(first)] = 1;
    while (!open.empty()) {
      const Index node = open.back();
      open.pop_back();
      for (const Index other : mesh.neighbours.of(node)) {
        if (seen[static_cast<std::size_t>(other)] != 0) continue;
        seen[static_cast<std::size_t>(other)] = 1;
        open.push_back(other);
      }
    }
  }
  return parts;
}

/// What the reader of a mesh had to mend, and what it cannot.
void add_mended(const Scene& scene, const Bodies& bodies, Remarks& remarks) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b]->body().mesh) continue;
    const Tidied& tidied = bodies[b]->body().mesh->tidied;
    if (tidied.turned > 0)
      remarks.push_back(fmt::format("{}: {} of its {} tetrahedra were inside out, and are turned",
                                    who(scene, b), tidied.turned, bodies[b]->body().n_elements()));
    if (tidied.unused > 0)
      remarks.push_back(fmt::format("{}: {} nodes of its file are of no tetrahedron, and are left out",
                                    who(scene, b), tidied.unused));
    if (const int parts = n_parts(*bodies[b]->body().mesh); parts > 1)
      remarks.push_back(
          fmt::format("{}: its mesh is {} parts that share no nodes, so nothing joins them; merge nodes that "
                      "lie in one place "
                      "in the mesher",
                      who(scene, b), parts));
  }
}

void add_voxels(const Scene& scene, const Bodies& bodies, Remarks& remarks) {
  constexpr double most_filled = 0.95;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Body& body = bodies[b]->body();
    const auto* image = std::get_if<VolumeShape>(&scene.bodies[b].shape);
    if (image == nullptr || !body.cells) continue;
    const Cells& cells = *body.cells;
    const DeformableRegion& region = image->deformable;
    const auto [i, j, k] = region.center_voxel;
    if (!region.all && !region.gravity_center && !cells.inside(i, j, k))
      remarks.push_back(fmt::format(
          "{}: center_voxel = [{}, {}, {}] lies outside its {} x {} x {} cells; they count from 0, in the "
          "partition",
          who(scene, b), i, j, k, cells.size.x(), cells.size.y(), cells.size.z()));
    const double filled = static_cast<double>(cells.n_filled()) / static_cast<double>(cells.filled.size());
    if (filled > most_filled)
      remarks.push_back(
          fmt::format("{}: \"keep\" takes {:.0f} % of the image, the air round the tissue as well, it seems; "
                      "palpate info "
                      "shows how intensities are spread",
                      who(scene, b), 100 * filled));
  }
}

/// Where its sides are no multiples of them, whole cells make a box of another size, and a few that are filled in part
/// bend as no box does.
void add_box_of_cells(const Scene& scene, const Bodies& bodies, Remarks& remarks) {
  constexpr double most_off = 0.15, a_multiple = 0.02;
  constexpr double few = 8;  // Why: from there on filled cells bend as the shape does, within 3 %
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Body& body = bodies[b]->body();
    const auto* box = std::get_if<BoxShape>(&scene.bodies[b].shape);
    if (box == nullptr || !body.cells || !scene.bodies[b].cavities.empty()) continue;
    const Cells& cells = *body.cells;
    const Vec3 across = box->size.cwiseQuotient(cells.spacing);
    if (!cells.share.empty()) {
      const Vec3 rest = across - Vec3(across.array().round());
      if (across.minCoeff() < few && rest.cwiseAbs().maxCoeff() > a_multiple)
        remarks.push_back(fmt::format(
            "{}: a box {:.2g} cells thick, some of them filled in part, is up to a third stiffer or softer "
            "than one; choose a spacing_mm that its sides are multiples of",
            who(scene, b), across.minCoeff()));
      continue;
    }
    const double ratio = static_cast<double>(cells.n_filled()) * cells.spacing.prod() / box->size.prod();
    if (std::abs(ratio - 1) > most_off)
      remarks.push_back(
          fmt::format("{}: its cells make {:.2f} times the volume of its box; choose a spacing_mm that its "
                      "sides are multiples of{}",
                      who(scene, b), ratio,
                      body.solid && across.minCoeff() >= few ? ", or border_cells = \"filled\"" : ""));
  }
}

void add_planes(const Scene& scene, const Bodies& bodies, Remarks& remarks) {
  struct Behind {
    Vec3 point, normal;
    std::string what;
  };
  std::vector<Behind> planes;
  if (scene.floor) planes.push_back({{0, 0, scene.floor->height}, Vec3::UnitZ(), "below the floor"});
  for (const WallSpec& wall : scene.walls) planes.push_back({wall.point, wall.normal, "behind a wall"});
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Body& body = bodies[b]->body();
    if (is_tool(scene, body)) continue;
    for (const Behind& plane : planes) {
      double deepest = 0;
      for (const Index cell : body.nodes())
        if (body.inverse_mass[static_cast<std::size_t>(cell)] > 0)
          deepest = std::max(deepest, (plane.point - body.rest_position(cell)).dot(plane.normal));
      if (deepest > 0.5 * body.spacing())
        remarks.push_back(fmt::format("{} begins {:.3g} mm {}; move it by its at_mm", who(scene, b),
                                      1e3 * deepest, plane.what));
    }
  }
}

/// Two bodies in one place are pushed apart like an explosion.
void add_overlaps(const Scene& scene, const Bodies& bodies, Remarks& remarks) {
  constexpr std::size_t most_looked_at = 2000;
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (a == b || !scene.contact->enabled) continue;
      const Body &inner = bodies[a]->body(), &outer = bodies[b]->body();
      const auto box = box_of(outer);
      if (box.intersection(box_of(inner)).isEmpty()) continue;
      std::vector<Vec3> places;
      for (const Index cell : inner.nodes())
        if (const Vec3 p = inner.rest_position(cell); box.contains(p)) places.push_back(p);
      if (places.empty()) continue;
      const Enclosure enclosure(*bodies[b]);
      const std::size_t stride = 1 + places.size() / most_looked_at;
      std::size_t inside = 0;
      for (std::size_t n = 0; n < places.size(); n += stride)
        inside += enclosure.contains(places[n]) ? stride : 0;
      if (inside > 0)
        remarks.push_back(fmt::format(
            "{} begins inside body \"{}\" with some {} of its masses; move one of them by its at_mm",
            who(scene, a), outer.name, inside));
    }
}

/// A crack through cells takes no less than these hold when they begin to break: see step/lattice/hex_failure.h.
void add_cracks(const Scene& scene, const Bodies& bodies, Remarks& remarks) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Body& body = bodies[b]->body();
    if (!body.solid) continue;
    const SolidElements& solid = *body.solid;
    const Lame lame = lame_of(solid.modulus, solid.poisson_ratio);
    std::vector<double> most(solid.failures.size(), 0.0);  // modulus of a cell of each, over the body's
    for (const Index cell : body.nodes()) {
      const auto c = static_cast<std::size_t>(cell);
      if (solid.failures.empty() || solid.stiffness[c] <= 0) continue;
      double& of = most[solid.material_of[c]];
      of = std::max(of, static_cast<double>(solid.stiffness[c]));
    }
    for (std::size_t m = 0; m < most.size(); ++m) {
      const Failure& failure = solid.failures[m];
      if (failure.energy == 0 || most[m] == 0) continue;
      const Yielding yielding = solid.yields.empty() ? Yielding{} : solid.yields[m];
      const double elastic = elastic_stretch(failure.ratio, yielding, lame.mu, lame.lambda);
      const double held = most[m] * energy_at_limit(elastic, lame.mu, lame.lambda);
      const double edge = body.lattice.step.maxCoeff();
      if (held * edge <= failure.energy) continue;
      remarks.push_back(fmt::format(
          "{}: cells of {:.3g} mm hold {:.3g} J/m^2 when they begin to break, and a crack takes that, not "
          "fracture_energy_J_per_m2 = {:.3g} of material \"{}\"; cells of {:.3g} mm would do",
          who(scene, b), 1e3 * edge, held * edge, failure.energy,
          m == 0 ? scene.bodies[b].material : scene.bodies[b].regions[m - 1].material,
          1e3 * failure.energy / held));
    }
  }
}

}  // namespace

Remarks body_remarks(const Scene& scene, const Bodies& bodies) {
  Remarks remarks;
  add_holds(scene, bodies, remarks);
  add_mended(scene, bodies, remarks);
  add_voxels(scene, bodies, remarks);
  add_box_of_cells(scene, bodies, remarks);
  add_planes(scene, bodies, remarks);
  add_overlaps(scene, bodies, remarks);
  add_cracks(scene, bodies, remarks);
  return remarks;
}

}  // namespace palpate::physics
