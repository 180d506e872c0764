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
#include "physics_node/record/mend_record.h"

namespace palpate::deploy {
namespace {

std::string info(const std::string& path) {
  if (!std::filesystem::is_regular_file(path))
    throw InputError(fmt::format("{}: no such file; give a volume, scene or record", path));
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".toml") return info_scene(path);
  try {
    if (extension == ".h5") return is_volume(path) ? info_volume(path) : info_record(path);
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& damaged) {  // of Hdf5File, which names the file
    throw InputError(fmt::format("{}; write it again", damaged.what()));
  }
  throw InputError(
      fmt::format("{}: is no file of palpate; give a volume or record (.h5) or a scene (.toml), or turn an "
                  "image into a volume with palpate import",
                  path));
}

}  // namespace

void add_info(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("info", "say what is in a volume, record or scene");
  auto path = std::make_shared<std::string>();
  auto mend = std::make_shared<bool>(false);
  command->add_option("file", *path, "volume or record (.h5), or scene (.toml)")->required();
  command->add_flag("--mend", *mend, "let other programs open a record whose session was killed");
  command->callback([path, mend, &exit_code] {
    keep_as_private_as({*path});
    if (*mend) physics::mend_record(*path);
    std::fputs(info(*path).c_str(), stdout);
    exit_code = exit_ok;
  });
}

}  // namespace palpate::deploy
