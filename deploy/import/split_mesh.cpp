#include "deploy/import/split_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "deploy/import/tet_cut.h"
#include "physics_node/mesh/mesh_parts.h"
#include "physics_node/mesh/mesh_quality.h"

namespace palpate {
namespace {

using physics::Index;

constexpr double near_share = 0.33;  // of an edge: nearer crossings move its end, or take it as it is
constexpr int edge_halvings = 30;    // to a crossing
// Of tetrahedra round a node that has moved: stuffing itself makes some as bad.
constexpr double least_angle = 13 * std::numbers::pi / 180, largest_angle = 150 * std::numbers::pi / 180;

class Splitting {
 public:
  using Point = Index;

  Splitting(physics::TetMesh& mesh, const std::function<double(const Vec3&)>& field)
      : before_(mesh), field_(field) {
    for (const Vec3& x : before_.nodes) sign_.push_back(field_(x) >= 0 ? std::int8_t{1} : std::int8_t{-1});
    for (const auto& triangle : outer_faces(before_).triangles)
      for (std::size_t n = 0; n < 3; ++n) {
        outer_edges_.insert(std::minmax(triangle[n], triangle[(n + 1) % 3]));
        outer_.insert(triangle[n]);
      }
    std::vector<std::pair<Index, Index>> pairs;
    for (std::size_t t = 0; t < before_.tets.size(); ++t)
      for (const Index node : before_.tets[t]) pairs.emplace_back(node, static_cast<Index>(t));
    std::ranges::sort(pairs);
    tets_at_ = physics::NodeLists(before_.nodes.size(), pairs);
    one_.nodes.resize(4);
    one_.tets = {{0, 1, 2, 3}};
  }

  SplitMesh split() {
    const physics::NodeLists neighbours = neighbours_of(before_);
    for (Index node = 0; node < static_cast<Index>(before_.nodes.size()); ++node) snap(node, neighbours);
    made_.nodes = before_.nodes;
    SplitMesh split;
    TetCut<Splitting> cut(*this, false);
    for (std::size_t t = 0; t < before_.tets.size(); ++t) {
      const auto& corners = before_.tets[t];
      const bool crossed = has(corners, 1) && has(corners, -1);
      const bool above =
          crossed || (has(corners, -1) ? false : has(corners, 1) || field_(middle_of(corners)) >= 0);
      if (!crossed) {
        made_.tets.push_back(corners);
      } else {
        cut.cut(corners);
        note(split, t, true);
        side_ = -1;
        cut.cut(corners);
        side_ = 1;
      }
      note(split, t, above && !crossed);
    }
    for (std::size_t t = 0; t < made_.tets.size(); ++t)
      made_.region.push_back(before_.region[split.parent[t]]);
    physics::tidy(made_);
    before_ = std::move(made_);
    return split;
  }

  // What TetCut asks for.
  int sign(Index node) const { return side_ * sign_[static_cast<std::size_t>(node)]; }
  Index node(Index node) const { return node; }
  Index node(Index a, Index b) {
    const auto [at, fresh] = node_on_.try_emplace(std::minmax(a, b), static_cast<Index>(made_.nodes.size()));
    if (fresh) made_.nodes.push_back(crossing(a, b));
    return at->second;
  }
  physics::TetMesh& mesh() noexcept { return made_; }

 private:
  const Vec3& place(Index node) const { return before_.nodes[static_cast<std::size_t>(node)]; }
  bool has(const std::array<Index, 4>& corners, int s) const {
    return std::ranges::any_of(corners, [&](Index n) { return sign_[static_cast<std::size_t>(n)] == s; });
  }
  Vec3 middle_of(const std::array<Index, 4>& corners) const {
    return 0.25 * (place(corners[0]) + place(corners[1]) + place(corners[2]) + place(corners[3]));
  }
  void note(SplitMesh& split, std::size_t parent, bool above) const {
    split.above.resize(made_.tets.size(), above);
    split.parent.resize(made_.tets.size(), parent);
  }

  /// Where the field crosses the edge between a node above and one below, from the same end whoever asks.
  Vec3 crossing(Index a, Index b) const {
    if (sign_[static_cast<std::size_t>(a)] < sign_[static_cast<std::size_t>(b)]) std::swap(a, b);
    Vec3 in = place(a), out = place(b);
    for (int n = 0; n < edge_halvings; ++n) {
      const Vec3 middle = 0.5 * (in + out);
      (field_(middle) >= 0 ? in : out) = middle;
    }
    return 0.5 * (in + out);
  }

  void snap(Index node, const physics::NodeLists& neighbours) {
    std::optional<Vec3> nearest;
    bool near = false;
    double least = 0;
    const int own = sign_[static_cast<std::size_t>(node)];
    for (const Index other : neighbours.of(node)) {
      if (own * sign_[static_cast<std::size_t>(other)] >= 0) continue;
      const Vec3 at = crossing(node, other);
      const double far = (at - place(node)).norm();
      if (far >= near_share * (place(other) - place(node)).norm()) continue;
      near = true;
      const bool free = outer_.count(node) == 0 || outer_edges_.count(std::minmax(node, other)) > 0;
      if (free && (!nearest || far < least)) nearest = at, least = far;
    }
    if (!near) return;
    sign_[static_cast<std::size_t>(node)] = 0;
    if (!nearest) return;
    Vec3& x = before_.nodes[static_cast<std::size_t>(node)];
    const Vec3 kept = std::exchange(x, *nearest);
    if (!is_good_round(node)) x = kept;
  }
  bool is_good_round(Index node) {
    return std::ranges::all_of(tets_at_.of(node), [&](Index t) {
      const auto& corners = before_.tets[static_cast<std::size_t>(t)];
      for (std::size_t n = 0; n < 4; ++n) one_.nodes[n] = place(corners[n]);
      const physics::DihedralAngles angles = dihedral_angles(one_);
      return signed_volume(before_, corners) > 0 && angles.least > least_angle &&
             angles.largest < largest_angle;
    });
  }

  physics::TetMesh& before_;
  const std::function<double(const Vec3&)>& field_;
  std::vector<std::int8_t> sign_;  // of each node: 1 above, -1 below, 0 on the surface
  int side_ = 1;                   // that is cut out now
  std::set<std::pair<Index, Index>> outer_edges_;
  std::set<Index> outer_;
  physics::NodeLists tets_at_;
  std::map<std::pair<Index, Index>, Index> node_on_;  // of an edge
  physics::TetMesh made_, one_;                       // one_: a tetrahedron that is looked at
};

}  // namespace

SplitMesh split_mesh(physics::TetMesh& mesh, const std::function<double(const Vec3&)>& field) {
  return Splitting(mesh, field).split();
}

}  // namespace palpate
