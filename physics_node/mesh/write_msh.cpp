#include "physics_node/mesh/write_msh.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "common/error/error.h"
#include "common/record/part_file.h"

namespace palpate::physics {

std::string msh_text(const TetMesh& mesh, double metres) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "$Nodes\n{}\n", mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const Vec3 x = mesh.nodes[n] / metres;
    fmt::format_to(out, "{} {:.9g} {:.9g} {:.9g}\n", n + 1, x.x(), x.y(), x.z());
  }
  fmt::format_to(out, "$EndNodes\n$Elements\n{}\n", mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& [a, b, c, d] = mesh.tets[t];
    // Kind 4 with two tags: its physical group, and the same as elementary one.
    fmt::format_to(out, "{} 4 2 {} {} {} {} {} {}\n", t + 1, mesh.region[t], mesh.region[t], a + 1, b + 1,
                   c + 1, d + 1);
  }
  text += "$EndElements\n";
  return text;
}

void write_msh(const std::string& path, const TetMesh& mesh, double metres) {
  PartFile file(path);
  std::ofstream out(file.part(), std::ios::binary);
  if (!(out << msh_text(mesh, metres)).flush())
    throw InputError(path + ": cannot be written; is the disk full?");
  out.close();
  file.commit();
}

}  // namespace palpate::physics
