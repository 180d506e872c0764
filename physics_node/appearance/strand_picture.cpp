#include "physics_node/appearance/strand_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "physics_node/appearance/moved_blocks.h"
#include "physics_node/appearance/surface_chunks.h"

namespace palpate::physics {
namespace {

constexpr std::size_t vertices_a_strand = 6;
constexpr double thin =
    0.12;  // Why: of the side of its patch; a bed of strands lets the tissue behind it be seen
constexpr Array3f not_sent{std::numeric_limits<float>::quiet_NaN(), 0, 0};

/// Of an equilateral triangle about the middle: cosine and sine.
constexpr double half_root_three = 0.8660254037844386;
constexpr std::array<std::array<double, 2>, 3> corners{
    {{1, 0}, {-0.5, half_root_three}, {-0.5, -half_root_three}}};

}  // namespace

StrandPicture::StrandPicture(const Connection& connection, std::uint32_t body, std::uint32_t rgba)
    : connection_(connection), body_(body) {
  const auto n = static_cast<std::uint32_t>(connection.strands().size());
  for (std::uint32_t s = 0; s < n; ++s) {
    const std::uint32_t a = vertices_a_strand * s, b = a + 3;  // corners at its node, at its foot
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t next = (k + 1) % 3;
      facets_.push_back({a + k, a + next, b + next, b + k});
    }
    facets_.push_back({a, a + 2, a + 1, a + 1});
    facets_.push_back({b, b + 1, b + 2, b + 2});
  }
  rgba_.assign(facets_.size(), rgba);
  now_.resize(vertices_a_strand * n);
  resend();
}

void StrandPicture::resend() { sent_.assign(now_.size(), not_sent); }

void StrandPicture::publish_anew() {
  ++revision_;
  due_ = true;
  resend();
}

void StrandPicture::place() {
  const auto& strands = connection_.strands();
  for (std::size_t s = 0; s < strands.size(); ++s) {
    const Connection::Ends ends = connection_.places(strands[s]);
    const Vec3 way = ends.foot - ends.node;
    const double length = way.norm();
    const bool seen = connection_.holds(s) && length > 0;
    const double r = seen ? thin * std::sqrt(strands[s].area * connection_.left(s)) : 0.0;
    const Vec3 u = length > 0 ? Vec3(way / length) : Vec3(Vec3::UnitX());
    const Vec3 e = u.unitOrthogonal(), f = u.cross(e);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 corner = r * (corners[k][0] * e + corners[k][1] * f);
      now_[vertices_a_strand * s + k] = float_of(ends.node + corner);
      now_[vertices_a_strand * s + 3 + k] = float_of(seen ? Vec3(ends.foot + corner) : ends.node);
    }
  }
}

int StrandPicture::write(BodySurface& chunk, const std::function<void(const BodySurface&)>& sink) {
  if (!due_) return 0;
  due_ = false;
  place();
  sent_ = now_;
  chunk.body = body_;
  chunk.revision = revision_;
  chunk.facets_hidden = chunk.rigid = 0;
  write_chunks(
      chunk, now_.size(), facets_, rgba_, [this](std::size_t n) { return now_[n]; }, sink);
  return static_cast<int>(chunk.n_chunks);
}

int StrandPicture::write_blocks(VertexBlock& block, const std::function<void(const VertexBlock&)>& sink) {
  place();
  block.body = body_;
  block.revision = revision_;
  int blocks = 0;
  for (std::size_t first = 0; first < now_.size(); first += max_block_vertices) {
    const std::size_t last = std::min<std::size_t>(first + max_block_vertices, now_.size());
    bool moved = false;
    for (std::size_t n = first; n < last && !moved; ++n) moved = is_seen_to_move(sent_[n], now_[n]);
    if (!moved) continue;
    block.block = static_cast<std::uint32_t>(first / max_block_vertices);
    block.first_vertex = static_cast<std::uint32_t>(first);
    block.n_vertices = static_cast<std::uint32_t>(last - first);
    block.field_most = 0;
    for (std::size_t n = first; n < last; ++n) {
      block.position[n - first] = sent_[n] = now_[n];
      block.flags[n - first] = block.field[n - first] = 0;
    }
    sink(block);
    ++blocks;
  }
  return blocks;
}

}  // namespace palpate::physics
