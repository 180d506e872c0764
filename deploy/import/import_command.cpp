#include "deploy/import/import_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "common/error/error.h"
#include "common/math/units.h"
#include "common/process/checked_option.h"
#include "common/process/command_line.h"
#include "common/process/machine_memory.h"
#include "common/record/part_file.h"
#include "deploy/import/memory_budget.h"
#include "deploy/import/read_mesh_format.h"
#include "deploy/import/read_surface.h"

namespace palpate {
namespace {

using Makes = ImportCommand::Makes;

void refuse(bool wrong, const char* option, const char* why) {
  if (wrong) throw CLI::ValidationError(option, why);
}

}  // namespace

ImportCommand parse_import(CLI::App& app, int argc, char** argv) {
  ImportCommand command;
  std::vector<std::int64_t> size;
  std::vector<double> spacing_mm, keep;
  std::vector<int> partition;
  std::string type, phantom, unit;
  std::uint64_t header = 0;
  auto* image =
      app.add_option("image", command.options.input,
                     ".inv3, .nii[.gz], .nrrd, .mha, .raw, .inr, or a DICOM file or folder; or a "
                     "mesh of tetrahedra: .msh, .vtk, .mesh; or a closed surface: .obj, .stl, .ply, .off");
  auto* phantom_option = app.add_option("--phantom", phantom,
                                        "instead of an image: a made angiogram (size 336,336,140), a brain "
                                        "as PNG slices in a folder, or a lobe as "
                                        "a mesh of tetrahedra")
                             ->check(one_of({"aneurysm", "brain", "lobe"}))
                             ->excludes(image);
  app.add_option("--out", command.out,
                 "the volume or mesh to write (.h5); of a brain, the folder; a mesh may be a .msh")
      ->required();
  app.add_option("--size", size, "raw, phantom: cells nx,ny,nz")->delimiter(',')->expected(3);
  app.add_option("--spacing-mm", spacing_mm, "raw: spacing x,y,z")
      ->delimiter(',')
      ->expected(3)
      ->excludes(phantom_option);
  app.add_option("--type", type, "raw: kind of number")
      ->check(one_of({"int16", "uint8", "uint16", "float32"}))
      ->excludes(phantom_option);
  auto* header_option = app.add_option("--header", header, "raw: bytes to skip")->excludes(phantom_option);
  app.add_option("--partition", partition, "resample to nx,ny,nz cells")->delimiter(',')->expected(3);
  app.add_option("--transfer", command.options.transfer, "colours")->check(one_of({"ct", "grey"}));
  double tetrahedra_mm = 0;
  auto* tetrahedra =
      app.add_option(
             "--tetrahedra-mm", tetrahedra_mm,
             "instead of a volume, fill the tissue of an image, or a surface, with tetrahedra of this size")
          ->check(number_in({.lo = 0.01, .hi = 1000}));
  app.add_option("--keep", keep,
                 "with --tetrahedra-mm: lowest,highest intensity that is tissue; again for each further one")
      ->delimiter(',')
      ->expected(2)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->needs(tetrahedra);
  app.add_flag("--largest", command.mesh.largest, "with --tetrahedra-mm: only the largest part of the tissue")
      ->needs(tetrahedra);
  bool surface = false;
  app.add_flag("--surface", surface, "of a surface: keep its triangles, for springs on their edges")
      ->excludes(tetrahedra);
  app.add_option("--unit", unit, "of a mesh or surface: what one unit of its file is")
      ->check(one_of({"mm", "cm", "m"}));
  double gigabytes = 0.5e-9 * static_cast<double>(machine_memory());
  app.add_option("--memory-limit", gigabytes, "most memory that it may take [GB]; else half of the machine's")
      ->check(number_in({.lo = 0.3, .hi = 1e6}));
  app.add_flag("--quiet", command.quiet, "say nothing when all is well");
  app.parse(argc, argv);
  if (image->empty() && phantom.empty())
    throw CLI::RequiredError("image, or --phantom aneurysm, brain or lobe");
  command.options.phantom = !phantom.empty();
  command.memory_limit = std::max(least_memory, 1e9 * gigabytes);
  if (phantom == "brain") command.makes = Makes::brain;
  if (phantom == "lobe") command.makes = Makes::lobe;
  if (phantom.empty() && is_mesh_format(command.options.input)) command.makes = Makes::mesh_of_file;
  if (phantom.empty() && is_surface_format(command.options.input)) command.makes = Makes::mesh_of_surface;
  const bool of_file = command.makes == Makes::mesh_of_file || command.makes == Makes::mesh_of_surface;
  refuse(surface && command.makes != Makes::mesh_of_surface, "--surface",
         "is of a surface (.obj, .stl, .ply or .off); leave it out");
  const bool of_cells = !size.empty() || !partition.empty() || !command.options.transfer.empty();
  refuse(of_cells && command.makes == Makes::lobe, "--phantom lobe",
         "is a mesh of one size; leave out --size, --partition and --transfer");
  refuse(of_cells && command.makes == Makes::brain, "--phantom brain",
         "is slices of one size; leave out --size, --partition and --transfer");
  const bool raw = !spacing_mm.empty() || !type.empty() || header_option->count() > 0;
  refuse((of_cells || raw || tetrahedra_mm > 0) && command.makes == Makes::mesh_of_file, "image",
         "is a mesh of tetrahedra already; leave out what is of images");
  refuse(
      (of_cells || raw || !keep.empty() || command.mesh.largest) && command.makes == Makes::mesh_of_surface,
      "image", "is a surface; leave out what is of images");
  refuse(
      !unit.empty() && !of_file, "--unit",
      "is of a mesh (.msh, .vtk or .mesh) or a surface (.obj, .stl, .ply or .off); an image brings its own");
  refuse(of_file && unit.empty(), "--unit",
         "write --unit mm, cm or m: a mesh does not say what one unit of it is");
  refuse(command.makes == Makes::mesh_of_surface && tetrahedra_mm == 0 && !surface, "--tetrahedra-mm",
         "write how large the tetrahedra shall be that fill the surface, or --surface");
  if (surface) command.makes = Makes::surface;
  command.mesh.edge = m_from_mm(tetrahedra_mm);
  if (tetrahedra_mm > 0 && command.makes != Makes::mesh_of_surface) {
    refuse(command.makes != Makes::volume, "--tetrahedra-mm", "is of an image; leave it out");
    refuse(keep.empty(), "--tetrahedra-mm",
           "write --keep LOWEST,HIGHEST too: the intensities that are tissue");
    for (std::size_t n = 0; n < keep.size(); n += 2) {
      refuse(!(keep[n] <= keep[n + 1]), "--keep",
             "names the lowest intensity first, then the highest; both are numbers");
      for (std::size_t m = 0; m < n; m += 2)
        refuse(keep[m] <= keep[n + 1] && keep[n] <= keep[m + 1], "--keep",
               "given again names other intensities: a cell is of one tissue");
      if (n > 0) command.mesh.others.push_back({keep[n], keep[n + 1]});
    }
    refuse(!command.options.transfer.empty() || !partition.empty(), "--tetrahedra-mm",
           "makes a mesh; --transfer and --partition are of volumes, leave them out");
    command.makes = Makes::mesh_of_image;
    command.mesh.keep_min = keep[0], command.mesh.keep_max = keep[1];
  }
  command.unit = unit == "mm" ? 0.001 : unit == "cm" ? 0.01 : 1;
  if (command.options.phantom) command.options.input = "phantom " + phantom;
  if (!size.empty()) command.options.raw.size = {size[0], size[1], size[2]};
  if (!spacing_mm.empty()) command.options.raw.spacing = Eigen::Vector3d(spacing_mm.data()) * m_from_mm(1);
  if (!type.empty()) command.options.raw.type = voxel_type_named(type);
  if (header_option->count() > 0) command.options.raw.header_bytes = header;
  if (!partition.empty()) command.options.partition = {partition[0], partition[1], partition[2]};
  return command;
}

std::string stem_of(const std::string& name) {
  std::filesystem::path path = name;
  while (path.has_extension() && path.extension().string().size() <= 5) path.replace_extension();
  return path.string();
}

void make_last_folder(const std::string& path) {
  std::error_code ignored;
  const auto folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) std::filesystem::create_directory(folder, ignored);
}

void check_output(const ImportCommand& command) {
  std::error_code ignored;
  const std::string ending = std::filesystem::path(command.out).extension().string();
  const bool hdf5 = ending == ".h5" || ending == ".hdf5";
  const bool folder = std::filesystem::is_directory(command.out, ignored);
  if (!command.options.phantom && std::filesystem::equivalent(command.options.input, command.out, ignored))
    throw InputError(command.out + ": is the image itself; name another file to write");
  switch (command.makes) {
    case Makes::brain:
      if (ending == ".h5" || ending == ".png")
        throw InputError(fmt::format("{}: slices are PNG files in a folder; write --out {}", command.out,
                                     stem_of(command.out)));
      return make_last_folder(command.out);
    case Makes::lobe:
    case Makes::mesh_of_image:
    case Makes::mesh_of_file:
    case Makes::mesh_of_surface:
      if (ending != ".msh" && !hdf5 && !folder)
        throw InputError(
            fmt::format("{}: a mesh is an .h5 or .msh file, and its name should say so; write --out {}.h5",
                        command.out, stem_of(command.out)));
      break;
    case Makes::surface:
      if (!hdf5 && !folder)
        throw InputError(
            fmt::format("{}: a surface is an HDF5 file, and its name should say so; write --out {}.h5",
                        command.out, stem_of(command.out)));
      break;
    case Makes::volume:
      if (!hdf5 && !folder)
        throw InputError(
            fmt::format("{}: a volume is an HDF5 file, and its name should say so; write --out {}.h5",
                        command.out, stem_of(command.out)));
  }
  make_last_folder(command.out);
  check_can_write(command.out);
}

}  // namespace palpate
