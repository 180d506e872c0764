// Gmsh's format MSH 4.1 in ASCII.
#include <map>

#include "deploy/import/read_mesh_format.h"
#include "deploy/import/tet_builder.h"

namespace palpate {
namespace {

using physics::MeshWords;

constexpr long long most_blocks = 10'000'000;
constexpr long long tet4 = 4;

class Msh4Reader {
 public:
  Msh4Reader(std::string_view text, const std::string& name, double metres)
      : words_(text, name), builder_(words_, metres) {}

  physics::MshContent read() {
    words_.expect("$MeshFormat");
    words_.expect("4.1");
    if (builder_.integer("kind of file", 0, 1) != 0)
      words_.complain("a binary file; save it in ASCII (Gmsh: Mesh.Binary = 0)");
    words_.end_line();
    words_.expect("$EndMeshFormat");
    bool has_nodes = false, has_elements = false;
    for (auto section = words_.next(); !section.empty(); section = words_.next()) {
      if (section == "$Entities") {
        read_entities();
      } else if (section == "$Nodes" && !has_nodes) {
        has_nodes = true;
        read_nodes();
      } else if (section == "$Elements" && has_nodes && !has_elements) {
        has_elements = true;
        read_elements();
      } else if (section == "$PartitionedEntities") {
        words_.complain("a mesh in partitions, whose groups are not read; save it without them");
      } else {
        if (section.front() != '$')
          words_.complain(MeshWords::quoted(section) +
                          " stands between sections; a section begins with \"$\"");
        words_.skip_section(section);
      }
    }
    return builder_.done();
  }

 private:
  long long tag() { return builder_.integer("tag", -TetBuilder::most_number, TetBuilder::most_number); }
  void skip_numbers(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      words_.next_line();
      words_.number("number", 1e30);
    }
  }

  /// Of volumes their first physical group, which tells regions apart.
  void read_entities() {
    std::array<std::size_t, 4> n{};
    for (std::size_t& count : n)
      count = builder_.count("number of entities", static_cast<std::size_t>(most_blocks));
    for (std::size_t dimension = 0; dimension < 4; ++dimension)
      for (std::size_t i = 0; i < n[dimension]; ++i) {
        const long long entity = tag();
        skip_numbers(dimension == 0 ? 3 : 6);
        const std::size_t groups = builder_.count("number of groups", 1000);
        for (std::size_t g = 0; g < groups; ++g) {
          const long long group = tag();
          if (dimension == 3 && g == 0) group_of_[entity] = static_cast<int>(group);
        }
        if (dimension == 0) continue;
        const std::size_t bounds = builder_.count("number of bounds", static_cast<std::size_t>(most_blocks));
        for (std::size_t b = 0; b < bounds; ++b) tag();
      }
    words_.expect("$EndEntities");
  }

  void read_nodes() {
    const std::size_t blocks = builder_.count("number of blocks", static_cast<std::size_t>(most_blocks));
    builder_.count("number of nodes", physics::most_mesh_nodes, 6);
    tag(), tag();
    std::vector<long long> numbers;
    for (std::size_t block = 0; block < blocks; ++block) {
      builder_.integer("dimension", 0, 3);
      tag();
      builder_.integer("word for parameters", 0, 1);
      const std::size_t n = builder_.count("number of nodes", physics::most_mesh_nodes, 6);
      numbers.resize(n);
      for (long long& number : numbers)
        number = builder_.integer("number of a node", 1, TetBuilder::most_number);
      for (const long long number : numbers) {
        builder_.read_node(number);
        words_.end_line();  // its parameters
      }
    }
    builder_.end_nodes();
    words_.expect("$EndNodes");
  }

  void read_elements() {
    const std::size_t blocks = builder_.count("number of blocks", static_cast<std::size_t>(most_blocks));
    builder_.count("number of elements", 4 * physics::most_mesh_tets);
    tag(), tag();
    for (std::size_t block = 0; block < blocks; ++block) {
      const long long dimension = builder_.integer("dimension", 0, 3);
      const auto group = group_of_.find(tag());
      const long long kind = builder_.integer("kind of element", 1, 1000);
      const std::size_t n = builder_.count("number of elements", 4 * physics::most_mesh_tets);
      if (n > 0 && dimension == 3 && kind != tet4)
        builder_.refuse("elements of kind " + std::to_string(kind));
      for (std::size_t i = 0; i < n; ++i) {
        builder_.integer("number of an element", 1, TetBuilder::most_number);
        if (dimension < 3) {
          builder_.add_other();
          words_.end_line();
          continue;
        }
        std::array<long long, 4> corners{};
        for (long long& corner : corners)
          corner = builder_.integer("number of a node", 1, TetBuilder::most_number);
        builder_.add_tet(corners, group != group_of_.end() ? group->second : 0);
      }
    }
    words_.expect("$EndElements");
  }

  MeshWords words_;
  TetBuilder builder_;
  std::map<long long, int> group_of_;  // of a volume
};

}  // namespace

physics::MshContent parse_msh4(std::string_view text, const std::string& name, double metres) {
  return Msh4Reader(text, name, metres).read();
}

}  // namespace palpate
