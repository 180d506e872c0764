#pragma once
// The parts of a scene file, one function each; each has its own .cpp. They add what they read to the scene and
// what is wrong to the complaints. Materials and devices come before the bodies and tools that name them.

#include <string>
#include <vector>

#include "common/scene/body_spec.h"
#include "common/scene/complaints.h"
#include "common/scene/scene.h"
#include "common/scene/table_reader.h"

namespace palpate {

struct ReadContext {
  Scene& scene;  // read so far
  Complaints& complaints;
  std::vector<std::string> with_poisson_ratio = {};  // materials that state it
};

void read_run(TableReader& root, ReadContext& context);          // [scene]
void read_physics(TableReader& root, ReadContext& context);      // [physics]
void read_floor(TableReader& root, ReadContext& context);        // [floor]
void read_walls(TableReader& root, ReadContext& context);        // [[wall]]
void read_contact(TableReader& root, ReadContext& context);      // [contact]
void read_materials(TableReader& root, ReadContext& context);    // [material.NAME]
void read_devices(TableReader& root, ReadContext& context);      // [device.NAME]
void read_bodies(TableReader& root, ReadContext& context);       // [[body]]
void read_tools(TableReader& root, ReadContext& context);        // [[tool]]
void read_connections(TableReader& root, ReadContext& context);  // [[connection]], whose bodies are known
void read_render(TableReader& root, ReadContext& context);       // [render]
void read_record(TableReader& root, ReadContext& context);       // [record]

/// A body from its table, which may hold other keys, too.
BodySpec read_body(TableReader& reader, ReadContext& context);
/// The shape of a body and the keys that belong to it. @return whether there is such a shape
bool read_shape(TableReader& body, ReadContext& context, BodySpec& spec);
/// A blade of fewer than two cells is none, nor is a tube without a hole or without a shaft above its bevel.
void refuse_small_tool(TableReader& body, const BodySpec& spec);
VolumeShape read_volume_shape(TableReader& body, ReadContext& context);
VolumeShape read_slices_shape(TableReader& body, ReadContext& context);
MeshShape read_mesh_shape(TableReader& body, ReadContext& context);
/// Keys of a body that a mesh has no use for.
void refuse_beside_mesh(TableReader& body);
/// The path that a key names: from the folder of the scene, or from here where it is given by --set.
std::string path_of(TableReader& body, std::string_view key, const std::string& scene_path,
                    const std::string& file);
/// `fixed` of a body: faces and boxes.
void read_fixed(TableReader& body, ReadContext& context, BodySpec& spec);
/// `handle` of a body: faces instead of those that its shape is held at.
void read_handle(TableReader& body, BodySpec& spec);
/// `regions` of a body, whose shape and material are known by now.
void read_regions(TableReader& body, ReadContext& context, BodySpec& spec);
/// `model`, `hourglass`, `elements`, `border_cells` and `start` of a body, whose lattice and materials are known by now.
void read_elements(TableReader& body, ReadContext& context, BodySpec& spec);
/// What a surface of springs has of its own, and what of a scene it cannot follow; such keys where there is none.
void read_membrane(TableReader& body, const ReadContext& context, BodySpec& spec);
void refuse_membrane_keys(TableReader& body);
/// [[body.cavity]]
void read_cavities(TableReader& body, ReadContext& context, BodySpec& spec);

/// box_min_mm and box_max_mm; center_mm and radius_mm.
BoxRegion read_box_place(TableReader& reader);
BallRegion read_ball_place(TableReader& reader);

/// The tables of [[key]]; complains if the key holds anything else.
std::vector<const toml::table*> tables_of_list(TableReader& root, const std::string& key, std::size_t most);

/// The tables of [key.NAME] in the order of the file; complains about anything else and about bad names.
std::vector<std::pair<std::string, const toml::table*>> named_tables(TableReader& root,
                                                                     const std::string& key);

/// '[[body]] "head"', or '[[body]]' where it has no name.
std::string list_title(const toml::table& table, const std::string& key);

/// Complains if two of `specs` have one name.
void refuse_known_name(TableReader& reader, const std::string& name, const std::vector<std::string>& taken);

/// "there is no [material.skn]; did you mean ..."; nothing to say if `wanted` is among `names`.
void refuse_unknown_reference(TableReader& reader, const std::string& key, const std::string& wanted,
                              const std::vector<std::string>& names);

template <class Spec>
std::vector<std::string> names_of(const std::vector<Spec>& specs) {
  std::vector<std::string> names;
  for (const auto& spec : specs) names.push_back(spec.name);
  return names;
}

}  // namespace palpate
