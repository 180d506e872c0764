// The shape "mesh": tetrahedra from a file.
#include <fmt/format.h>

#include <filesystem>

#include "common/scene/read_parts.h"
#include "common/scene/scene.h"
#include "common/scene/shape_spec.h"

namespace palpate {

MeshShape read_mesh_shape(TableReader& body, ReadContext& context) {
  MeshShape mesh;
  body.require("file", "name a mesh of tetrahedra: an .h5 of palpate import, or Gmsh's format MSH 2.2");
  const auto file = body.read_text("file");
  const std::string ending = file ? std::filesystem::path(*file).extension().string() : "";
  if (ending == ".h5" || ending == ".hdf5") {
    mesh.metres = 1;
    if (body.has("unit")) {
      body.allow({"unit"});
      body.complain("unit", "a mesh of palpate import is in metres; leave \"unit\" out");
    }
  } else {
    body.require("unit",
                 "write what one unit of the file is: \"mm\", \"cm\" or \"m\"; a mesh does not say it");
    constexpr std::array<double, 3> metres = {0.001, 0.01, 1};
    if (const auto unit = body.read_word("unit", {"mm", "cm", "m"})) mesh.metres = metres[*unit];
  }
  if (!file) return mesh;
  mesh.file = path_of(body, "file", context.scene.path, *file);
  std::error_code error;
  if (!std::filesystem::is_regular_file(mesh.file, error))
    body.complain("file", fmt::format("there is no file {}; save a mesh there, or make one with "
                                      "\"palpate import --phantom lobe --out {}\"",
                                      mesh.file, mesh.file));
  return mesh;
}

void refuse_beside_mesh(TableReader& body) {
  struct Refused {
    const char *key, *why;
  };
  constexpr Refused refused[] = {
      {"lattice", "a mesh has no lattice; leave \"lattice\" out"},
      {"spacing_mm", "a mesh brings its own spacing; leave \"spacing_mm\" out"},
      {"hourglass", "\"hourglass\" is of cells; leave it out, or choose \"elements\""},
      {"border_cells", "\"border_cells\" is of cells, and a mesh has none; leave it out"},
      {"skin", "\"skin\" is of cells, and a mesh has its own faces; leave it out"},
      {"cavity",
       "nothing can be cut out of a mesh; mesh the body with its cavity, or give a [[body]] of another "
       "shape"},
      {"handle", "a mesh cannot be led by a hand; take a body of another shape as tool"},
  };
  for (const Refused& one : refused) {
    if (!body.has(one.key)) continue;
    body.allow({one.key});
    body.complain(one.key, one.why);
  }
}

}  // namespace palpate
