#include "physics_node/appearance/appearance.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace palpate::physics {
namespace {

constexpr float visible_motion = 1e-5F;           // [m]
constexpr std::int64_t frames_between_cuts = 50;  // broken elements change a surface at most this often

/// Plain colours for bodies without an image, one after the other (0xAABBGGRR).
constexpr std::array<std::uint32_t, 5> plain{0xFF8FA8E0, 0xFFB0C890, 0xFFD0B080, 0xFF90C8D8, 0xFFC0A0D0};

Array3f float_of(const Vec3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

std::uint8_t vertex_flags(std::uint8_t of_mass) {
  return static_cast<std::uint8_t>(((of_mass & mass_yielded) != 0 ? vertex_yielded : 0) |
                                   ((of_mass & mass_broken) != 0 ? vertex_broken : 0));
}

std::uint32_t chunks_for(std::size_t n, std::uint32_t per_chunk) {
  return static_cast<std::uint32_t>((n + per_chunk - 1) / per_chunk);
}

}  // namespace

Appearance::Appearance(const World& world, std::optional<double> threshold)
    : world_(world), views_(world.n_bodies()) {
  for (std::size_t b = 0; b < views_.size(); ++b)
    show(b, make_surface(world.body(b), threshold, plain[b % plain.size()]));
}

void Appearance::show(std::size_t body, Surface surface) {
  View& view = views_[body];
  view.surface = std::move(surface);
  view.published = false;
  view.sent.assign(view.surface.n_moving(), Array3f{NAN, NAN, NAN});
  view.sent_flags.assign(view.surface.n_moving(), 0);
}

void Appearance::set_threshold(double threshold) {
  wanted_ = threshold;
  poll();
}

bool Appearance::poll() {
  bool fresh = false;
  if (pending_.valid() && pending_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    for (auto& [body, surface] : pending_.get()) {
      show(body, std::move(surface));
      ++views_[body].revision;
      fresh = true;
    }
  }
  if (wanted_ && !pending_.valid()) {
    pending_ = std::async(std::launch::async, [this, threshold = *wanted_] {
      std::vector<std::pair<std::size_t, Surface>> made;
      for (std::size_t b = 0; b < views_.size(); ++b) {
        const Body& body = world_.body(b).body();  // constant: safe from another thread
        if (body.cells && !body.cells->intensity.empty())
          made.emplace_back(b, voxel_surface(body, threshold));
      }
      return made;
    });
    wanted_.reset();
  }
  const StepReport& report = world_.report();
  if (report.broken != broken_seen_ && report.frames - frames_seen_ >= frames_between_cuts) {
    broken_seen_ = report.broken;
    frames_seen_ = report.frames;
    for (std::size_t b = 0; b < views_.size(); ++b) {
      if (world_.body(b).body().cells || !any_yields(world_.body(b).body())) continue;
      show(b, make_surface(world_.body(b), std::nullopt, plain[b % plain.size()]));
      ++views_[b].revision;
      fresh = true;
    }
  }
  return fresh || std::any_of(views_.begin(), views_.end(), [](const View& view) { return !view.published; });
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
  const MovingBody& moving = world_.body(body);
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

bool Appearance::block_changed(const View& view, const MovingBody& moving, std::size_t first,
                               std::size_t last) const {
  for (std::size_t n = first; n < last; ++n) {
    const Index cell = view.surface.cell[n];
    if (vertex_flags(moving.flags(cell)) != view.sent_flags[n]) return true;
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
    const MovingBody& moving = world_.body(b);
    for (std::size_t first = 0; first < view.surface.n_moving(); first += max_block_vertices) {
      const std::size_t last = std::min<std::size_t>(first + max_block_vertices, view.surface.n_moving());
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
        out.flags[n - first] = view.sent_flags[n] = vertex_flags(moving.flags(cell));
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
  for (const View& view : views_) n += view.surface.facets.size();
  return n;
}

std::size_t Appearance::facets_total() const {
  std::size_t n = facets_visible();
  for (const View& view : views_) n += view.surface.hidden;
  return n;
}

}  // namespace palpate::physics
