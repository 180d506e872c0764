#include "physics_node/mesh/simplex_net.h"

#include <algorithm>
#include <array>

namespace palpate::physics {

/// Who is beyond whom: those whose faces have the same corners.
template <std::size_t N>
void SimplexNet<N>::join_faces() {
  struct FaceOf {
    Face sorted;
    Index entry;  // N element + face
  };
  std::vector<FaceOf> faces;
  faces.reserve(N * loaded_.size());
  for (Index e = 0; e < n_elements(); ++e)
    for (std::size_t f = 0; f < N; ++f) {
      Face sorted = face(e, f);
      std::ranges::sort(sorted);
      faces.push_back({sorted, static_cast<Index>(N * at(e) + f)});
    }
  std::ranges::stable_sort(faces, {}, &FaceOf::sorted);
  for (std::size_t n = 0; n + 1 < faces.size(); ++n) {
    if (faces[n].sorted != faces[n + 1].sorted) continue;
    other_[at(faces[n].entry)] = faces[n + 1].entry;
    other_[at(faces[n + 1].entry)] = faces[n].entry;
  }
}

template <std::size_t N>
SimplexNet<N>::SimplexNet(const std::vector<Corners>& elements, std::size_t n_nodes, std::size_t most_copies)
    : NodeCopies(n_nodes, most_copies),
      loaded_(elements),
      corners_(elements),
      other_(N * elements.size(), none),
      open_(N * elements.size(), 0),
      star_begin_(n_nodes + 1, 0),
      star_(N * elements.size()),
      seen_(elements.size(), 0) {
  open_faces_.reserve(most_open());
  join_faces();
  for (const Corners& of : loaded_)
    for (const Index node : of) ++star_begin_[at(node) + 1];
  for (std::size_t n = 0; n < n_nodes; ++n) star_begin_[n + 1] += star_begin_[n];
  std::vector<std::size_t> next(star_begin_.begin(), star_begin_.end() - 1);
  for (std::size_t e = 0; e < loaded_.size(); ++e)
    for (std::size_t c = 0; c < N; ++c)
      star_[next[at(loaded_[e][c])]++] = static_cast<std::uint32_t>(N * e + c);
  std::size_t most = 0;
  for (std::size_t n = 0; n < n_nodes; ++n) most = std::max(most, star_begin_[n + 1] - star_begin_[n]);
  reached_.reserve(most);
}

template <std::size_t N>
bool SimplexNet<N>::is_exposed(Index element, std::size_t face) const noexcept {
  const Index other = other_[N * at(element) + face];
  if (other == none) return true;
  if (!is_open(element, face)) return false;
  const Face mine = this->face(element, face),
             theirs = this->face(other / static_cast<Index>(N), at(other) % N);
  return !std::ranges::all_of(mine,
                              [&](Index node) { return std::ranges::find(theirs, node) != theirs.end(); });
}

template <std::size_t N>
bool SimplexNet<N>::is_exposed(Index node) const noexcept {
  bool is = false;
  each_corner(node, [&](Index element, std::size_t corner) {
    for (std::size_t f = 0; f < N && !is; ++f)
      is = Simplex<N>::opposite[f] != corner && is_exposed(element, f);
  });
  return is;
}

template <std::size_t N>
std::size_t SimplexNet<N>::face_between(Index a, Index b) const noexcept {
  std::size_t f = 0;
  while (f < N && beyond(a, f) != b) ++f;
  return f;
}

template <std::size_t N>
bool SimplexNet<N>::open(Index a, Index b) noexcept {
  const std::size_t f = face_between(a, b);
  if (f == N || is_open(a, f) || !open_one(N - 1)) return false;
  open_[N * at(a) + f] = open_[at(other_[N * at(a) + f])] = 1;
  open_faces_.push_back({a, b});
  for (const std::size_t c : Simplex<N>::faces[f]) {
    const Index node = corners_[at(a)][c];
    if (std::ranges::find(corners_[at(b)], node) != corners_[at(b)].end()) part(node, a);
  }
  return true;
}

/// Marks the fan of an element round one of its nodes.
template <std::size_t N>
void SimplexNet<N>::flood(Index node, Index from) noexcept {
  ++flood_;
  reached_.clear();
  const auto reach = [this](Index element) {
    if (seen_[at(element)] == flood_) return;
    seen_[at(element)] = flood_;
    reached_.push_back(element);
  };
  reach(from);
  for (std::size_t n = 0; n < reached_.size(); ++n) {
    const Index element = reached_[n];
    for (std::size_t f = 0; f < N; ++f)
      if (corners_[at(element)][Simplex<N>::opposite[f]] != node && !is_open(element, f) &&
          beyond(element, f) != none)
        reach(beyond(element, f));
  }
}

/// A node one of whose faces has opened, at `from`: does what is left of its elements still hang together?
template <std::size_t N>
void SimplexNet<N>::part(Index node, Index from) noexcept {
  flood(node, from);
  std::size_t all = 0;
  bool has_first = false;  // the fan reached has the first of them all
  each_corner(node, [&](Index element, std::size_t) {
    if (all++ == 0) has_first = seen_[at(element)] == flood_;
  });
  const std::size_t reached = reached_.size(), rest = all - reached;
  if (rest == 0) return;
  const bool gives = reached < rest || (reached == rest && !has_first);  // the fan reached takes the copy
  const Index copy = this->copy(node);
  for (const std::uint32_t entry : star_of(origin(copy))) {
    Index& corner = corners_[entry / N][entry % N];
    if (corner == node && (seen_[entry / N] == flood_) == gives) corner = copy;
  }
}

template <std::size_t N>
void SimplexNet<N>::reset() noexcept {
  std::ranges::copy(loaded_, corners_.begin());
  std::ranges::fill(open_, std::uint8_t{0});
  open_faces_.clear();
  forget_copies();
}

template class SimplexNet<3>;
template class SimplexNet<4>;

}  // namespace palpate::physics
