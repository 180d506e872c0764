#include "deploy/import/read_mesh_format.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/error/error.h"

namespace palpate {
namespace {

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// What stands after $MeshFormat.
bool is_of_version_4(std::string_view text) {
  const auto at = text.find_first_not_of(" \t\r\n", text.find("$MeshFormat") + 11);
  return text.starts_with("$MeshFormat") && at != std::string_view::npos &&
         text.substr(at).starts_with("4.1");
}

}  // namespace

bool is_mesh_format(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".msh" || ending == ".vtk" || ending == ".mesh";
}

physics::MshContent read_mesh_format(const std::string& path, double metres) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream read;
  if (!in || !(read << in.rdbuf()) || in.bad())
    throw InputError(path + ":1:1: cannot be read; give a mesh of tetrahedra");
  const std::string text = std::move(read).str();
  if (ending_of(path) == ".vtk") return parse_vtk_mesh(text, path, metres);
  if (ending_of(path) == ".mesh") return parse_medit(text, path, metres);
  return is_of_version_4(text) ? parse_msh4(text, path, metres) : physics::parse_msh(text, path, metres);
}

}  // namespace palpate
