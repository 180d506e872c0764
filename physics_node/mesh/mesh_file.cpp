#include "physics_node/mesh/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/error/error.h"
#include "common/record/hdf5_file.h"
#include "common/record/part_file.h"
#include "physics_node/mesh/read_msh.h"

namespace palpate::physics {
namespace {

constexpr const char* format = "palpate mesh";

class MeshReader {
 public:
  explicit MeshReader(const std::string& path) : path_(path), file_(path, Hdf5File::Mode::read) {}

  MeshFile read() {
    if (!file_.has_attribute("format") || file_.text("format") != format)
      throw InputError(path_ + ": is HDF5, but not a palpate mesh; make one with palpate import");
    if (file_.numbers("version") != std::vector<double>{1}) complain("is of another version than 1");
    MeshFile read;
    read.source = file_.text("source");
    TetMesh& mesh = read.mesh;
    const std::size_t n_nodes = rows_of("/nodes", 3, most_mesh_nodes);
    const std::size_t n_tets = rows_of("/tetrahedra", 4, most_mesh_tets);
    if (rows_of("/region", 1, most_mesh_tets) != n_tets)
      complain("its /region and /tetrahedra are of different length");
    const auto places = file_.read<double>("/nodes");
    const auto corners = file_.read<std::int32_t>("/tetrahedra");
    mesh.region = file_.read<std::int32_t>("/region");
    mesh.nodes.resize(n_nodes);
    for (std::size_t n = 0; n < n_nodes; ++n)
      mesh.nodes[n] = {places[3 * n], places[3 * n + 1], places[3 * n + 2]};
    mesh.tets.resize(n_tets);
    for (std::size_t t = 0; t < n_tets; ++t) std::copy_n(&corners[4 * t], 4, mesh.tets[t].begin());
    check(mesh);
    return read;
  }

 private:
  [[noreturn]] void complain(const std::string& what) const {
    throw InputError(path_ + ": " + what + "; import the mesh again");
  }

  std::size_t rows_of(const std::string& name, std::uint64_t width, std::size_t most) const {
    const auto shape = file_.shape(name);
    const bool fits = width == 1 ? shape.size() == 1 : shape.size() == 2 && shape[1] == width;
    if (!fits || shape[0] == 0 || shape[0] > most)
      complain("its " + name + " is not of 1 to " + std::to_string(most) + " rows of " +
               std::to_string(width));
    return static_cast<std::size_t>(shape[0]);
  }

  void check(const TetMesh& mesh) const {
    for (const Vec3& x : mesh.nodes)
      if (!(x.cwiseAbs().maxCoeff() <= farthest_mesh_node) || !x.allFinite())
        complain("a place in its /nodes is not finite, or beyond 1000 m");
    std::vector<bool> used(mesh.nodes.size());
    for (const auto& tet : mesh.tets) {
      for (const Index node : tet) {
        if (node < 0 || static_cast<std::size_t>(node) >= mesh.nodes.size())
          complain("its /tetrahedra name node " + std::to_string(node) + ", which is not there");
        used[static_cast<std::size_t>(node)] = true;
      }
      if (is_flat(mesh, tet) || signed_volume(mesh, tet) < 0)
        complain("a tetrahedron of it is flat or inside out");
    }
    if (std::ranges::find(used, false) != used.end()) complain("a node of it belongs to no tetrahedron");
  }

  std::string path_;
  Hdf5File file_;
};

}  // namespace

bool is_mesh_file_name(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  return ending == ".h5" || ending == ".hdf5";
}

bool is_mesh_file(const std::string& path) {
  try {
    const Hdf5File file(path, Hdf5File::Mode::read);
    return file.has_attribute("format") && file.text("format") == format;
  } catch (const std::runtime_error&) {
    return false;
  }
}

void write_mesh(const std::string& path, const MeshFile& written) {
  const TetMesh& mesh = written.mesh;
  PartFile beside(path);
  try {
    Hdf5File file(beside.part(), Hdf5File::Mode::create);
    file.set_text("format", format);
    file.set_numbers("version", {1});
    file.set_text("source", written.source);
    std::vector<double> places;
    for (const Vec3& x : mesh.nodes) places.insert(places.end(), x.begin(), x.end());
    std::vector<std::int32_t> corners;
    for (const auto& tet : mesh.tets) corners.insert(corners.end(), tet.begin(), tet.end());
    file.write("/nodes", {mesh.nodes.size(), 3}, places.data());
    file.write("/tetrahedra", {mesh.tets.size(), 4}, corners.data());
    file.write("/region", {mesh.region.size()}, mesh.region.data());
    file.close();
  } catch (const std::runtime_error& error) {
    throw InputError(std::string(error.what()) + "; make room or name another place");
  }
  beside.commit();
}

MeshFile read_mesh(const std::string& path) {
  try {
    return MeshReader(path).read();
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {  // of Hdf5File, which names the file
    throw InputError(std::string(error.what()) + "; import the mesh again");
  }
}

}  // namespace palpate::physics
