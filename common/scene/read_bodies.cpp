// [[body]]
#include <fmt/format.h>

#include "common/message/messages.h"
#include "common/scene/read_parts.h"

namespace palpate {
namespace {

/// The lattice and its spacing. A volume is built on its own voxels.
void read_lattice(TableReader& reader, BodySpec& spec) {
  const bool is_volume = std::holds_alternative<VolumeShape>(spec.shape);
  if (is_volume) spec.lattice = LatticeKind::voxel;
  if (const auto word = reader.read_word("lattice", {"fcc", "voxel"}))
    spec.lattice = static_cast<LatticeKind>(*word);
  if (is_volume && spec.lattice == LatticeKind::fcc)
    reader.complain("lattice", "a volume cannot stand on an \"fcc\" lattice; write \"voxel\"");
  spec.spacing = reader.read_length_mm("spacing_mm");
  if (is_volume && reader.has("spacing_mm"))
    reader.complain("spacing_mm",
                    fmt::format("\"spacing_mm\" in {}, but a volume brings its own spacing; leave it out, "
                                "or give partition = [nx, ny, nz]",
                                reader.title()));
}

BodySpec read_body(TableReader& reader, ReadContext& context) {
  BodySpec spec;
  spec.place = reader.place();
  reader.require("name", "give each body a name of its own");
  set_if(spec.name, reader.read_name("name"));
  refuse_known_name(reader, spec.name, names_of(context.scene.bodies));
  read_shape(reader, context, spec);
  read_lattice(reader, spec);
  reader.require("material", "name a [material.NAME] of this scene");
  if (const auto material = reader.read_text("material")) {
    spec.material = *material;
    refuse_unknown_reference(reader, "material", *material, names_of(context.scene.materials));
  }
  read_regions(reader, context, spec);
  set_if(spec.at, reader.read_vector_mm("at_mm"));
  set_if(spec.velocity, reader.read_vector("velocity_m_per_s"));
  read_fixed(reader, context, spec);
  reader.refuse_left_over();
  return spec;
}

}  // namespace

void read_bodies(TableReader& root, ReadContext& context) {
  for (const auto* table : tables_of_list(root, "body", max_bodies)) {
    TableReader reader(*table, list_title(*table, "body"), context.complaints);
    context.scene.bodies.push_back(read_body(reader, context));
  }
  const auto* list = root.find("body");
  if (list == nullptr || (list->is_array() && list->as_array()->empty()))
    root.complain("body", "the scene has no body; add a [[body]] with name, shape and material");
}

}  // namespace palpate
