// palpate-import: an image becomes a volume file or a mesh, a surface or another program's mesh a mesh, a made brain a folder of slices, a made lobe a mesh. See
// docs/volume_file.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <new>
#include <utility>

#include "common/error/error.h"
#include "common/file/privacy.h"
#include "common/math/angles.h"
#include "common/math/units.h"
#include "common/process/command_line.h"
#include "common/record/part_file.h"
#include "deploy/import/brain_phantom.h"
#include "deploy/import/image_format.h"
#include "deploy/import/import_command.h"
#include "deploy/import/in_child.h"
#include "deploy/import/lobe_phantom.h"
#include "deploy/import/memory_budget.h"
#include "deploy/import/mesh_of_surface.h"
#include "deploy/import/read_mesh_format.h"
#include "deploy/import/read_surface.h"
#include "physics_node/mesh/mesh_file.h"
#include "physics_node/mesh/mesh_pinches.h"
#include "physics_node/mesh/surface_file.h"
#include "physics_node/mesh/write_msh.h"

namespace {

using namespace palpate;
using Makes = ImportCommand::Makes;

void report(const ImportCommand& command, const Volume& volume) {
  const auto [lo, hi] = std::minmax_element(volume.intensity.begin(), volume.intensity.end());
  fmt::print("{}: {} x {} x {} cells of {:g} x {:g} x {:g} mm, intensity {:g} to {:g}, written to {}\n",
             volume.source, volume.size[0], volume.size[1], volume.size[2], mm_from_m(volume.spacing[0]),
             mm_from_m(volume.spacing[1]), mm_from_m(volume.spacing[2]), *lo, *hi, command.out);
}

/// Of a file, or of all in the folder of a DICOM series, which the library holds at once [bytes]. 0: none
std::uint64_t file_bytes(const std::string& input) {
  namespace fs = std::filesystem;
  std::error_code none;
  const bool folder = fs::is_directory(input, none);
  if (!folder && (!fs::is_regular_file(input, none) || !looks_like_dicom(input))) {
    const auto bytes = fs::file_size(input, none);
    return none ? 0 : bytes;
  }
  std::uint64_t sum = 0;
  for (const auto& entry :
       fs::directory_iterator(folder ? fs::path(input) : fs::absolute(input).parent_path(), none)) {
    const auto bytes = entry.is_regular_file(none) ? entry.file_size(none) : 0;
    if (!none) sum += bytes;
  }
  return sum;
}

void make_brain(const ImportCommand& command) {
  write_brain_phantom(command.out);
  if (command.quiet) return;
  fmt::print(
      "phantom brain: {} slices of {} x {} pixels, pixel_mm = [{}, {}], plane_mm = {}, written to "
      "{}/slice_*.png\n",
      brain_planes, brain_width, brain_height, brain_pixel_mm, brain_pixel_mm, brain_plane_mm, command.out);
}

/// As its name says: of palpate, in metres, or of Gmsh, in millimetres.
void write(const ImportCommand& command, const physics::TetMesh& mesh) {
  if (physics::is_mesh_file_name(command.out))
    physics::write_mesh(command.out,
                        {mesh, std::filesystem::path(command.options.input).filename().string()});
  else
    physics::write_msh(command.out, mesh, m_from_mm(1));
}

void report(const ImportCommand& command, const physics::TetMesh& mesh, const std::string& more) {
  if (command.quiet) return;
  const physics::DihedralAngles angles = physics::dihedral_angles(mesh);
  fmt::print("{}: {} tetrahedra, {} nodes, dihedral angles {:.0f} to {:.0f} degrees{}, {}written to {}\n",
             command.options.input, mesh.tets.size(), mesh.nodes.size(), deg_from_rad(angles.least),
             deg_from_rad(angles.largest), more,
             physics::is_mesh_file_name(command.out) ? "" : "unit = \"mm\", ", command.out);
}

void make_lobe(const ImportCommand& command) {
  const physics::TetMesh mesh = lobe_phantom();
  write(command, mesh);
  report(command, mesh, "");
}

/// @throws InputError of what no body can be made of
void check_mesh(const physics::TetMesh& mesh, const std::string& where) {
  constexpr double least_size = 1e-6;  // [m]
  const physics::OuterFaces faces = physics::outer_faces(mesh);
  if (faces.triangles.empty() || faces.of_more > 0)
    throw InputError(
        where +
        ": its tetrahedra lie upon each other: faces are of more than two, or all are of two; mesh each "
        "place once");
  const double size = physics::box_of(mesh).sizes().maxCoeff();
  if (size < least_size)
    throw InputError(fmt::format("{}: it measures {:.3g} mm; is its unit another?", where, mm_from_m(size)));
}

void import_mesh(const ImportCommand& command) {
  // A tetrahedron is some 30 bytes of text, and 20 of its own, 100 while its faces are sorted.
  constexpr double bytes_a_byte = 8;
  declare_cells(command.options.input, file_bytes(command.options.input), bytes_a_byte);
  keep_as_private_as({command.options.input});
  const physics::MshContent content = read_mesh_format(command.options.input, command.unit);
  check_mesh(content.mesh, command.options.input);
  write(command, content.mesh);
  std::string more;
  if (content.tidied.turned > 0) more += fmt::format(", {} turned", content.tidied.turned);
  if (content.tidied.unused > 0) more += fmt::format(", {} nodes of none left out", content.tidied.unused);
  if (content.other > 0) more += fmt::format(", {} elements without volume left out", content.other);
  const std::size_t pieces = physics::n_pieces_of(content.mesh);
  if (pieces > 1) more += fmt::format(", in {} pieces", pieces);
  report(command, content.mesh, more);
}

std::string words_of(const SurfaceContent& content, const ClosedSurface& closed) {
  const SurfaceMended& mended = closed.mended;
  std::string more;
  const auto add = [&more](std::size_t n, const char* what) {
    if (n > 0) more += fmt::format(", {} {}", n, what);
  };
  add(content.polygons, "polygons cut into triangles");
  add(mended.welded, "points welded");
  add(mended.degenerate, "triangles without area left out");
  add(mended.unused, "points of none left out");
  add(content.other, "points and lines left out");
  add(mended.turned, "triangles turned");
  if (mended.cutting > 0)
    more += fmt::format(", {} triangles that go through others, first at {:.4g}, {:.4g}, {:.4g} mm",
                        mended.cutting, mm_from_m(mended.cut.x()), mm_from_m(mended.cut.y()),
                        mm_from_m(mended.cut.z()));
  return more;
}

/// Reads a surface within the memory that there is, and closes it.
std::pair<SurfaceContent, ClosedSurface> read_closed(const ImportCommand& command) {
  const std::string& file = command.options.input;
  declare_cells(file, file_bytes(file), surface_bytes_a_byte);
  keep_as_private_as({file});
  SurfaceContent content = read_surface(file, command.unit);
  ClosedSurface closed = close_surface(content.surface, file);
  return {std::move(content), std::move(closed)};
}

void fill_surface(const ImportCommand& command) {
  const std::string& file = command.options.input;
  const auto [content, closed] = read_closed(command);
  SurfaceMeshOptions options{.edge = command.mesh.edge};
  options.before_lattice = [&](double points) {
    declare_cells("--tetrahedra-mm", static_cast<std::uint64_t>(points), lattice_point_bytes);
  };
  const SurfaceMesh made = mesh_of_surface(closed, options, file);
  check_mesh(made.mesh, file);
  write(command, made.mesh);
  std::string more =
      fmt::format(", {:.4g} cm3 of the surface's {:.4g} cm3", 1e6 * made.filled, 1e6 * closed.volume);
  more += words_of(content, closed);
  if (made.pieces > 1) more += fmt::format(", in {} pieces", made.pieces);
  report(command, made.mesh, more);
}

void import_surface(const ImportCommand& command) {
  const std::string& file = command.options.input;
  const auto [content, closed] = read_closed(command);
  const physics::TriangleMesh mesh{closed.surface.points, closed.surface.triangles};
  physics::check_surface(mesh, file);
  physics::write_surface(command.out, {mesh, std::filesystem::path(file).filename().string()});
  if (command.quiet) return;
  fmt::print("{}: {} triangles, {} nodes, around {:.4g} cm3{}, written to {}\n", file, mesh.triangles.size(),
             mesh.nodes.size(), 1e6 * closed.volume, words_of(content, closed), command.out);
}

void mesh_image(const ImportCommand& command, const Volume& volume) {
  const std::string& image = command.options.input;
  declare_cells(image, volume.n_cells(), meshed_cell_bytes);
  ImageMeshOptions options = command.mesh;
  options.before_lattice = [&](double points) {
    declare_cells("--tetrahedra-mm", static_cast<std::uint64_t>(points), lattice_point_bytes);
  };
  const ImageMesh made = mesh_of_image(volume, options, image);
  write(command, made.mesh);
  std::string more =
      fmt::format(", {:.4g} cm3 of {:.4g} cm3 of tissue", 1e6 * made.filled, 1e6 * made.tissue);
  for (std::size_t n = 0; made.regions.size() > 1 && n < made.regions.size(); ++n)
    more += fmt::format(", region {}: {:.4g} of {:.4g}", n, 1e6 * made.regions[n].filled,
                        1e6 * made.regions[n].tissue);
  if (made.pieces > 1)
    more += fmt::format(", in {} pieces{}", made.pieces,
                        options.largest ? ", as thin parts are lost (write a smaller --tetrahedra-mm)"
                                        : " (--largest keeps the tissue of one)");
  report(command, made.mesh, more);
}

/// All but the command line. Prints what is wrong, one line a mistake, and gives the exit code.
int import(const ImportCommand& command) {
  try {
    begin_memory(static_cast<std::uint64_t>(command.memory_limit), file_bytes(command.options.input));
    check_output(command);
    if (command.makes == Makes::brain) return make_brain(command), exit_ok;
    if (command.makes == Makes::lobe) return make_lobe(command), exit_ok;
    if (command.makes == Makes::mesh_of_file) return import_mesh(command), exit_ok;
    if (command.makes == Makes::mesh_of_surface) return fill_surface(command), exit_ok;
    if (command.makes == Makes::surface) return import_surface(command), exit_ok;
    std::vector<std::string> files;
    const Volume volume = import_image(command.options, &files);
    keep_as_private_as(files);
    if (command.makes == Makes::mesh_of_image) return mesh_image(command, volume), exit_ok;
    write_volume(volume, command.out);
    if (!command.quiet) report(command, volume);
    return exit_ok;
  } catch (const InputError& error) {
    for (const auto& line : error.complaints()) fmt::print(stderr, "{}\n", line);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr,
               "{}: asks for more memory than an image of its size needs, or than --memory-limit allows; it "
               "is probably "
               "damaged\n",
               command.options.input);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", command.options.input, error.what());
    return exit_failed;
  }
  return exit_mistake;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"palpate import: an image becomes a volume or a mesh"};
  ImportCommand command;
  add_version(app, "palpate-import");
  try {
    command = parse_import(app, argc, argv);
  } catch (const CLI::Success& wanted) {
    return app.exit(wanted);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "palpate import: {}; see palpate import --help\n", mistake_text(app, error));
    return exit_mistake;
  }
  const auto still_there = [&](int seconds) {
    if (!command.quiet)
      fmt::print(stderr, "palpate import: {} s so far with {}\n", seconds, command.options.input);
  };
  const int code = run_in_child([&] { return import(command); }, still_there);
  if (code >= 0) return code;
  remove_part(command.out);
  if (code == -SIGINT || code == -SIGTERM) return exit_failed;  // as the person wished
  fmt::print(stderr,
             "{}: reading it was cut off by signal {}, so it is probably damaged; fetch a whole copy\n",
             command.options.input, -code);
  return exit_mistake;
}
