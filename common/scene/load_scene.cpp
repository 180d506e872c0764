#include "common/scene/load_scene.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "common/error/error.h"
#include "common/math/hash.h"
#include "common/scene/apply_settings.h"
#include "common/scene/force_model.h"
#include "common/scene/read_parts.h"
#include "common/scene/scene.h"
#include "common/scene/table_reader.h"
#include "common/scene/toml_text.h"

namespace palpate {
namespace {

constexpr std::uintmax_t most_bytes = 1024 * 1024;
constexpr std::size_t most_title_bytes = 1000;  // Why: a record has room for 60 kB, a window's bar for a line

void read_root(toml::table& table, ReadContext& context) {
  auto root = TableReader::of_file(table, context.scene.path, context.complaints);
  auto& scene = context.scene;
  set_if(scene.title, root.read_text("title"));
  if (scene.title.size() > most_title_bytes)
    root.complain("title", fmt::format("\"title\" has {} bytes; at most {} are kept with what comes of it",
                                       scene.title.size(), most_title_bytes));
  if (const auto seed = root.read_integer("seed", 0, std::numeric_limits<std::int64_t>::max()))
    scene.seed = static_cast<std::uint64_t>(*seed);
  set_if(scene.gravity, root.read_vector("gravity_m_per_s2", {.lo = -1e4, .hi = 1e4}));
  read_run(root, context);
  read_physics(root, context);
  read_materials(root, context);
  read_devices(root, context);
  read_bodies(root, context);
  read_connections(root, context);
  read_tools(root, context);
  read_floor(root, context);
  read_walls(root, context);
  read_contact(root, context);
  read_render(root, context);
  read_record(root, context);
  root.refuse_left_over();
}

}  // namespace

std::string text_of_file(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::exists(path, error))
    throw InputError(path + ": no such file; give the path of a scene file (TOML)");
  if (!fs::is_regular_file(path, error))
    throw InputError(path + ": not a file; give the path of a scene file (TOML)");
  if (fs::file_size(path, error) >= most_bytes || error)
    throw InputError(path + ": too large for a scene; scene files are below 1 MiB of TOML");
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw InputError(path + ": cannot be read; check its permissions");
  return text.str();
}

std::uint64_t scene_checksum(std::string_view text, const std::vector<std::string>& settings) {
  std::uint64_t checksum = hash_text(text);
  for (const auto& setting : settings) checksum = hash_text("\n" + setting, checksum);
  return checksum;
}

Scene load_scene(const std::string& path, const std::vector<std::string>& settings) {
  return parse_scene(text_of_file(path), path, settings);
}

Scene parse_scene(std::string_view text, const std::string& path, const std::vector<std::string>& settings) {
  auto table = table_of_text(text, path);
  Scene scene;
  scene.path = path;
  scene.checksum = scene_checksum(text, settings);
  Complaints complaints;
  apply_settings(table, settings, complaints);
  ReadContext context{scene, complaints};
  read_root(table, context);
  complaints.throw_if_any();
  settle_force_models(scene);
  return scene;
}

}  // namespace palpate
