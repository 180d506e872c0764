#include "physics_node/mesh/surface_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/error/error.h"
#include "common/record/hdf5_file.h"
#include "common/record/part_file.h"
#include "physics_node/mesh/read_msh.h"

namespace palpate::physics {
namespace {

constexpr const char* surface_format = "palpate surface";

class SurfaceReader {
 public:
  explicit SurfaceReader(const std::string& path) : path_(path), file_(path, Hdf5File::Mode::read) {}

  SurfaceFile read() {
    if (!file_.has_attribute("format") || file_.text("format") != surface_format)
      throw InputError(path_ +
                       ": is HDF5, but not a surface of palpate; make one with palpate import --surface");
    if (file_.numbers("version") != std::vector<double>{1}) complain("is of another version than 1");
    SurfaceFile read;
    read.source = file_.text("source");
    const std::size_t n_nodes = rows_of("/nodes", most_mesh_nodes);
    const std::size_t n_triangles = rows_of("/triangles", most_mesh_tets);
    const auto places = file_.read<double>("/nodes");
    const auto corners = file_.read<std::int32_t>("/triangles");
    for (std::size_t n = 0; n < n_nodes; ++n) {
      const Vec3 x(places[3 * n], places[3 * n + 1], places[3 * n + 2]);
      if (!x.allFinite() || !(x.cwiseAbs().maxCoeff() <= farthest_mesh_node))
        complain("a place in its /nodes is not finite, or beyond 1000 m");
      read.mesh.nodes.push_back(x);
    }
    for (std::size_t t = 0; t < n_triangles; ++t) {
      const MeshTriangle triangle{corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]};
      for (const Index node : triangle)
        if (node < 0 || static_cast<std::size_t>(node) >= n_nodes)
          complain(fmt::format("its /triangles name node {}, which is not there", node));
      read.mesh.triangles.push_back(triangle);
    }
    check_surface(read.mesh, path_);
    return read;
  }

 private:
  [[noreturn]] void complain(const std::string& what) const {
    throw InputError(path_ + ": " + what + "; import the surface again");
  }
  std::size_t rows_of(const std::string& name, std::size_t most) const {
    const auto shape = file_.shape(name);
    if (shape.size() != 2 || shape[1] != 3 || shape[0] == 0 || shape[0] > most)
      complain(fmt::format("its {} is not of 1 to {} rows of 3", name, most));
    return static_cast<std::size_t>(shape[0]);
  }

  std::string path_;
  Hdf5File file_;
};

}  // namespace

bool is_surface_file(const std::string& path) {
  try {
    const Hdf5File file(path, Hdf5File::Mode::read);
    return file.has_attribute("format") && file.text("format") == surface_format;
  } catch (const std::runtime_error&) {
    return false;
  }
}

void write_surface(const std::string& path, const SurfaceFile& written) {
  const TriangleMesh& mesh = written.mesh;
  PartFile beside(path);
  try {
    Hdf5File file(beside.part(), Hdf5File::Mode::create);
    file.set_text("format", surface_format);
    file.set_numbers("version", {1});
    file.set_text("source", written.source);
    std::vector<double> places;
    for (const Vec3& x : mesh.nodes) places.insert(places.end(), x.begin(), x.end());
    std::vector<std::int32_t> corners;
    for (const MeshTriangle& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
    file.write("/nodes", {mesh.nodes.size(), 3}, places.data());
    file.write("/triangles", {mesh.triangles.size(), 3}, corners.data());
    file.close();
  } catch (const std::runtime_error& error) {
    throw InputError(std::string(error.what()) + "; make room or name another place");
  }
  beside.commit();
}

SurfaceFile read_surface_file(const std::string& path) {
  try {
    return SurfaceReader(path).read();
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {  // of Hdf5File, which names the file
    throw InputError(std::string(error.what()) + "; import the surface again");
  }
}

void check_surface(const TriangleMesh& mesh, const std::string& where) {
  std::vector<bool> used(mesh.nodes.size());
  for (const MeshTriangle& corners : mesh.triangles) {
    for (const Index node : corners) used[static_cast<std::size_t>(node)] = true;
    if (!is_flat(mesh, corners)) continue;
    const Vec3 x = 1e3 * mesh.nodes[static_cast<std::size_t>(corners[0])];
    throw InputError(fmt::format("{}: a triangle at {:.4g}, {:.4g}, {:.4g} mm has no area; mesh it anew",
                                 where, x.x(), x.y(), x.z()));
  }
  if (const std::size_t open = open_edges(mesh); open > 0)
    throw InputError(fmt::format(
        "{}: {} edges have not one triangle on either side, so the surface is not closed; mesh it anew",
        where, open));
  if (std::ranges::find(used, false) != used.end())
    throw InputError(where + ": a node of it belongs to no triangle; import the surface again");
  if (!(enclosed_volume(mesh) > 0))
    throw InputError(where + ": the surface is inside out or encloses nothing; import the surface again");
}

}  // namespace palpate::physics
