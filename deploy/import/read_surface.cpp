#include "deploy/import/read_surface.h"

#include <assimp/BaseImporter.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>

#include "common/error/error.h"
#include "common/scene/complaints.h"
#include "physics_node/mesh/read_msh.h"

namespace palpate {
namespace {

std::string surface_ending(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

[[noreturn]] void complain(const std::string& path, const std::string& what) {
  throw InputError(one_line(path + ": " + what));
}

std::string bytes_of_file(const std::string& path) {
  std::error_code trouble;
  const auto status = std::filesystem::status(path, trouble);
  if (!std::filesystem::exists(status)) complain(path, "there is no such file; name a surface");
  if (!std::filesystem::is_regular_file(status)) complain(path, "is no file; name a surface");
  std::ifstream in(path, std::ios::binary);
  std::ostringstream bytes;
  if (!in) complain(path, "may not be read; ask its owner for the right to");
  if (in.peek() == std::ifstream::traits_type::eof()) complain(path, "is empty; fetch a whole copy");
  if (!(bytes << in.rdbuf()) || in.bad()) complain(path, "cannot be read; fetch a whole copy");
  return std::move(bytes).str();
}

/// Only the reader that the name asks for: a file that is something else is damaged, whatever it looks like.
void keep_reader_of(const std::string& ending, Assimp::Importer& importer) {
  const Assimp::BaseImporter* const wanted = importer.GetImporter(ending.c_str());
  for (std::size_t n = importer.GetImporterCount(); n-- > 0;) {
    Assimp::BaseImporter* const other = importer.GetImporter(n);
    if (other == wanted) continue;
    importer.UnregisterLoader(other);
    delete other;  // it is ours now
  }
}

/// Keeps the first fault that assimp logs.
class FirstFault : public Assimp::LogStream {
 public:
  explicit FirstFault(std::string& text) : text_(text) {}
  void write(const char* message) override {
    const std::string line = message;  // "Error, T0: what is wrong"
    if (text_.empty()) text_ = line.substr(line.find(": ") + 2);
  }

 private:
  std::string& text_;
};

/// While it lives, faults go to `text`.
class FaultLog {
 public:
  explicit FaultLog(std::string& text) {
    Assimp::DefaultLogger::create(nullptr, Assimp::Logger::NORMAL, 0);
    Assimp::DefaultLogger::get()->attachStream(new FirstFault(text),
                                               Assimp::Logger::Err);  // the logger's now
  }
  ~FaultLog() { Assimp::DefaultLogger::kill(); }
  FaultLog(const FaultLog&) = delete;
  FaultLog& operator=(const FaultLog&) = delete;
};

/// @param fault  in assimp's words
[[noreturn]] void complain_of_fault(const std::string& path, const std::string& ending, std::string fault) {
  if (fault.find("bad_alloc") != fault.npos) throw std::bad_alloc();
  const std::string in_memory = AI_MEMORYIO_MAGIC_FILENAME + ending;
  const auto at = fault.find(in_memory);
  if (at != fault.npos) fault.replace(at, in_memory.size(), "it");
  while (!fault.empty() && (fault.back() == '\n' || fault.back() == '.')) fault.pop_back();
  complain(path,
           "cannot be read as " + ending + " (assimp: " + fault + "); fetch a whole copy, or save it anew");
}

void add_mesh(const aiMesh& mesh, double metres, const std::string& path, SurfaceContent& content) {
  auto& [points, triangles] = content.surface;
  const std::size_t before = points.size();
  if (mesh.mNumVertices > physics::most_mesh_nodes - before)
    complain(path, "has more than 20 million points");
  for (unsigned n = 0; n < mesh.mNumVertices; ++n) {
    const aiVector3D& p = mesh.mVertices[n];
    const Vec3 x = metres * Vec3(p.x, p.y, p.z);
    // The comparison fails for what is no number, too.
    if (!(x.cwiseAbs().maxCoeff() <= physics::farthest_mesh_node) || !x.allFinite())
      complain(path,
               "has a point that is not finite, or beyond 1000 m; is its unit another, or is it damaged?");
    points.push_back(x);
  }
  for (unsigned n = 0; n < mesh.mNumFaces; ++n) {
    const aiFace& face = mesh.mFaces[n];
    if (face.mNumIndices != 3) {
      ++content.other;
      continue;
    }
    Corners corners{};
    for (unsigned c = 0; c < 3; ++c) {
      if (face.mIndices[c] >= mesh.mNumVertices)
        complain(path, "a triangle names a point that is not there; fetch a whole copy");
      corners[c] = static_cast<std::int32_t>(before + face.mIndices[c]);
    }
    triangles.push_back(corners);
  }
}

}  // namespace

bool is_surface_format(const std::string& path) {
  const std::string ending = surface_ending(path);
  return ending == ".obj" || ending == ".stl" || ending == ".ply" || ending == ".off";
}

SurfaceContent read_surface(const std::string& path, double metres) {
  const std::string bytes = bytes_of_file(path), ending = surface_ending(path);
  // Assimp looks for it for ever.
  if (ending == ".ply" && bytes.find("\nend_header") == bytes.npos)
    complain(path, "its header has no end, a line end_header; fetch a whole copy");
  Assimp::Importer importer;
  keep_reader_of(ending, importer);
  // The importer deletes it.
  importer.SetIOHandler(
      new Assimp::MemoryIOSystem(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), nullptr));
  std::string fault;
  const FaultLog log(fault);
  const aiScene* scene = importer.ReadFile(AI_MEMORYIO_MAGIC_FILENAME + ending, 0);
  if (scene == nullptr) complain_of_fault(path, ending, importer.GetErrorString());
  // Of OFF a corner that names no point is only logged, and mended by a guess. Of OBJ much is that is no fault.
  if (ending == ".off" && !fault.empty()) complain_of_fault(path, ending, fault);
  fault.clear();
  SurfaceContent content;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m)
    for (unsigned n = 0; n < scene->mMeshes[m]->mNumFaces; ++n)
      if (scene->mMeshes[m]->mFaces[n].mNumIndices > 3) ++content.polygons;
  if (content.polygons > 0) scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (scene == nullptr || !fault.empty()) complain(path, "has polygons that cannot be cut into triangles");
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) add_mesh(*scene->mMeshes[m], metres, path, content);
  if (content.surface.triangles.empty())
    complain(path, "has no triangle; a surface has faces, not points and lines alone");
  return content;
}

}  // namespace palpate
