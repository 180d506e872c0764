// idl -> common -> {physics, haptic, render}_node -> {tests, bench, deploy}, and one door for each foreign header.
#include <algorithm>
#include <map>
#include <regex>

#include "tests/house/house_rules.h"

namespace palpate::house {
namespace {

using Words = std::vector<std::string>;

const Words nodes = {"physics_node", "haptic_node", "render_node"};

/// Rooms that a room may include, besides itself.
const std::map<std::string, Words> allowed = {
    {"idl", {}},
    {"common", {"idl"}},
    {"physics_node", {"idl", "common"}},
    {"haptic_node", {"idl", "common"}},
    {"render_node", {"idl", "common"}},
    {"deploy", {"idl", "common", "physics_node", "haptic_node", "render_node"}},
    {"bench", {"idl", "common", "physics_node", "haptic_node", "render_node", "deploy"}},
    {"tests", {"idl", "common", "physics_node", "haptic_node", "render_node", "deploy", "bench"}},
};

struct Door {
  std::string name;      // of what is behind it
  std::regex header;     // as written in the include
  std::regex may_enter;  // paths of files
  std::string where;     // the same for a person
};

const std::vector<Door>& doors() {
  static const std::vector<Door> all = {
      {"DDS", std::regex("^(dds/|ddsc/|palpate\\.h$|idl/palpate\\.h$)"),
       std::regex("^(common/wire/|bench/wire/|(physics|haptic|render)_node/wire|tests/)"),
       "common/wire, the wire.* of a node, and bench/wire"},
      {"HDF5", std::regex("^(hdf5|H5)"), std::regex("^(common/record/|tests/)"), "common/record"},
      {"PNG", std::regex("^(png|pngconf|libpng.*/png)\\.h$"),
       std::regex("^(common/record/png_|render_node/image/|tests/)"),
       "common/record/png_* and render_node/image"},
      {"libdeflate", std::regex("^libdeflate\\.h$"), std::regex("^render_node/image/packed_rows\\.cpp$"),
       "render_node/image/packed_rows.cpp"},
      {"toml++", std::regex("^toml(\\+\\+|plusplus)/"), std::regex("^common/scene/"), "common/scene"},
      {"GL", std::regex("^(GL/|GLES|GLFW/|EGL/|epoxy/|glad/|imgui|backends/imgui)"),
       std::regex("^render_node/(gl|ui)/"), "render_node/gl and render_node/ui"},
      {"ITK", std::regex("^itk"), std::regex("^deploy/import/read_itk"), "deploy/import/read_itk*"},
      {"assimp", std::regex("^assimp/"), std::regex("^deploy/import/read_surface\\.cpp$"),
       "deploy/import/read_surface.cpp"},
      {"libarchive", std::regex("^archive(_entry)?\\.h$"), std::regex("^(deploy/import/|tests/)"),
       "deploy/import"},
      {"dlopen", std::regex("^dlfcn\\.h$"),
       std::regex("^(haptic_node/(device|drivers/kit)/|deploy/palpate/(doctor|probe_)|tests/)"),
       "haptic_node/device, haptic_node/drivers/kit and the doctor of deploy/palpate"},
      {"libspnav", std::regex("^spnav"), std::regex("^haptic_node/drivers/spacenav/"), "the driver spacenav"},
      {"OpenIGTLink", std::regex("^(openigtlink/|igtl)"),
       std::regex("^(haptic_node/drivers/openigtlink/|tests/)"), "the driver openigtlink"},
      {"Google Benchmark", std::regex("^benchmark/"), std::regex("^bench/"), "bench"},
      {"JSON", std::regex("^nlohmann/"),
       std::regex("report|summary|part|json_file|drivers/inverse3/haply_message|^deploy/|^tests/|^bench/"),
       "files about reports and summaries, haply_message of the driver inverse3, and deploy"},
  };
  return all;
}

std::string room_of(const std::string& path) { return path.substr(0, path.find('/')); }

bool is_source(const std::string& path) {
  static const std::regex source("\\.(h|hpp|c|cc|cpp|idl|inl)$");
  return std::regex_search(path, source);
}

/// What is wrong with including `header` from `path`; empty if nothing.
std::string complaint(const std::string& path, const std::string& header, bool quoted) {
  for (const auto& door : doors())
    if (std::regex_search(header, door.header) && !std::regex_search(path, door.may_enter))
      return "includes <" + header + ">; " + door.name + " has its door in " + door.where;
  const auto from = room_of(path), to = room_of(header);
  const bool to_room = allowed.count(to) > 0 && header.find('/') != header.npos;
  if (!to_room) {
    const bool made_by_the_build = header == "palpate.h" || header == "palpate_commit.h";
    const bool foreign = std::any_of(doors().begin(), doors().end(), [&header](const Door& door) {
      return std::regex_search(header, door.header);
    });
    if (quoted && !made_by_the_build && !foreign)
      return "includes \"" + header + "\"; write the path from the root of the repository";
    return "";
  }
  const auto rooms = allowed.find(from);
  if (rooms == allowed.end() || from == to) return "";
  if (std::count(rooms->second.begin(), rooms->second.end(), to) > 0) return "";
  const bool both_nodes =
      std::count(nodes.begin(), nodes.end(), from) + std::count(nodes.begin(), nodes.end(), to) == 2;
  return "includes \"" + header + "\"; " +
         (both_nodes ? "nodes never include each other, they meet in common/message"
                     : from + " may not know " + to + ": idl -> common -> nodes -> tests, bench, deploy");
}

}  // namespace

std::vector<std::string> include_breaches(const SourceFile& file) {
  static const std::regex include("^\\s*#\\s*include\\s*([<\"])([^>\"]+)[>\"]");
  std::vector<std::string> breaches;
  if (!is_source(file.path)) return breaches;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    std::smatch match;
    if (!std::regex_search(file.lines[i], match, include)) continue;
    const auto what = complaint(file.path, match[2], match[1] == "\"");
    if (!what.empty()) breaches.push_back(file.path + ":" + std::to_string(i + 1) + ": " + what);
  }
  return breaches;
}

}  // namespace palpate::house
