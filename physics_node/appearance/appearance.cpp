#include "physics_node/appearance/appearance.h"

#include <algorithm>
#include <chrono>

#include "common/scene/inside_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "physics_node/appearance/surface_chunks.h"
#include "physics_node/boundary/loose_parts.h"

namespace palpate::physics {
Appearance::Appearance(const World& world, std::optional<double> threshold, Remake how)
    : world_(world),
      views_(world.n_bodies()),
      threshold_(threshold),
      section_(world.scene().render->section),
      inside_(world.scene().render->inside),
      how_(how) {
  restored_ = world.report().restored;
  for (std::size_t b = 0; b < views_.size(); ++b) {
    views_[b].body = b;
    views_[b].number = static_cast<std::uint32_t>(b);
    copy(b);
    views_[b].breaks = world.body(b).losses().breaks;
  }
  for (std::size_t c = 0; c < world.n_connections(); ++c)
    strands_.emplace_back(world.connection(c), static_cast<std::uint32_t>(views_.size() + c), strand_colour);
  auto number = static_cast<std::uint32_t>(views_.size() + strands_.size());
  for (const std::size_t b : bodies_with_section(world.scene())) {
    View& view = views_.emplace_back();
    view.body = b;
    view.number = number++;
    view.grey = grey_scale_of(*world.body(b).body().cells);
  }
  for (const std::size_t b : bodies_with_inside(world.scene())) {
    View& view = views_.emplace_back();
    view.body = b;
    view.number = number++;
    view.inside = true;
  }
  for (std::size_t v = 0; v < views_.size(); ++v) {
    if (is_out(views_[v])) continue;
    views_[v].shown = NumberedSurface(surface_of(v));
    begin_whole(views_[v]);
  }
  set_colour(world.scene().render->colour);
}

void Appearance::set_colour(ColourKind kind) {
  for (View& view : views_) view.field = TissueField::of(world_.body(view.body), kind);
  resend();
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
Surface Appearance::surface_of(std::size_t v) const {
  const View& view = views_[v];
  const Body& constant = world_.body(view.body).body();
  const std::uint32_t rgba = body_colour(world_.scene(), view.body);
  if (view.grey) {
    if (!section_) return {};
    return section_surface(constant, *views_[view.body].live, *section_, *view.grey, rgba);
  }
  if (view.inside) return make_surface(constant, *views_[view.body].live, inside_, rgba);
  Surface surface = make_surface(constant, *view.live, threshold_, rgba);
  add_loose_parts(constant, *view.live, threshold_, rgba, surface);
  if (view.colours != nullptr) view.colours->paint(surface);
  return surface;
}

/// Safe in another thread as long as nothing is shown meanwhile.
Appearance::Made Appearance::make(const Job& job) const {
  const View& view = views_[job.view];
  const NumberedSurface& shown = view.shown;
  Surface surface = surface_of(job.view);
  // Of a section that was somewhere else, or from another intensity on, nothing is as before.
  if (view.grey || view.inside) return {job.view, NumberedSurface(std::move(surface)), {}};
  Made made{job.view, std::nullopt, shown.delta_to(surface)};
  const std::size_t pages = ChangePages::most_pages(job.listed.vertices + made.delta.vertices.size(),
                                                    job.listed.facets + made.delta.facets.size());
  const std::size_t chunks = n_chunks(surface.n_vertices(), surface.facets.size());
  const bool begins_to_move = shown.is_rigid() && surface.n_moving() > 0;
  if (pages > max_change_pages || pages * page_bytes > chunks * chunk_bytes || begins_to_move)
    made.whole.emplace(std::move(surface));
  return made;
}

void Appearance::show(Made made) {
  View& view = views_[made.view];
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

void Appearance::publish_anew(std::size_t number) {
  for (View& view : views_)
    if (view.number == number && !is_out(view)) return begin_whole(view);
  if (const std::size_t strands = number - world_.n_bodies();
      number >= world_.n_bodies() && strands < strands_.size())
    strands_[strands].publish_anew();
}

void Appearance::set_threshold(double threshold) {
  wanted_ = threshold;
  poll();
}

void Appearance::set_section(const std::optional<SectionSpec>& section) {
  wanted_section_ = section;
  poll();
}

void Appearance::set_inside(const std::optional<double>& from) {
  wanted_inside_ = from;
  poll();
}

bool Appearance::settle(std::chrono::milliseconds at_most) {
  const auto end = std::chrono::steady_clock::now() + at_most;
  for (poll(); pending_.valid(); poll())
    if (pending_.wait_until(end) != std::future_status::ready) return false;
  return true;
}

/// Those whose surface is not that of their live elements, the threshold and the section any more; takes note of all.
std::vector<Appearance::Job> Appearance::outdated() {
  std::vector<Job> jobs;
  const bool went_back = world_.report().restored != restored_;
  restored_ = world_.report().restored;
  const bool by_section = wanted_section_ && *wanted_section_ != section_;
  if (wanted_section_) section_ = *wanted_section_;
  wanted_section_.reset();
  const bool by_inside = wanted_inside_ && *wanted_inside_ != inside_;
  if (wanted_inside_) inside_ = *wanted_inside_;
  wanted_inside_.reset();
  std::vector<bool> broke(world_.n_bodies());
  for (std::size_t b = 0; b < broke.size(); ++b) {
    const BodyModel& moving = world_.body(b);
    const Body& body = moving.body();
    const bool by_threshold = wanted_ && body.cells && !body.cells->intensity.empty();
    bool by_breaks = false;
    if (may_come_apart(body)) {
      const std::int64_t breaks = moving.losses().breaks;  // fewer after a reset
      by_breaks = went_back || breaks != views_[b].breaks;
      views_[b].breaks = breaks;
      if (by_breaks) copy(b);
      broke[b] = by_breaks;
    }
    if (by_threshold || by_breaks) jobs.push_back({b, views_[b].listed});
  }
  for (std::size_t v = broke.size(); v < views_.size(); ++v)
    if (!is_out(views_[v]) && (broke[views_[v].body] || (views_[v].inside ? by_inside : by_section)))
      jobs.push_back({v, {}});
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
  for (View& view : views_) {
    if (view.due == Due::nothing) continue;
    const bool whole = view.due == Due::whole;
    const int written = whole ? write_whole(view, sinks.whole) : write_change(view, sinks.change);
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
int Appearance::write_change(View& view, const std::function<void(const SurfaceChange&)>& sink) {
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
int Appearance::write_whole(View& view, const std::function<void(const BodySurface&)>& sink) {
  const NumberedSurface& surface = view.shown;
  BodySurface& out = *chunk_;
  out.body = view.number;
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
  for (View& view : views_) {
    if (is_out(view)) continue;
    block_->body = view.number;
    block_->revision = view.revision;
    blocks += view.blocks.write(view.shown, world_.body(view.body), view.field.get(), *block_, sink);
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
  for (const View& view : views_) {
    if (view.grey || view.inside) continue;
    n += static_cast<std::size_t>(std::count_if(view.shown.facets().begin(), view.shown.facets().end(),
                                                [](const auto& facet) { return !is_loose(facet); }));
  }
  for (const StrandPicture& strands : strands_) n += strands.n_facets();
  return n;
}

std::size_t Appearance::facets_total() const {
  std::size_t n = facets_visible();
  for (const View& view : views_) n += view.inside ? 0 : view.shown.hidden();
  return n;
}

}  // namespace palpate::physics
