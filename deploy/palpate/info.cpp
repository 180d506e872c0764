// palpate info FILE

#include "deploy/palpate/info.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "common/error/error.h"
#include "common/file/privacy.h"
#include "deploy/palpate/subcommands.h"
#include "physics_node/mesh/mesh_file.h"
#include "physics_node/mesh/surface_file.h"
#include "physics_node/record/mend_record.h"

namespace palpate::deploy {
namespace {

/// Instead of a file; empty: it is one.
std::string what_it_is(std::filesystem::file_status status) {
  using Type = std::filesystem::file_type;
  switch (status.type()) {
    case Type::regular:
      return {};
    case Type::not_found:
      return "no such file";
    case Type::directory:
      return "is a folder";
    case Type::fifo:
      return "is a pipe, not a file";
    case Type::socket:
      return "is a socket, not a file";
    case Type::character:
    case Type::block:
      return "is a device, not a file";
    default:
      return "cannot be looked at; check the rights of the folders above it";
  }
}

std::string info(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (const std::string what = what_it_is(status); !what.empty())
    throw InputError(fmt::format("{}: {}; give a volume, mesh, scene or record", path, what));
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".toml") return info_scene(path);
  try {
    if (extension == ".h5")
      return is_volume(path)                  ? info_volume(path)
             : physics::is_mesh_file(path)    ? info_mesh(path)
             : physics::is_surface_file(path) ? info_surface(path)
                                              : info_record(path);
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& damaged) {  // of Hdf5File, which names the file
    throw InputError(fmt::format("{}; write it again", damaged.what()));
  }
  throw InputError(fmt::format(
      "{}: is no file of palpate; give a volume, mesh or record (.h5) or a scene (.toml), or turn an "
      "image into a volume with palpate import",
      path));
}

}  // namespace

void add_info(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("info", "say what is in a volume, mesh, record or scene");
  auto path = std::make_shared<std::string>();
  auto mend = std::make_shared<bool>(false);
  command->add_option("file", *path, "volume, mesh or record (.h5), or scene (.toml)")->required();
  command->add_flag("--mend", *mend, "let other programs open a record whose session was killed");
  command->callback([path, mend, &exit_code] {
    keep_as_private_as({*path});
    if (*mend) physics::mend_record(*path);
    std::fputs(info(*path).c_str(), stdout);
    exit_code = exit_ok;
  });
}

}  // namespace palpate::deploy
