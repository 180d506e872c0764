// palpate-import: an image becomes a volume file, a made brain a folder of slices, a made lobe a mesh. See docs/volume_file.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <new>

#include "common/error/error.h"
#include "common/file/privacy.h"
#include "common/math/angles.h"
#include "common/math/units.h"
#include "common/process/checked_option.h"
#include "common/process/command_line.h"
#include "common/process/machine_memory.h"
#include "common/record/part_file.h"
#include "deploy/import/brain_phantom.h"
#include "deploy/import/image_format.h"
#include "deploy/import/import_image.h"
#include "deploy/import/in_child.h"
#include "deploy/import/lobe_phantom.h"
#include "deploy/import/memory_budget.h"
#include "physics_node/mesh/mesh_quality.h"
#include "physics_node/mesh/write_msh.h"

namespace {

using namespace palpate;

struct Command {
  ImportOptions options;
  std::string out;
  bool brain = false;  // a folder of slices, no volume
  bool lobe = false;   // a mesh, no volume
  bool quiet = false;
  double memory_limit = 0;  // [bytes]
};

/// @throws CLI::ParseError
Command parse(CLI::App& app, int argc, char** argv) {
  Command command;
  std::vector<std::int64_t> size;
  std::vector<double> spacing_mm;
  std::vector<int> partition;
  std::string type, phantom;
  std::uint64_t header = 0;
  auto* image = app.add_option("image", command.options.input,
                               ".inv3, .nii[.gz], .nrrd, .mha, .raw, .inr, or a DICOM file or folder");
  auto* phantom_option = app.add_option("--phantom", phantom,
                                        "instead of an image: a made angiogram (size 336,336,140), a brain "
                                        "as PNG slices in a folder, or a lobe as "
                                        "a mesh of tetrahedra")
                             ->check(one_of({"aneurysm", "brain", "lobe"}))
                             ->excludes(image);
  app.add_option("--out", command.out, "the volume to write; of a brain, the folder; of a lobe, a .msh")
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
  double gigabytes = 0.5e-9 * static_cast<double>(machine_memory());
  app.add_option("--memory-limit", gigabytes, "most memory that it may take [GB]; else half of the machine's")
      ->check(number_in({.lo = 1e-9 * least_memory, .hi = 1e6}));
  app.add_flag("--quiet", command.quiet, "say nothing when all is well");
  app.parse(argc, argv);
  if (image->empty() && phantom.empty())
    throw CLI::RequiredError("image, or --phantom aneurysm, brain or lobe");
  command.options.phantom = !phantom.empty();
  command.memory_limit = std::max(least_memory, 1e9 * gigabytes);
  command.brain = phantom == "brain";
  command.lobe = phantom == "lobe";
  if (command.lobe && (!size.empty() || !partition.empty() || !command.options.transfer.empty()))
    throw CLI::ValidationError("--phantom lobe",
                               "is a mesh of one size; leave out --size, --partition and --transfer");
  if (command.brain && (!size.empty() || !partition.empty() || !command.options.transfer.empty()))
    throw CLI::ValidationError("--phantom brain",
                               "is slices of one size; leave out --size, --partition and --transfer");
  if (command.options.phantom) command.options.input = "phantom " + phantom;
  if (!size.empty()) command.options.raw.size = {size[0], size[1], size[2]};
  if (!spacing_mm.empty()) command.options.raw.spacing = Eigen::Vector3d(spacing_mm.data()) * m_from_mm(1);
  if (!type.empty()) command.options.raw.type = voxel_type_named(type);
  if (header_option->count() > 0) command.options.raw.header_bytes = header;
  if (!partition.empty()) command.options.partition = {partition[0], partition[1], partition[2]};
  return command;
}

/// Without the endings of image files, so that "head.nii.gz" becomes "head".
std::string stem_of(std::filesystem::path path) {
  while (path.has_extension() && path.extension().string().size() <= 5) path.replace_extension();
  return path.string();
}

/// Makes the folder that `path` lies in, where that is all that is missing: `data` of a fresh clone. A longer path that is not there
/// is more likely a typing mistake, and whoever writes says so.
void make_last_folder(const std::string& path) {
  std::error_code ignored;
  const auto folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) std::filesystem::create_directory(folder, ignored);
}

/// @throws InputError if the name would lie about what is in the file, or cannot be written
void check_output(const Command& command) {
  std::error_code ignored;
  if (!command.options.phantom && std::filesystem::equivalent(command.options.input, command.out, ignored))
    throw InputError(command.out + ": is the image itself; name another file to write");
  const std::string ending = std::filesystem::path(command.out).extension().string();
  if (ending != ".h5" && ending != ".hdf5" && !std::filesystem::is_directory(command.out, ignored))
    throw InputError(
        fmt::format("{}: a volume is an HDF5 file, and its name should say so; write --out {}.h5",
                    command.out, stem_of(command.out)));
  make_last_folder(command.out);
  check_can_write(command.out);
}

void report(const Command& command, const Volume& volume) {
  const auto [lo, hi] = std::minmax_element(volume.intensity.begin(), volume.intensity.end());
  fmt::print("{}: {} x {} x {} cells of {:g} x {:g} x {:g} mm, intensity {:g} to {:g}, written to {}\n",
             volume.source, volume.size[0], volume.size[1], volume.size[2], mm_from_m(volume.spacing[0]),
             mm_from_m(volume.spacing[1]), mm_from_m(volume.spacing[2]), *lo, *hi, command.out);
}

void make_brain(const Command& command) {
  if (const auto path = std::filesystem::path(command.out);
      path.extension() == ".h5" || path.extension() == ".png")
    throw InputError(fmt::format("{}: slices are PNG files in a folder; write --out {}", command.out,
                                 stem_of(command.out)));
  make_last_folder(command.out);
  write_brain_phantom(command.out);
  if (command.quiet) return;
  fmt::print(
      "phantom brain: {} slices of {} x {} pixels, pixel_mm = [{}, {}], plane_mm = {}, written to "
      "{}/slice_*.png\n",
      brain_planes, brain_width, brain_height, brain_pixel_mm, brain_pixel_mm, brain_plane_mm, command.out);
}

void make_lobe(const Command& command) {
  if (std::filesystem::path(command.out).extension() != ".msh")
    throw InputError(fmt::format("{}: a mesh is a .msh file, and its name should say so; write --out {}.msh",
                                 command.out, stem_of(command.out)));
  make_last_folder(command.out);
  const physics::TetMesh mesh = lobe_phantom();
  physics::write_msh(command.out, mesh, lobe_unit);
  if (command.quiet) return;
  const physics::DihedralAngles angles = physics::dihedral_angles(mesh);
  fmt::print(
      "phantom lobe: {} tetrahedra, {} nodes, dihedral angles {:.0f} to {:.0f} degrees, unit = \"mm\", "
      "written "
      "to {}\n",
      mesh.tets.size(), mesh.nodes.size(), deg_from_rad(angles.least), deg_from_rad(angles.largest),
      command.out);
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

/// All but the command line. Prints what is wrong, one line a mistake, and gives the exit code.
int import(const Command& command) {
  try {
    begin_memory(static_cast<std::uint64_t>(command.memory_limit), file_bytes(command.options.input));
    if (command.brain) {
      make_brain(command);
      return exit_ok;
    }
    if (command.lobe) {
      make_lobe(command);
      return exit_ok;
    }
    check_output(command);
    std::vector<std::string> files;
    const Volume volume = import_image(command.options, &files);
    keep_as_private_as(files);
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
  CLI::App app{"palpate import: an image becomes a volume"};
  Command command;
  add_version(app, "palpate-import");
  try {
    command = parse(app, argc, argv);
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
