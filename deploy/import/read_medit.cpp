// Medit's format in ASCII (.mesh), as Gmsh, TetGen, Mmg and CGAL write it.
#include <cctype>

#include "deploy/import/read_mesh_format.h"
#include "deploy/import/tet_builder.h"

namespace palpate {
namespace {

class MeditReader {
 public:
  MeditReader(std::string_view text, const std::string& name, double metres)
      : words_(text, name), builder_(words_, metres) {}

  physics::MshContent read() {
    words_.expect("MeshVersionFormatted");
    builder_.integer("version", 1, 4);
    bool has_nodes = false;
    for (auto word = words_.next(); !word.empty() && word != "End"; word = words_.next()) {
      if (word.front() == '#') {
        words_.end_line();
      } else if (word == "Dimension") {
        if (builder_.integer("number of dimensions", 2, 3) != 3)
          words_.complain("a flat mesh; it should be of dimension 3");
      } else if (word == "Vertices" && !has_nodes) {
        has_nodes = true;
        read_vertices();
      } else if (word == "Tetrahedra") {
        if (!has_nodes) words_.complain("Tetrahedra before Vertices; vertices come first");
        read_tets();
      } else if (std::isalpha(static_cast<unsigned char>(word.front())) != 0) {
        skip(std::string(word));
      } else {
        words_.complain(physics::MeshWords::quoted(word) + " where a keyword should stand");
      }
    }
    return builder_.done();
  }

 private:
  void read_vertices() {
    const std::size_t n = builder_.count("number of vertices", physics::most_mesh_nodes, 8);
    for (std::size_t i = 0; i < n; ++i) {
      builder_.read_node(static_cast<long long>(i) + 1);
      words_.end_line();  // its reference
    }
    builder_.end_nodes();
  }
  void read_tets() {
    const std::size_t n = builder_.count("number of tetrahedra", physics::most_mesh_tets, 8);
    for (std::size_t i = 0; i < n; ++i) {
      std::array<long long, 4> corners{};
      for (long long& corner : corners)
        corner = builder_.integer("number of a vertex", 1, TetBuilder::most_number);
      builder_.add_tet(corners, static_cast<int>(builder_.integer("reference", -TetBuilder::most_number,
                                                                  TetBuilder::most_number)));
    }
  }
  /// What has no volume is left out; what has one is refused.
  void skip(const std::string& keyword) {
    const std::size_t n = builder_.count("number of " + keyword, 4 * physics::most_mesh_tets, 1);
    if (n > 0 &&
        (keyword == "Hexahedra" || keyword == "Prisms" || keyword == "Pyramids" || keyword == "TetrahedraP2"))
      builder_.refuse(keyword);
    for (std::size_t i = 0; i < n; ++i) {
      words_.next_line();
      words_.end_line();
      if (keyword == "Triangles" || keyword == "Edges" || keyword == "Quadrilaterals") builder_.add_other();
    }
  }

  physics::MeshWords words_;
  TetBuilder builder_;
};

}  // namespace

physics::MshContent parse_medit(std::string_view text, const std::string& name, double metres) {
  return MeditReader(text, name, metres).read();
}

}  // namespace palpate
