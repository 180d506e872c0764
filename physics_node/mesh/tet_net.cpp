#include "physics_node/mesh/tet_net.h"

#include <algorithm>
#include <array>

namespace palpate::physics {
namespace {

/// Which corner a face does not have.
constexpr std::array<std::size_t, 4> opposite = {3, 2, 0, 1};

struct FaceOf {
  MeshTriangle sorted;
  Index entry;  // 4 tet + face
};

std::vector<FaceOf> faces_of(const TetMesh& mesh) {
  std::vector<FaceOf> faces;
  faces.reserve(4 * mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (std::size_t f = 0; f < tet_faces.size(); ++f) {
      MeshTriangle sorted{mesh.tets[t][tet_faces[f][0]], mesh.tets[t][tet_faces[f][1]],
                          mesh.tets[t][tet_faces[f][2]]};
      std::ranges::sort(sorted);
      faces.push_back({sorted, static_cast<Index>(4 * t + f)});
    }
  std::ranges::stable_sort(faces, {}, &FaceOf::sorted);
  return faces;
}

}  // namespace

TetNet::TetNet(const TetMesh& mesh, std::size_t most_copies)
    : n_loaded_(static_cast<Index>(mesh.nodes.size())),
      most_copies_(most_copies),
      loaded_(mesh.tets),
      corners_(mesh.tets),
      other_(4 * mesh.tets.size(), none),
      open_(4 * mesh.tets.size(), 0),
      star_begin_(mesh.nodes.size() + 1, 0),
      star_(4 * mesh.tets.size()),
      has_split_(mesh.nodes.size(), 0),
      seen_(mesh.tets.size(), 0) {
  const std::vector<FaceOf> faces = faces_of(mesh);
  for (std::size_t n = 0; n + 1 < faces.size(); ++n) {
    if (faces[n].sorted != faces[n + 1].sorted) continue;
    other_[at(faces[n].entry)] = faces[n + 1].entry;
    other_[at(faces[n + 1].entry)] = faces[n].entry;
  }
  for (const Corners& of : loaded_)
    for (const Index node : of) ++star_begin_[at(node) + 1];
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) star_begin_[n + 1] += star_begin_[n];
  std::vector<std::size_t> next(star_begin_.begin(), star_begin_.end() - 1);
  for (std::size_t t = 0; t < loaded_.size(); ++t)
    for (std::size_t c = 0; c < 4; ++c)
      star_[next[at(loaded_[t][c])]++] = static_cast<std::uint32_t>(4 * t + c);
  origin_.reserve(most_copies);
  splits_.reserve(most_copies);
  std::size_t most = 0;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    most = std::max(most, star_begin_[n + 1] - star_begin_[n]);
  reached_.reserve(most);
}

bool TetNet::is_exposed(Index tet, std::size_t face) const noexcept {
  const Index other = other_[4 * at(tet) + face];
  if (other == none) return true;
  if (!is_open(tet, face)) return false;
  const MeshTriangle mine = this->face(tet, face), theirs = this->face(other / 4, at(other % 4));
  return !std::ranges::all_of(mine,
                              [&](Index node) { return std::ranges::find(theirs, node) != theirs.end(); });
}

bool TetNet::is_exposed(Index node) const noexcept {
  bool is = false;
  each_corner(node, [&](Index tet, std::size_t corner) {
    for (std::size_t f = 0; f < 4 && !is; ++f) is = opposite[f] != corner && is_exposed(tet, f);
  });
  return is;
}

std::size_t TetNet::face_between(Index a, Index b) const noexcept {
  std::size_t f = 0;
  while (f < 4 && beyond(a, f) != b) ++f;
  return f;
}

bool TetNet::open(Index a, Index b) noexcept {
  const std::size_t f = face_between(a, b);
  if (f == 4 || is_open(a, f)) return false;
  if (most_copies_ - origin_.size() < 3) {
    ++left_out_;
    return false;
  }
  open_[4 * at(a) + f] = open_[at(other_[4 * at(a) + f])] = 1;
  ++n_open_;
  for (const std::size_t c : tet_faces[f]) {
    const Index node = corners_[at(a)][c];
    if (std::ranges::find(corners_[at(b)], node) != corners_[at(b)].end()) part(node, a);
  }
  return true;
}

/// Marks the fan of a tetrahedron round one of its nodes.
void TetNet::flood(Index node, Index from) noexcept {
  ++flood_;
  reached_.clear();
  const auto reach = [this](Index tet) {
    if (seen_[at(tet)] == flood_) return;
    seen_[at(tet)] = flood_;
    reached_.push_back(tet);
  };
  reach(from);
  for (std::size_t n = 0; n < reached_.size(); ++n) {
    const Index tet = reached_[n];
    for (std::size_t f = 0; f < 4; ++f)
      if (corners_[at(tet)][opposite[f]] != node && !is_open(tet, f) && beyond(tet, f) != none)
        reach(beyond(tet, f));
  }
}

/// A node one of whose faces has opened, at `from`: does what is left of its tetrahedra still hang together?
void TetNet::part(Index node, Index from) noexcept {
  flood(node, from);
  std::size_t all = 0;
  bool has_first = false;  // the fan reached has the first of them all
  each_corner(node, [&](Index tet, std::size_t) {
    if (all++ == 0) has_first = seen_[at(tet)] == flood_;
  });
  const std::size_t reached = reached_.size(), rest = all - reached;
  if (rest == 0) return;
  const bool gives = reached < rest || (reached == rest && !has_first);  // the fan reached takes the copy
  const Index origin = this->origin(node), copy = n_nodes();
  origin_.push_back(origin);
  has_split_[at(origin)] = 1;
  splits_.push_back({node, copy});
  for (const std::uint32_t entry : star_of(origin)) {
    Index& corner = corners_[entry / 4][entry % 4];
    if (corner == node && (seen_[entry / 4] == flood_) == gives) corner = copy;
  }
}

void TetNet::reset() noexcept {
  std::ranges::copy(loaded_, corners_.begin());
  std::ranges::fill(open_, std::uint8_t{0});
  std::ranges::fill(has_split_, std::uint8_t{0});
  origin_.clear();
  splits_.clear();
  n_open_ = 0;
}

}  // namespace palpate::physics
