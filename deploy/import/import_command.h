#pragma once
// What a person asks of palpate import.

#include <CLI/CLI.hpp>
#include <string>

#include "deploy/import/import_image.h"
#include "deploy/import/mesh_of_image.h"

namespace palpate {

struct ImportCommand {
  /// An image becomes a volume; or slices, or a mesh, are made by formulas; or a mesh of a volume's tissue, of another program's file,
  /// or of what a surface encloses; or that surface alone.
  enum class Makes { volume, brain, lobe, mesh_of_image, mesh_of_file, mesh_of_surface, surface };
  Makes makes = Makes::volume;
  ImportOptions options;
  ImageMeshOptions mesh;
  double unit = 0;  // of a mesh or surface file [m]
  std::string out;
  bool quiet = false;
  double memory_limit = 0;  // [bytes]
};

/// @throws CLI::ParseError
ImportCommand parse_import(CLI::App& app, int argc, char** argv);

/// Without the endings of image and mesh files, so that "head.nii.gz" becomes "head".
std::string stem_of(const std::string& path);

/// Makes the folder that `path` lies in, where that is all that is missing: `data` of a fresh clone. A longer path that is not there
/// is more likely a typing mistake, and whoever writes says so.
void make_last_folder(const std::string& path);

/// @throws InputError if the name would lie about what is in the file, or cannot be written
void check_output(const ImportCommand& command);

}  // namespace palpate
