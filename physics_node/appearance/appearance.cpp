#include "physics_node/appearance/appearance.h"

#include <algorithm>
#include <chrono>

#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "physics_node/appearance/surface_chunks.h"
#include "physics_node/boundary/loose_parts.h"

namespace palpate::physics {
Appearance::Appearance(const World& world, std::optional<double> threshold, Remake how)
    : world_(world), views_(world.n_bodies()), threshold_(threshold), how_(how) {
  restored_ = world.report().restored;
  for (std::size_t b = 0; b < views_.size(); ++b) {
    copy(b);
    views_[b].breaks = world.body(b).losses().breaks;
    views_[b].shown = NumberedSurface(surface_of(b));
    begin_whole(views_[b]);
  }
  for (std::size_t c = 0; c < world.n_connections(); ++c)
    strands_.emplace_back(world.connection(c), static_cast<std::uint32_t>(views_.size() + c), strand_colour);
}

/// What a surface is made from, so that the body may move on.
void Appearance::copy(std::size_t body) {
  View& view = views_[body];
  const BodyModel& moving = world_.body(body);
  if (view.live == nullptr)
    view.live = std::make_unique<LiveElements>(moving);
  else
    view.live->copy(moving);
  const Fragments* fragments = world_.fragments(body);
  if (fragments != nullptr && world_.scene().render->show_fragments)
    view.colours = std::make_unique<FragmentColours>(*fragments, moving.body());
}

/// From copies and what is constant: safe in another thread.
Surface Appearance::surface_of(std::size_t body) const {
  const Body& constant = world_.body(body).body();
  const View& view = views_[body];
  const std::uint32_t rgba = body_colour(world_.scene(), body);
  Surface surface = make_surface(constant, *view.live, threshold_, rgba);
  add_loose_parts(constant, *view.live, threshold_, rgba, surface);
  if (view.colours != nullptr) view.colours->paint(surface);
  return surface;
}

/// Safe in another thread as long as nothing is shown meanwhile.
Appearance::Made Appearance::make(const Job& job) const {
  const NumberedSurface& shown = views_[job.body].shown;
  Surface surface = surface_of(job.body);
  Made made{job.body, std::nullopt, shown.delta_to(surface)};
  const std::size_t pages = ChangePages::most_pages(job.listed.vertices + made.delta.vertices.size(),
                                                    job.listed.facets + made.delta.facets.size());
  const std::size_t chunks = n_chunks(surface.n_vertices(), surface.facets.size());
  const bool begins_to_move = shown.is_rigid() && surface.n_moving() > 0;
  if (pages > max_change_pages || pages * page_bytes > chunks * chunk_bytes || begins_to_move)
    made.whole.emplace(std::move(surface));
  return made;
}

void Appearance::show(Made made) {
  View& view = views_[made.body];
  if (made.whole) {
    view.shown = std::move(*made.whole);
    return begin_whole(view);
  }
  const SurfaceDelta& delta = made.delta;
  if (delta.vertices.empty() && delta.facets.empty() && delta.hidden == view.shown.hidden()) return;
  view.shown.apply(delta);
  view.blocks.grow(view.shown);
  if (view.due == Due::whole) return;
  view.due = Due::change;
  view.due_facets.insert(view.due_facets.end(), delta.facets.begin(), delta.facets.end());
  view.listed.vertices += delta.vertices.size();
  view.listed.facets += delta.facets.size();
}

void Appearance::begin_whole(View& view) {
  ++view.revision;
  view.due = Due::whole;
  view.listed = {};
  view.due_facets.clear();
  view.blocks.begin(view.shown.n_vertices());
}

void Appearance::publish_anew(std::size_t body) {
  if (body < views_.size()) return begin_whole(views_[body]);
  strands_.at(body - views_.size()).publish_anew();
}

void Appearance::set_threshold(double threshold) {
  wanted_ = threshold;
  poll();
}

/// Bodies whose surface is not that of their live elements and the threshold any more; takes note of both.
std::vector<Appearance::Job> Appearance::outdated() {
  std::vector<Job> jobs;
  const bool went_back = world_.report().restored != restored_;
  restored_ = world_.report().restored;
  for (std::size_t b = 0; b < views_.size(); ++b) {
    const BodyModel& moving = world_.body(b);
    const Body& body = moving.body();
    const bool by_threshold = wanted_ && body.cells && !body.cells->intensity.empty();
    bool by_breaks = false;
    if (any_breaks(body)) {
      const std::int64_t breaks = moving.losses().breaks;  // fewer after a reset
      by_breaks = went_back || breaks != views_[b].breaks;
      views_[b].breaks = breaks;
      if (by_breaks) copy(b);
    }
    if (by_threshold || by_breaks) jobs.push_back({b, views_[b].listed});
  }
  if (wanted_) threshold_ = wanted_;
  wanted_.reset();
  return jobs;
}

bool Appearance::poll() {
  if (pending_.valid() && pending_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    for (Made& made : pending_.get()) show(std::move(made));
  if (!pending_.valid()) {
    const auto jobs = outdated();
    if (!jobs.empty() && how_ == Remake::at_once) {
      for (const Job& job : jobs) show(make(job));
    } else if (!jobs.empty()) {
      pending_ = std::async(std::launch::async, [this, jobs] {
        std::vector<Made> made;
        for (const Job& job : jobs) made.push_back(make(job));
        return made;
      });
    }
  }
  return std::ranges::any_of(views_, [](const View& view) { return view.due != Due::nothing; }) ||
         std::ranges::any_of(strands_, &StrandPicture::is_due);
}

int Appearance::write_surfaces(const SurfaceSinks& sinks) {
  int samples = 0;
  for (std::size_t b = 0; b < views_.size(); ++b) {
    View& view = views_[b];
    if (view.due == Due::nothing) continue;
    const bool whole = view.due == Due::whole;
    const int written = whole ? write_whole(b, sinks.whole) : write_change(b, sinks.change);
    samples += written;
    view.due = Due::nothing;
    const std::size_t bytes = static_cast<std::size_t>(written) * (whole ? chunk_bytes : page_bytes);
    if (whole && view.revision == 1) {
      bytes_.first += bytes;
      continue;
    }
    bytes_.sent += bytes;
    bytes_.whole += chunk_bytes * n_chunks(view.shown.n_vertices(), view.shown.facets().size());
  }
  for (StrandPicture& strands : strands_) samples += strands.write(*chunk_, sinks.whole);
  return samples;
}

/// @return pages
int Appearance::write_change(std::size_t body, const std::function<void(const SurfaceChange&)>& sink) {
  View& view = views_[body];
  new_vertices_.clear();
  for (std::size_t v = view.n_told; v < view.shown.n_vertices(); ++v)
    new_vertices_.push_back(float_of(view.shown.rest(v)));
  const int pages = view.pages.add(new_vertices_, view.due_facets,
                                   {static_cast<std::uint32_t>(view.shown.facets().size()),
                                    static_cast<std::uint32_t>(view.shown.hidden())},
                                   sink);
  view.n_told = view.shown.n_vertices();
  view.due_facets.clear();
  return pages;
}

/// @return chunks
int Appearance::write_whole(std::size_t body, const std::function<void(const BodySurface&)>& sink) {
  View& view = views_[body];
  const NumberedSurface& surface = view.shown;
  BodySurface& out = *chunk_;
  out.body = static_cast<std::uint32_t>(body);
  out.revision = view.revision;
  out.facets_hidden = static_cast<std::uint32_t>(surface.hidden());
  out.rigid = surface.is_rigid() ? 1 : 0;
  write_chunks(
      out, surface.n_vertices(), surface.facets(), surface.rgba(),
      [&](std::size_t n) { return float_of(surface.rest(n)); }, sink);
  view.n_told = surface.n_vertices();
  view.pages.begin(out.body, out.revision, out.total_vertices);
  return static_cast<int>(out.n_chunks);
}

int Appearance::write_blocks(const std::function<void(const VertexBlock&)>& sink) {
  int blocks = 0;
  block_->tick = static_cast<std::uint64_t>(world_.report().frames);
  block_->t = world_.t();
  for (std::size_t b = 0; b < views_.size(); ++b) {
    View& view = views_[b];
    block_->body = static_cast<std::uint32_t>(b);
    block_->revision = view.revision;
    blocks += view.blocks.write(view.shown, world_.body(b), *block_, sink);
  }
  for (StrandPicture& strands : strands_) blocks += strands.write_blocks(*block_, sink);
  return blocks;
}

void Appearance::resend() {
  for (View& view : views_) view.blocks.resend();
  for (StrandPicture& strands : strands_) strands.resend();
}

std::size_t Appearance::facets_visible() const {
  std::size_t n = 0;
  for (const View& view : views_)
    n += static_cast<std::size_t>(std::count_if(view.shown.facets().begin(), view.shown.facets().end(),
                                                [](const auto& facet) { return !is_loose(facet); }));
  for (const StrandPicture& strands : strands_) n += strands.n_facets();
  return n;
}

std::size_t Appearance::facets_total() const {
  std::size_t n = facets_visible();
  for (const View& view : views_) n += view.shown.hidden();
  return n;
}

}  // namespace palpate::physics
