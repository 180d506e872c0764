#include "physics_node/body/build_surface_body.h"

#include <memory>
#include <utility>

#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "physics_node/body/materials.h"
#include "physics_node/body/put_in_place.h"
#include "physics_node/mesh/mesh_file.h"
#include "physics_node/mesh/read_msh.h"
#include "physics_node/mesh/surface_file.h"

namespace palpate::physics {
namespace {

/// @param tidied  what of a mesh of tetrahedra had to be mended
TriangleMesh read_triangles(const MeshShape& shape, Tidied& tidied) {
  if (!is_mesh_file_name(shape.file)) {
    const MshContent content = read_msh(shape.file, shape.metres);
    tidied = content.tidied;
    return outer_surface(content.mesh);
  }
  if (is_mesh_file(shape.file)) return outer_surface(read_mesh(shape.file).mesh);
  return read_surface_file(shape.file).mesh;
}

}  // namespace

void build_surface_body(Body& body, const BodySpec& spec, const std::vector<MaterialSpec>& materials) {
  const auto& shape = std::get<MeshShape>(spec.shape);
  const MaterialSpec& material = named(materials, spec.material);
  Tidied tidied;
  TriangleMesh triangles = read_triangles(shape, tidied);
  check_surface(triangles, shape.file);
  put_in_place(triangles.nodes, spec);
  Membrane membrane;
  membrane.modulus = *material.modulus;
  membrane.thickness = spec.membrane->thickness;
  membrane.density = *material.density;
  membrane.beta = material.viscosity_bulk.value_or(0.0) / *material.modulus;
  membrane.drag = material.drag;
  membrane.pressure = spec.membrane->pressure;
  membrane.content_modulus = spec.membrane->content_modulus;
  MeshBody mesh = mesh_body(spring_surface(std::move(triangles), membrane));
  mesh.tidied = tidied;
  for (const double mass : mesh.mass) body.inverse_mass.push_back(1 / mass);
  ElementLaw& law = body.laws.emplace_back();
  law.modulus = membrane.modulus;
  law.drag = membrane.drag;
  law.cut_toughness = material.cut_toughness.value_or(0.0);
  law.damped = membrane.beta > 0;
  law.damper = Damper::axial;
  body.law = law;
  body.mesh = std::make_shared<MeshBody>(std::move(mesh));
}

}  // namespace palpate::physics
