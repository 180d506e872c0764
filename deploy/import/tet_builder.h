#pragma once
// Nodes and tetrahedra as a file of another program gives them: checked one by one, with the place in the file.

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "physics_node/mesh/mesh_words.h"
#include "physics_node/mesh/read_msh.h"
#include "physics_node/mesh/tet_mesh.h"

namespace palpate {

class TetBuilder {
 public:
  static constexpr long long most_number = 2'147'483'647;

  /// @param metres  that one unit of the file has
  TetBuilder(physics::MeshWords& words, double metres) : words_(words), metres_(metres) {}

  /// A whole number, on this line or a later one.
  long long integer(const std::string& what, long long least, long long most) {
    words_.next_line();
    return words_.integer(what, least, most);
  }
  /// How many follow, which take at least so many bytes each: memory for them is never more than the file could fill.
  std::size_t count(const std::string& what, std::size_t most, std::size_t least_bytes = 2) {
    const auto n = static_cast<std::size_t>(integer(what, 0, static_cast<long long>(most)));
    if (n > words_.bytes_left() / least_bytes + 1)
      words_.complain(std::to_string(n) + " as " + what + ", more than the rest of the file can hold");
    return n;
  }
  /// @param number  that the file names it by
  void read_node(long long number) {
    Vec3 x;
    for (double& entry : x) {
      words_.next_line();
      entry = metres_ * words_.number("coordinate", physics::farthest_mesh_node / metres_);
    }
    number_.emplace_back(number, static_cast<physics::Index>(content_.mesh.nodes.size()));
    content_.mesh.nodes.push_back(x);
  }
  /// All nodes have been read. Numbers may come in any order.
  void end_nodes() {
    std::ranges::sort(number_);
    const auto twice = std::ranges::adjacent_find(number_, {}, &Numbered::first);
    if (twice != number_.end())
      words_.complain("node " + std::to_string(twice->first) +
                      " is there twice; each has a number of its own");
  }
  void add_tet(const std::array<long long, 4>& numbers, int region) {
    std::array<physics::Index, 4> corners{};
    for (std::size_t a = 0; a < 4; ++a) corners[a] = node(numbers[a]);
    if (is_flat(content_.mesh, corners))
      words_.complain("a flat tetrahedron; its four corners may not lie in one plane");
    content_.mesh.tets.push_back(corners);
    content_.mesh.region.push_back(region);
  }
  void add_other() noexcept { ++content_.other; }  // what has no volume
  [[noreturn]] void refuse(const std::string& volume) const {
    words_.complain(volume + "; only tetrahedra with 4 nodes can be read");
  }
  physics::MshContent done() {
    if (content_.mesh.tets.empty())
      words_.complain("no tetrahedron in this file; it should be a mesh of volumes");
    content_.tidied = physics::tidy(content_.mesh);
    return std::move(content_);
  }

 private:
  using Numbered = std::pair<long long, physics::Index>;

  physics::Index node(long long number) const {
    const auto found = std::ranges::lower_bound(number_, number, {}, &Numbered::first);
    if (found == number_.end() || found->first != number)
      words_.complain("node " + std::to_string(number) + " is not there");
    return found->second;
  }

  physics::MeshWords& words_;
  double metres_;
  physics::MshContent content_;
  std::vector<Numbered> number_;  // in the file, and here
};

}  // namespace palpate
