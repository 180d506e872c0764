#include "physics_node/forecast/memory_need.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <numeric>

#include "common/error/error.h"
#include "common/math/units.h"
#include "common/process/machine_memory.h"
#include "common/record/png_file.h"
#include "common/record/volume_facts.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/body/solid_shape.h"
#include "physics_node/lattice/lattice_types.h"

namespace palpate::physics {
namespace {

// Measured: palpate simulate of a block (voxel) and a ball (fcc) of 0.7 to 0.9 million masses, most resident
// memory less that of a small scene.
constexpr double elastic_bytes = 200, elastic_double_bytes = 310;  // of a mass
// Of finite elements: stiffness and mass of cells and nodes, a second field of forces, and of forces and velocities a step ago.
constexpr double fem_bytes = 52, fem_double_bytes = 92;
// Of what backward_euler solves them with: three vectors of Newton's, five of the gradients', those of all levels and their shares.
constexpr double solved_bytes = 430, solved_double_bytes = 780;
// Where cells break: what they have lost, twice more to go back to, their limits and fragments.
constexpr double failing_bytes = 72, failing_double_bytes = 116;
// Where they yield: what they have come to, twice more to go back to, and their limits; of those that have.
constexpr double yielding_bytes = 236, yielding_double_bytes = 472;
constexpr double plastic_bytes = 680, plastic_double_bytes = 1030;
// Where springs may be cut and neither yield nor break. Counted: live elements, twice more to go back to, and fragments.
constexpr double cut_bytes = 20;
// Where a tool cuts, to undo that. Counted, numbers of a mass: places and velocities, of a mesh in double; of springs that yield and of
// cells that break or yield what they have been through.
constexpr double marked_numbers = 7, marked_mesh_bytes = 48, marked_plastic_numbers = 18,
                 marked_failing_numbers = 7, marked_yielding_numbers = 19;
// A point or a stick feels what breaks open: two sites of 9 bytes a mass, and room for a facet.
constexpr double felt_bytes = 42;
// Of a node of a mesh, with what joins nodes while it is made; and of its file while it is read, a byte of it. Measured as above, of 600,000
// tetrahedra.
constexpr double mesh_bytes = 700, mesh_double_bytes = 1000, mesh_file_bytes = 2;
constexpr double second_order_bytes = 640, second_order_double_bytes = 700;
constexpr double storage_bytes = 14;  // of a storage cell: elements, share, inverse mass
constexpr double image_bytes =
    10;  // of a cell of an image: intensity, twice while it is read, filled, deformable
constexpr double solid_bytes = 2;  // of a cell of another voxel body: filled, deformable
constexpr double halo = 3;         // rows round the box of a lattice
constexpr double lanes = 48;       // and storage cells at the ends of its rows
constexpr double most_storage = std::numeric_limits<Index>::max();

double volume_share(const BodySpec& body, const Bounds& bounds) {
  const Vec3 edges = bounds.hi - bounds.lo;
  if (const auto* sphere = std::get_if<SphereShape>(&body.shape))
    return 4.0 / 3.0 * std::numbers::pi * std::pow(sphere->radius, 3) / edges.prod();
  if (const auto* tube = std::get_if<TubeShape>(&body.shape)) {
    const double inner = tube->wall_layers
                             ? std::max(0.0, tube->outer_radius - *tube->wall_layers * *body.spacing)
                             : tube->inner_radius;
    return 0.25 * std::numbers::pi * (1 - std::pow(inner / tube->outer_radius, 2));
  }
  return 1;
}

/// Of a box in the frame of its lattice, in grid steps.
MemoryNeed lattice_need(LatticeKind kind, const Vec3& steps, double share) {
  const bool fcc = kind == LatticeKind::fcc;
  const double row = fcc ? 0.5 * steps.x() + lanes : steps.x() + 2 * lanes;
  MemoryNeed need;
  need.cells = row * (steps.y() + halo) * (steps.z() + halo);
  need.masses = share * (steps.array() + 1).prod() * (fcc ? 0.5 : 1);
  need.bytes = storage_bytes * need.cells;
  return need;
}

MemoryNeed solid_need(const BodySpec& body) {
  const Bounds bounds = bounds_of(body);
  const bool fcc = body.lattice == LatticeKind::fcc;
  const double step = fcc ? *body.spacing / std::numbers::sqrt2 : *body.spacing;
  Vec3 edges = bounds.hi - bounds.lo;
  const double share = volume_share(body, bounds);
  const double masses = share * (edges.array() / step + 1).prod() * (fcc ? 0.5 : 1);
  // The grid of a knife is turned by 45 degrees about y.
  if (std::holds_alternative<KnifeShape>(body.shape))
    edges.x() = edges.z() = (edges.x() + edges.z()) / std::numbers::sqrt2;
  MemoryNeed need = lattice_need(body.lattice, edges / step, share);
  need.masses = masses;
  if (!fcc) need.bytes += solid_bytes * (edges / step).prod();
  return need;
}

/// Of a mesh, whose nodes are known when it is read: its text and what is made of it, some times as much.
MemoryNeed mesh_need(const MeshShape& shape) {
  std::error_code none;
  const auto bytes = std::filesystem::file_size(shape.file, none);
  MemoryNeed need;
  if (!none) need.bytes = mesh_file_bytes * static_cast<double>(bytes);
  return need;
}

VolumeFacts facts_of(const VolumeShape& shape) {
  if (!shape.slices) return volume_facts(shape.file);
  const GreyPicture first = read_grey_png(shape.slices->files.front());
  return {{first.width, first.height, static_cast<int>(shape.slices->files.size())}, shape.slices->spacing};
}

double product(const std::array<int, 3>& size) {
  return std::accumulate(size.begin(), size.end(), 1.0, [](double n, int m) { return n * m; });
}

MemoryNeed image_need(const BodySpec& body, const VolumeShape& shape) {
  const VolumeFacts facts = facts_of(shape);
  const auto size = shape.partition.value_or(facts.size);
  Vec3 steps(size[0], size[1], size[2]);
  if (!shape.deformable.all) {
    const double reach = shape.deformable.nearest ? std::cbrt(*shape.deformable.nearest)
                                                  : 2.0 * shape.deformable.radius_voxels + 1;
    steps = steps.cwiseMin(reach);
  }
  if (body.lattice == LatticeKind::fcc)
    for (int axis = 0; axis < 3; ++axis)
      steps[axis] = facts.size[static_cast<std::size_t>(axis)] * facts.spacing[axis] /
                    (*body.spacing / std::numbers::sqrt2);
  MemoryNeed need = lattice_need(body.lattice, steps, 1);
  need.bytes += image_bytes * (product(size) + (shape.partition ? product(facts.size) : 0));
  if (shape.deformable.all) need.masses = 0;  // as many as are tissue
  return need;
}

bool breaks(const std::string& material, const Scene& scene) {
  return scene.material(material).break_ratio.has_value();
}
bool yields(const std::string& material, const Scene& scene) {
  return scene.material(material).yield_ratio.has_value();
}

/// What a person may write instead, so that a body takes `share` of what it does.
std::string what_fits(const BodySpec& body, double share) {
  if (std::holds_alternative<MeshShape>(body.shape)) return "a mesh with fewer tetrahedra would fit";
  const double finer = std::cbrt(share);
  if (body.spacing)
    return fmt::format("spacing_mm = {:.3g} would fit",
                       std::max(mm_from_m(*body.spacing) / finer * 1.05, 1e-6));
  return "a coarser partition would fit";
}

}  // namespace

double bytes_of_masses(double masses, const BodySpec& body, const Scene& scene) {
  const bool doubled = scene.physics->precision == Precision::double_;
  const bool undoes = std::ranges::any_of(scene.tools, cuts);
  if (std::holds_alternative<MeshShape>(body.shape)) {
    const double marked = undoes ? marked_mesh_bytes : 0;
    if (body.tet_elements == TetElements::second_order)
      return masses * (marked + (doubled ? second_order_double_bytes : second_order_bytes));
    return masses * (marked + (doubled ? mesh_double_bytes : mesh_bytes));
  }
  bool any_breaks = breaks(body.material, scene);
  bool any_yields = yields(body.material, scene);
  for (const RegionSpec& region : body.regions) {
    any_breaks = any_breaks || (!region.material.empty() && breaks(region.material, scene));
    any_yields = any_yields || (!region.material.empty() && yields(region.material, scene));
  }
  const bool felt = std::any_of(scene.tools.begin(), scene.tools.end(), meets_facets);
  const bool of_cells = body.model == ElementModel::fem;
  const bool plastic = any_breaks && !of_cells;
  const bool cut = !any_breaks && !of_cells && undoes;
  const double fem = !of_cells ? 0 : doubled ? fem_double_bytes : fem_bytes;
  const double failing = !any_breaks || !of_cells
                             ? 0
                             : (doubled ? failing_double_bytes : failing_bytes) + (felt ? felt_bytes : 0.0);
  const double yielding = !any_yields || !of_cells ? 0 : doubled ? yielding_double_bytes : yielding_bytes;
  const bool solved =
      body.model == ElementModel::fem && (scene.physics->integrator == Integrator::backward_euler ||
                                          scene.physics->integrator == Integrator::automatic);
  const double solver = !solved ? 0 : doubled ? solved_double_bytes : solved_bytes;
  const double cutting = cut ? cut_bytes + felt_bytes : 0;
  const auto* image = std::get_if<VolumeShape>(&body.shape);
  const bool in_parts = image != nullptr && image->deformable.awake;  // comes back at rest
  const double numbers = marked_numbers + (plastic ? marked_plastic_numbers : 0) +
                         (failing > 0 ? marked_failing_numbers : 0) +
                         (yielding > 0 ? marked_yielding_numbers : 0);
  const double marked = undoes && !in_parts ? numbers * (doubled ? 8 : 4) : 0;
  return masses * (fem + solver + failing + yielding + cutting + marked +
                   (plastic ? (doubled ? plastic_double_bytes : plastic_bytes) + (felt ? felt_bytes : 0.0)
                            : (doubled ? elastic_double_bytes : elastic_bytes)));
}

MemoryNeed memory_need(const BodySpec& body, const Scene& scene) {
  const auto* image = std::get_if<VolumeShape>(&body.shape);
  const auto* mesh = std::get_if<MeshShape>(&body.shape);
  MemoryNeed need = mesh != nullptr    ? mesh_need(*mesh)
                    : image != nullptr ? image_need(body, *image)
                                       : solid_need(body);
  need.bytes += bytes_of_masses(need.masses, body, scene);
  return need;
}

double usable_memory() noexcept { return 0.9 * static_cast<double>(machine_memory()); }

void refuse_too_large(const Scene& scene, const std::vector<MemoryNeed>& needs, double memory) {
  PALPATE_CHECK(needs.size() == scene.bodies.size(), "one need for each body");
  double bytes = bytes_of_program;
  for (const MemoryNeed& need : needs) bytes += need.bytes;
  const auto largest = static_cast<std::size_t>(
      std::max_element(needs.begin(), needs.end(),
                       [](const auto& a, const auto& b) { return a.bytes < b.bytes; }) -
      needs.begin());
  for (std::size_t b = 0; b < needs.size(); ++b) {
    const bool too_many = needs[b].cells > most_storage, too_much = bytes > memory && b == largest;
    if (!too_many && !too_much) continue;
    const BodySpec& body = scene.bodies[b];
    const double share = std::min(too_many ? most_storage / needs[b].cells : 1.0,
                                  too_much ? std::max(memory - bytes_of_program, 0.1 * memory) / bytes : 1.0);
    throw InputError(
        fmt::format("{}: [[body]] \"{}\" would have {:.2g} masses in {:.2g} cells, and the scene would take "
                    "{:.2g} GB of memory; "
                    "{:.2g} GB may be taken here, and {}",
                    body.place.text(), body.name, needs[b].masses > 0 ? needs[b].masses : needs[b].cells,
                    needs[b].cells, 1e-9 * bytes, 1e-9 * memory, what_fits(body, share)));
  }
}

void refuse_too_large(const Scene& scene, double memory) {
  std::vector<MemoryNeed> needs;
  for (const BodySpec& body : scene.bodies) needs.push_back(memory_need(body, scene));
  refuse_too_large(scene, needs, memory);
}

}  // namespace palpate::physics
