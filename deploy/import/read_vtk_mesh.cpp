// Legacy VTK in ASCII: an unstructured grid of versions 1 to 5.
#include <vector>

#include "deploy/import/read_mesh_format.h"
#include "deploy/import/tet_builder.h"

namespace palpate {
namespace {

using physics::MeshWords;

constexpr long long tet4 = 10;
bool has_no_volume(long long kind) {
  return (kind >= 0 && kind <= 9) || (kind >= 21 && kind <= 23) || kind == 28;
}

class VtkReader {
 public:
  VtkReader(std::string_view text, const std::string& name, double metres)
      : words_(text, name), builder_(words_, metres) {}

  physics::MshContent read() {
    for (const char* word : {"#", "vtk", "DataFile", "Version"}) words_.expect(word);
    words_.skip_next_line();  // a title, which may be anything
    if (words_.next() != "ASCII") words_.complain("a binary file; save it as legacy VTK in ASCII");
    words_.expect("DATASET");
    words_.expect("UNSTRUCTURED_GRID");
    bool has_points = false, has_cells = false, has_kinds = false;
    for (auto word = words_.next(); !word.empty() && !has_kinds; word = words_.next()) {
      if (word == "POINTS" && !has_points) {
        has_points = true;
        read_points();
      } else if (word == "CELLS" && has_points && !has_cells) {
        has_cells = true;
        read_cells();
      } else if (word == "CELL_TYPES" && has_cells) {
        has_kinds = true;
        read_kinds();
      } else {
        words_.end_line();  // METADATA and the like
      }
    }
    return builder_.done();
  }

 private:
  void read_points() {
    const std::size_t n = builder_.count("number of points", physics::most_mesh_nodes, 6);
    words_.end_line();
    for (std::size_t i = 0; i < n; ++i) builder_.read_node(static_cast<long long>(i));
    builder_.end_nodes();
  }

  /// Up to version 4 each cell is its number of nodes and these; from 5 on where each begins, and the nodes of all.
  void read_cells() {
    const std::size_t n = builder_.count("number of cells", 4 * physics::most_mesh_tets);
    const std::size_t size = builder_.count("size of the cells", 64 * physics::most_mesh_tets, 1);
    words_.end_line();
    const auto node = [&] { return builder_.integer("number of a node", 0, TetBuilder::most_number); };
    words_.next_line();
    if (words_.peek() == "OFFSETS") {
      words_.end_line();
      std::vector<long long> offsets(n);
      for (long long& offset : offsets) offset = builder_.integer("offset", 0, static_cast<long long>(size));
      words_.expect("CONNECTIVITY");
      words_.end_line();
      std::vector<long long> nodes(size);
      for (long long& one : nodes) one = node();
      for (std::size_t c = 0; c + 1 < n; ++c) {
        if (offsets[c + 1] < offsets[c])
          words_.complain("offsets of cells that fall; each begins after the one before");
        cells_.emplace_back(nodes.begin() + offsets[c], nodes.begin() + offsets[c + 1]);
      }
      return;
    }
    for (std::size_t c = 0; c < n; ++c) {
      const auto m = static_cast<std::size_t>(builder_.integer("number of nodes", 0, 1000));
      std::vector<long long>& cell = cells_.emplace_back(m);
      for (long long& one : cell) one = node();
    }
  }

  void read_kinds() {
    const std::size_t n = builder_.count("number of cells", 4 * physics::most_mesh_tets);
    if (n != cells_.size())
      words_.complain(std::to_string(n) + " kinds of " + std::to_string(cells_.size()) + " cells");
    words_.end_line();
    for (const auto& cell : cells_) {
      const long long kind = builder_.integer("kind of cell", 0, 1000);
      if (has_no_volume(kind))
        builder_.add_other();
      else if (kind != tet4 || cell.size() != 4)
        builder_.refuse("a cell of kind " + std::to_string(kind) + " with " + std::to_string(cell.size()) +
                        " nodes");
      else
        builder_.add_tet({cell[0], cell[1], cell[2], cell[3]}, 0);
    }
  }

  MeshWords words_;
  TetBuilder builder_;
  std::vector<std::vector<long long>> cells_;
};

}  // namespace

physics::MshContent parse_vtk_mesh(std::string_view text, const std::string& name, double metres) {
  return VtkReader(text, name, metres).read();
}

}  // namespace palpate
