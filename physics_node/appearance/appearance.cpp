#include "physics_node/appearance/appearance.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "common/scene/scene.h"
#include "physics_node/appearance/colours.h"
#include "physics_node/boundary/loose_parts.h"

namespace palpate::physics {
namespace {

constexpr float visible_motion = 1e-5F;  // [m]
Array3f float_of(const Vec3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

std::uint8_t vertex_flags(const Condition& condition) {
  unsigned flags = (condition.flags & mass_broken) != 0 ? vertex_broken : 0;
  if ((condition.flags & mass_yielded) != 0) {
    const auto share = static_cast<unsigned>(std::lround(63 * condition.yielded_share));
    flags |= vertex_yielded | share * vertex_share_one;
  }
  return static_cast<std::uint8_t>(flags);
}

std::uint32_t chunks_for(std::size_t n, std::uint32_t per_chunk) {
  return static_cast<std::uint32_t>((n + per_chunk - 1) / per_chunk);
}

}  // namespace

Appearance::Appearance(const World& world, std::optional<double> threshold, Remake how)
    : world_(world), views_(world.n_bodies()), threshold_(threshold), how_(how) {
  restored_ = world.report().restored;
  for (std::size_t b = 0; b < views_.size(); ++b) {
    views_[b].live = std::make_unique<LiveElements>(world.body(b));
    views_[b].breaks = world.body(b).losses().breaks;
    show(b, make(b));
  }
}

/// From the copy of the live elements and what is constant: safe in another thread.
Surface Appearance::make(std::size_t body) const {
  const Body& constant = world_.body(body).body();
  const LiveElements& live = *views_[body].live;
  const std::uint32_t rgba = body_colour(world_.scene(), body);
  Surface surface = make_surface(constant, live, threshold_, rgba);
  add_loose_parts(constant, live, threshold_, rgba, surface);
  return surface;
}

void Appearance::show(std::size_t body, Surface surface) {
  View& view = views_[body];
  view.surface = std::move(surface);
  const Fragments* fragments = world_.fragments(body);
  if (fragments != nullptr && world_.scene().render.show_fragments)
    colour_fragments(*fragments, view.surface);
  ++view.revision;
  view.published = false;
  view.sent.assign(view.surface.n_moving(), Array3f{NAN, NAN, NAN});
  view.sent_flags.assign(view.surface.n_moving(), 0);
}

void Appearance::set_threshold(double threshold) {
  wanted_ = threshold;
  poll();
}

/// Bodies whose surface is not that of their live elements and the threshold any more; takes note of both.
std::vector<std::size_t> Appearance::outdated() {
  std::vector<std::size_t> bodies;
  const bool went_back = world_.report().restored != restored_;
  restored_ = world_.report().restored;
  for (std::size_t b = 0; b < views_.size(); ++b) {
    const BodyModel& moving = world_.body(b);
    const Body& body = moving.body();
    const bool by_threshold = wanted_ && body.cells && !body.cells->intensity.empty();
    bool by_breaks = false;
    if (any_yields(body)) {
      const std::int64_t breaks = moving.losses().breaks;  // fewer after a reset
      by_breaks = went_back || breaks != views_[b].breaks;
      views_[b].breaks = breaks;
      if (by_breaks) views_[b].live->copy(moving);
    }
    if (by_threshold || by_breaks) bodies.push_back(b);
  }
  if (wanted_) threshold_ = wanted_;
  wanted_.reset();
  return bodies;
}

bool Appearance::poll() {
  if (pending_.valid() && pending_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    for (auto& [body, surface] : pending_.get()) show(body, std::move(surface));
  if (!pending_.valid()) {
    const auto bodies = outdated();
    if (!bodies.empty() && how_ == Remake::at_once) {
      for (const std::size_t b : bodies) show(b, make(b));
    } else if (!bodies.empty()) {
      pending_ = std::async(std::launch::async, [this, bodies] {
        Made made;
        for (const std::size_t b : bodies) made.emplace_back(b, make(b));
        return made;
      });
    }
  }
  return std::any_of(views_.begin(), views_.end(), [](const View& view) { return !view.published; });
}

int Appearance::write_surfaces(const std::function<void(const BodySurface&)>& sink) {
  int chunks = 0;
  for (std::size_t b = 0; b < views_.size(); ++b) {
    View& view = views_[b];
    if (view.published) continue;
    view.published = true;
    const std::uint32_t n_chunks = std::max({1U, chunks_for(view.surface.n_vertices(), max_surface_vertices),
                                             chunks_for(view.surface.facets.size(), max_surface_facets)});
    chunk_->n_chunks = n_chunks;
    for (std::uint32_t c = 0; c < n_chunks; ++c) write_chunk(b, c, sink);
    chunks += static_cast<int>(n_chunks);
  }
  return chunks;
}

void Appearance::write_chunk(std::size_t body, std::uint32_t chunk,
                             const std::function<void(const BodySurface&)>& sink) {
  const View& view = views_[body];
  const Surface& surface = view.surface;
  const BodyModel& moving = world_.body(body);
  BodySurface& out = *chunk_;
  out.body = static_cast<std::uint32_t>(body);
  out.revision = view.revision;
  out.chunk = chunk;
  out.total_vertices = static_cast<std::uint32_t>(surface.n_vertices());
  out.total_facets = static_cast<std::uint32_t>(surface.facets.size());
  out.facets_hidden = static_cast<std::uint32_t>(surface.hidden);
  out.rigid = surface.n_moving() == 0 ? 1 : 0;
  out.first_vertex = std::min(chunk * max_surface_vertices, out.total_vertices);
  out.n_vertices = std::min(max_surface_vertices, out.total_vertices - out.first_vertex);
  out.first_facet = std::min(chunk * max_surface_facets, out.total_facets);
  out.n_facets = std::min(max_surface_facets, out.total_facets - out.first_facet);
  for (std::uint32_t n = 0; n < out.n_vertices; ++n)
    out.position[n] = float_of(surface.position(out.first_vertex + n, moving));
  for (std::uint32_t n = 0; n < out.n_facets; ++n) {
    out.corners[n] = surface.facets[out.first_facet + n];
    out.rgba[n] = surface.rgba[out.first_facet + n];
  }
  sink(out);
}

bool Appearance::block_changed(const View& view, const NodeMotion& moving, std::size_t first,
                               std::size_t last) const {
  for (std::size_t n = first; n < last; ++n) {
    const Index cell = view.surface.cell[n];
    if (vertex_flags(conditions_[n - first]) != view.sent_flags[n]) return true;
    const Array3f p = float_of(moving.position(cell));
    for (std::size_t a = 0; a < 3; ++a)
      if (!(std::abs(p[a] - view.sent[n][a]) <= visible_motion)) return true;
  }
  return false;
}

int Appearance::write_blocks(const std::function<void(const VertexBlock&)>& sink) {
  int blocks = 0;
  for (std::size_t b = 0; b < views_.size(); ++b) {
    View& view = views_[b];
    const BodyModel& moving = world_.body(b);
    for (std::size_t first = 0; first < view.surface.n_moving(); first += max_block_vertices) {
      const std::size_t last = std::min<std::size_t>(first + max_block_vertices, view.surface.n_moving());
      moving.conditions(std::span(view.surface.cell).subspan(first, last - first), conditions_);
      if (!block_changed(view, moving, first, last)) continue;
      VertexBlock& out = *block_;
      out.body = static_cast<std::uint32_t>(b);
      out.revision = view.revision;
      out.block = static_cast<std::uint32_t>(first / max_block_vertices);
      out.tick = static_cast<std::uint64_t>(world_.report().frames);
      out.t = world_.t();
      out.first_vertex = static_cast<std::uint32_t>(first);
      out.n_vertices = static_cast<std::uint32_t>(last - first);
      for (std::size_t n = first; n < last; ++n) {
        const Index cell = view.surface.cell[n];
        out.position[n - first] = view.sent[n] = float_of(moving.position(cell));
        out.flags[n - first] = view.sent_flags[n] = vertex_flags(conditions_[n - first]);
      }
      sink(out);
      ++blocks;
    }
  }
  return blocks;
}

void Appearance::resend() {
  for (View& view : views_) std::fill(view.sent.begin(), view.sent.end(), Array3f{NAN, NAN, NAN});
}

std::size_t Appearance::facets_visible() const {
  std::size_t n = 0;
  for (const View& view : views_) n += view.surface.facets.size() - count_loose(view.surface);
  return n;
}

std::size_t Appearance::facets_total() const {
  std::size_t n = facets_visible();
  for (const View& view : views_) n += view.surface.hidden;
  return n;
}

}  // namespace palpate::physics
