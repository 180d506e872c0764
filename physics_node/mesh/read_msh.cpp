#include "physics_node/mesh/read_msh.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <utility>

#include "physics_node/mesh/mesh_words.h"

namespace palpate::physics {
namespace {

constexpr long long most_number = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t least_line = 8;  // bytes that a node or an element takes: "1 0 0 0\n"

/// Gmsh's numbers of kinds of elements: what has no volume is not kept.
constexpr long long tet4 = 4;
bool has_no_volume(long long kind) {
  return kind == 1 || kind == 2 || kind == 3 || (kind >= 8 && kind <= 10) || kind == 15 || kind == 16 ||
         (kind >= 20 && kind <= 28);
}
std::string name_of_volume(long long kind) {
  if (kind == 5) return "a hexahedron";
  if (kind == 6) return "a prism";
  if (kind == 7) return "a pyramid";
  if (kind == 11) return "a tetrahedron with 10 nodes";
  return "an element of kind " + std::to_string(kind);
}

class MshReader {
 public:
  MshReader(std::string_view text, const std::string& name, double metres)
      : words_(text, name), metres_(metres) {}

  MshContent read() {
    read_format();
    bool has_nodes = false, has_elements = false;
    for (auto section = words_.next(); !section.empty(); section = words_.next()) {
      if (section.front() != '$')
        words_.complain(MeshWords::quoted(section) + " stands between sections; a section begins with \"$\"");
      if (section == "$Nodes") {
        if (std::exchange(has_nodes, true)) words_.complain("a second $Nodes; a file has one");
        read_nodes();
      } else if (section == "$Elements") {
        if (!has_nodes) words_.complain("$Elements before $Nodes; nodes come first");
        if (std::exchange(has_elements, true)) words_.complain("a second $Elements; a file has one");
        read_elements();
      } else {
        words_.skip_section(section);
      }
    }
    if (content_.mesh.tets.empty())
      words_.complain("no tetrahedron in this file; a volume mesh has elements of kind 4 in $Elements");
    content_.tidied = tidy(content_.mesh);
    return std::move(content_);
  }

 private:
  void read_format() {
    words_.expect("$MeshFormat");
    const std::string_view version = words_.next();
    if (version != "2.2" && version != "2.1" && version != "2")
      words_.complain(MeshWords::quoted(version) +
                      " is another version; save it as MSH 2.2 in ASCII "
                      "(Gmsh: Mesh.MshFileVersion = 2.2), or make an .h5 of it with palpate import");
    if (words_.integer("kind of file", 0, 1) != 0)
      words_.complain("a binary file; save it in ASCII (Gmsh: Mesh.Binary = 0)");
    words_.end_line();
    words_.expect("$EndMeshFormat");
  }

  /// How many lines follow. Memory for them is never more than the file could fill.
  std::size_t read_count(const std::string& what, std::size_t most) {
    words_.next_line();
    const auto n = static_cast<std::size_t>(words_.integer(what, 0, static_cast<long long>(most)));
    if (n > words_.bytes_left() / least_line + 1)
      words_.complain(std::to_string(n) + " as " + what + ", more than the rest of the file can hold");
    words_.end_line();
    return n;
  }

  void read_nodes() {
    const std::size_t n = read_count("number of nodes", most_mesh_nodes);
    content_.mesh.nodes.reserve(n);
    number_.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      words_.next_line();
      const auto number = words_.integer("number of a node", 1, most_number);
      Vec3 x;
      for (double& entry : x) entry = metres_ * words_.number("coordinate", farthest_mesh_node / metres_);
      number_.emplace_back(number, static_cast<Index>(i));
      content_.mesh.nodes.push_back(x);
      words_.end_line();
    }
    words_.expect("$EndNodes");
    std::ranges::sort(number_);
    const auto twice = std::ranges::adjacent_find(number_, {}, &std::pair<long long, Index>::first);
    if (twice != number_.end())
      words_.complain("node " + std::to_string(twice->first) +
                      " is there twice; each has a number of its own");
  }

  void read_elements() {
    const std::size_t n = read_count("number of elements", most_mesh_tets);
    for (std::size_t i = 0; i < n; ++i) {
      words_.next_line();
      words_.integer("number of an element", 1, most_number);
      const auto kind = words_.integer("kind of element", 1, 1000);
      if (kind == tet4)
        read_tet();
      else if (has_no_volume(kind))
        ++content_.other;
      else
        words_.complain(name_of_volume(kind) +
                        "; only tetrahedra with 4 nodes can be read (Gmsh: "
                        "Mesh.ElementOrder = 1, no recombination)");
      words_.end_line();
    }
    words_.expect("$EndElements");
  }

  void read_tet() {
    const auto n_tags = words_.integer("number of tags", 0, 100);
    int region = 0;
    for (long long t = 0; t < n_tags; ++t) {
      const auto tag = words_.integer("tag", -most_number, most_number);
      if (t == 0) region = static_cast<int>(tag);
    }
    std::array<Index, 4> corners;
    for (Index& corner : corners) corner = node(words_.integer("number of a node", 1, most_number));
    if (is_flat(content_.mesh, corners))
      words_.complain("a flat tetrahedron; its four corners may not lie in one plane");
    content_.mesh.tets.push_back(corners);
    content_.mesh.region.push_back(region);
  }

  Index node(long long number) const {
    const auto found = std::ranges::lower_bound(number_, number, {}, &std::pair<long long, Index>::first);
    if (found == number_.end() || found->first != number)
      words_.complain("node " + std::to_string(number) + " is not in $Nodes");
    return found->second;
  }

  MeshWords words_;
  double metres_;
  MshContent content_;
  std::vector<std::pair<long long, Index>> number_;  // of each node in the file, and here
};

}  // namespace

MshContent parse_msh(std::string_view text, const std::string& name, double metres) {
  if (!std::isfinite(metres) || metres <= 0)
    throw InputError(one_line(name) + ":1:1: a unit of " + std::to_string(metres) + " m; it must be above 0");
  return MshReader(text, name, metres).read();
}

MshContent read_msh(const std::string& path, double metres) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf()) || in.bad())
    throw InputError(one_line(path) + ":1:1: cannot be read; give a mesh in Gmsh's format MSH 2.2");
  return parse_msh(std::move(text).str(), path, metres);
}

}  // namespace palpate::physics
