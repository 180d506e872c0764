// [[body]]
#include <fmt/format.h>

#include "common/message/messages.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/read_parts.h"
#include "common/scene/scene.h"

namespace palpate {
namespace {

/// The lattice and its spacing. An image is built on its own voxels unless fcc is asked for.
void read_lattice(TableReader& reader, bool is_known, BodySpec& spec) {
  if (std::holds_alternative<MeshShape>(spec.shape)) return refuse_beside_mesh(reader);
  const auto* image = std::get_if<VolumeShape>(&spec.shape);
  const bool is_tool =
      std::holds_alternative<KnifeShape>(spec.shape) || std::holds_alternative<NeedleShape>(spec.shape);
  if (image != nullptr) spec.lattice = LatticeKind::voxel;
  if (const auto word = reader.read_word("lattice", {"fcc", "voxel"}))
    spec.lattice = static_cast<LatticeKind>(*word);
  const bool voxel = spec.lattice == LatticeKind::voxel;
  if (voxel && is_tool)
    reader.complain("lattice", "a knife or needle stands on an \"fcc\" lattice; leave \"lattice\" out");
  else if (voxel && image == nullptr && reader.has("theta_deg"))
    reader.complain(
        "theta_deg",
        "voxels lie along the axes of the world; leave \"theta_deg\" out, or write lattice = \"fcc\"");
  if (image != nullptr && !voxel && !image->deformable.all)
    reader.complain("deformable",
                    "on an \"fcc\" lattice all of an image deforms; leave \"deformable\" out, or cut away "
                    "the rest with a cavity");
  spec.spacing = reader.read_length_mm("spacing_mm");
  if (image != nullptr && voxel && reader.has("spacing_mm"))
    reader.complain("spacing_mm",
                    fmt::format("\"spacing_mm\" in {}, but an image brings its own spacing; leave it out, "
                                "or give partition = [nx, ny, nz], or lattice = \"fcc\"",
                                reader.title()));
  else if (is_known && (image == nullptr || !voxel) && !reader.has("spacing_mm"))
    reader.complain_lack("\"spacing_mm\"", "give the distance of neighbouring masses");
}

/// `skin`, once the lattice is known. What is made from an image has a smooth one.
void read_skin(TableReader& reader, BodySpec& spec) {
  if (std::holds_alternative<MeshShape>(spec.shape)) return;  // which has refused it
  const bool voxel = spec.lattice == LatticeKind::voxel;
  if (voxel && std::holds_alternative<VolumeShape>(spec.shape)) spec.border.skin = SkinKind::smooth;
  const auto word = reader.read_word("skin", {"bricks", "smooth"});
  if (!word) return;
  spec.border.skin = static_cast<SkinKind>(*word);
  if (!voxel)
    reader.complain("skin", "\"skin\" is of cells; write lattice = \"voxel\", or leave \"skin\" out");
}

}  // namespace

BodySpec read_body(TableReader& reader, ReadContext& context) {
  BodySpec spec;
  spec.place = reader.place();
  reader.require("name", "give each body a name of its own");
  set_if(spec.name, reader.read_name("name"));
  refuse_known_name(reader, spec.name, names_of(context.scene.bodies));
  const bool is_known = read_shape(reader, context, spec);
  read_lattice(reader, is_known, spec);
  read_skin(reader, spec);
  refuse_small_tool(reader, spec);
  reader.require("material", "name a [material.NAME] of this scene");
  if (const auto material = reader.read_text("material")) {
    spec.material = *material;
    refuse_unknown_reference(reader, "material", *material, names_of(context.scene.materials));
  }
  read_regions(reader, context, spec);
  read_elements(reader, context, spec);
  read_cavities(reader, context, spec);
  set_if(spec.at, reader.read_vector_mm("at_mm"));
  set_if(spec.velocity, reader.read_vector("velocity_m_per_s", {.lo = -1e4, .hi = 1e4}));
  read_fixed(reader, context, spec);
  if (!std::holds_alternative<MeshShape>(spec.shape)) read_handle(reader, spec);
  return spec;
}

void read_bodies(TableReader& root, ReadContext& context) {
  for (const auto* table : tables_of_list(root, "body", max_bodies)) {
    TableReader reader(*table, list_title(*table, "body"), context.complaints);
    context.scene.bodies.push_back(read_body(reader, context));
    reader.refuse_left_over();
  }
  const auto* list = root.find("body");
  if (list == nullptr || (list->is_array() && list->as_array()->empty()))
    root.complain("body", "the scene has no body; add a [[body]] with name, shape and material");
}

}  // namespace palpate
