#include "render_node/model/body_picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpate::render {
namespace {

std::size_t end_of(const VertexBlock& block) { return std::size_t{block.first_vertex} + block.n_vertices; }

bool well_formed(const VertexBlock& block) {
  if (block.n_vertices > max_block_vertices) return false;
  const auto finite = [](const Array3f& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  };
  return std::all_of(block.position.begin(), block.position.begin() + block.n_vertices, finite);
}

// Each vertex takes the mean colour of its facets, channel by channel.
std::vector<std::uint32_t> mean_colours(const Surface& surface) {
  struct Sum {
    std::array<std::uint32_t, 4> channel{};
    std::uint32_t n = 0;
  };
  std::vector<Sum> sums(surface.position.size());
  for (std::size_t f = 0; f < surface.corners.size(); ++f) {
    for (const auto v : surface.corners[f]) {
      for (std::uint32_t c = 0; c < 4; ++c) sums[v].channel[c] += (surface.rgba[f] >> (8 * c)) & 0xffu;
      ++sums[v].n;
    }
  }
  std::vector<std::uint32_t> rgba(sums.size(), 0);
  for (std::size_t v = 0; v < sums.size(); ++v) {
    if (sums[v].n == 0) continue;
    for (std::uint32_t c = 0; c < 4; ++c)
      rgba[v] |= ((sums[v].channel[c] + sums[v].n / 2) / sums[v].n) << (8 * c);
  }
  return rgba;
}

float mean_edge_length(const Surface& surface) {
  double sum = 0;
  std::size_t n = 0;
  for (const auto& c : surface.corners) {
    if (is_loose(c)) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector3f a(surface.position[c[i]].data()), b(surface.position[c[(i + 1) % 4]].data());
      sum += static_cast<double>((a - b).norm());
      n += c[i] == c[(i + 1) % 4] ? 0 : 1;
    }
  }
  return n > 0 ? static_cast<float>(sum / static_cast<double>(n)) : 0;
}

}  // namespace

ChunkFate BodyPicture::take(const BodySurface& chunk) {
  const auto fate = assembly_.take(chunk);
  if (fate == ChunkFate::completed) show(assembly_.finished());
  return fate;
}

ChunkFate BodyPicture::take(const SurfaceChange& page) {
  const auto fate = changes_.take(page);
  if (fate != ChunkFate::kept || revision_ == 0) return fate;
  const auto carried = changes_.carry_out(surface_, shown_memory_);
  if (carried == ChunkFate::completed) follow_surface();
  return carried;
}

void BodyPicture::begin_anew() noexcept {
  assembly_.begin_anew();
  changes_.begin_anew();
  let_go_of_held();
  held_revision_ = revision_ = 0;
}

void BodyPicture::show(Surface surface) {
  surface_ = std::move(surface);
  revision_ = surface_.revision;
  const auto n = surface_.position.size();
  shown_memory_.clear();
  shown_memory_.add(n * sizeof(Array3f) +
                    surface_.corners.size() * (sizeof(Corners) + sizeof(std::uint32_t)));
  rest_.clear();
  flags_.clear();
  packed_.clear();
  is_moved_.assign(n, 0);
  moved_.clear();
  if (first_box_.isEmpty()) {
    for (const auto& p : surface_.position) first_box_.extend(Eigen::Vector3f(p[0], p[1], p[2]));
    edge_length_ = mean_edge_length(surface_);
  }
  changes_.carry_out(surface_, shown_memory_);
  follow_surface();
}

/// Facets or the number of vertices have changed.
void BodyPicture::follow_surface() {
  const auto n = surface_.position.size();
  rest_.insert(rest_.end(), surface_.position.begin() + static_cast<std::ptrdiff_t>(rest_.size()),
               surface_.position.end());  // new ones lie there still
  flags_.resize(n, 0);
  field_.resize(n, 0.0F);
  is_moved_.resize(n, 0);
  packed_.resize(n);
  dirty_.clear();
  is_dirty_.assign(n, 0);
  vertex_rgba_ = mean_colours(surface_);
  rebuild_ = all_dirty_ = true;
  n_facets_ = static_cast<std::size_t>(std::count_if(surface_.corners.begin(), surface_.corners.end(),
                                                     [](const Corners& c) { return !is_loose(c); }));
  take_held();
}

void BodyPicture::take_held() {
  if (held_revision_ > revision_) return;
  std::erase_if(held_, [this](const auto& held) {
    const VertexBlock& block = held.second;
    if (held_revision_ == revision_ && end_of(block) > surface_.position.size()) return false;
    if (held_revision_ == revision_) apply(block);
    return true;
  });
  held_memory_.clear();
  held_memory_.add(held_.size() * sizeof(VertexBlock));
}

bool BodyPicture::take(const VertexBlock& block) {
  if (!well_formed(block) || block.revision < revision_) return false;
  if (block.revision > revision_) return hold(block);
  if (empty()) return false;
  if (end_of(block) > surface_.position.size()) return hold(block);
  apply(block);
  return true;
}

bool BodyPicture::hold(const VertexBlock& block) {
  if (block.revision < held_revision_) return false;
  if (block.revision > held_revision_) let_go_of_held();
  held_revision_ = block.revision;
  if (held_.count(block.block) == 0 && !held_memory_.add(sizeof block)) return false;
  held_[block.block] = block;
  return true;
}

void BodyPicture::let_go_of_held() noexcept {
  held_.clear();
  held_memory_.clear();
}

void BodyPicture::apply(const VertexBlock& block) {
  for (std::uint32_t i = 0; i < block.n_vertices; ++i) {
    const std::uint32_t v = block.first_vertex + i;
    if (flags_[v] != block.flags[i]) {
      flags_[v] = block.flags[i];
      pack(v);
      touch(v);
    }
    const float field = static_cast<float>(block.field[i]) / 255.0F * block.field_most;
    if (field_[v] != field) {
      field_[v] = field;
      touch(v);
    }
    if (surface_.position[v] == block.position[i]) continue;
    surface_.position[v] = block.position[i];
    touch(v);
    if (is_moved_[v] != 0) continue;
    is_moved_[v] = 1;
    moved_.push_back(v);
  }
}

void BodyPicture::refresh() {
  if (rebuild_) {
    // Why: five passes make a staircase look even, and would wipe the face off a head.
    normals_.set_passes(is_smooth_skin(rest_, surface_.corners) ? 1 : SurfaceNormals::for_stairs);
    normals_.rebuild(surface_.position, surface_.corners);
    for (std::size_t v = 0; v < packed_.size(); ++v) pack(v);
  } else if (!moved_.empty()) {
    for (const auto v : normals_.update(surface_.position, surface_.corners, moved_)) {
      pack(v);
      touch(v);
    }
  }
  for (const auto v : moved_) is_moved_[v] = 0;
  moved_.clear();
  rebuild_ = false;
}

float BodyPicture::farthest() const noexcept {
  float most2 = 0;
  for (std::size_t v = 0; v < rest_.size(); ++v) {
    const Array3f &p = surface_.position[v], &r = rest_[v];
    const float x = p[0] - r[0], y = p[1] - r[1], z = p[2] - r[2];
    most2 = std::max(most2, x * x + y * y + z * z);
  }
  return std::sqrt(most2);
}

float BodyPicture::most_field() const noexcept {
  float most = 0;
  for (const float value : field_) most = std::max(most, value);
  return most;
}

void BodyPicture::pack(std::size_t vertex) {
  packed_[vertex].flags = flags_[vertex];
  if (normals_.normals().size() != packed_.size()) return;  // refresh() will come
  const auto& n = normals_.normals()[vertex];
  for (int axis = 0; axis < 3; ++axis) {
    packed_[vertex].normal[static_cast<std::size_t>(axis)] =
        static_cast<std::int16_t>(std::lround(n[axis] * 32767.0F));
  }
}

std::vector<VertexRange> BodyPicture::dirty_ranges() const {
  std::vector<VertexRange> ranges;
  std::vector<std::uint8_t> is_dirty((packed_.size() + page_vertices - 1) / page_vertices, 0);
  for (const std::uint32_t v : dirty_) is_dirty[v / page_vertices] = 1;
  for (std::size_t page = 0; page < is_dirty.size(); ++page) {
    if (is_dirty[page] == 0) continue;
    const auto first = page * page_vertices;
    const auto n = std::min(page_vertices, packed_.size() - first);
    if (!ranges.empty() && ranges.back().first + ranges.back().n == first) {
      ranges.back().n += n;
    } else {
      ranges.push_back({first, n});
    }
  }
  return ranges;
}

void BodyPicture::clear_dirty() {
  all_dirty_ = false;
  for (const std::uint32_t v : dirty_) is_dirty_[v] = 0;
  dirty_.clear();
}

}  // namespace palpate::render
