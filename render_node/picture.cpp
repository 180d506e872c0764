#include "render_node/picture.h"

#include "common/error/error.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "render_node/gl/egl_context.h"
#include "render_node/gl/framebuffer.h"
#include "render_node/image/png_file.h"
#include "render_node/model/view_model.h"
#include "render_node/ui/stage.h"

namespace palpate::render {
namespace {

constexpr int smooth_samples = 4;
constexpr float frame_seconds = 1.0F / 60;  // ImGui wants one; nothing here is animated by it

}  // namespace

struct Picture::Parts {
  Parts(const Scene& given, Edges edges)
      : scene(given),
        model(scene),
        framebuffer(scene.render->size_px[0], scene.render->size_px[1], 0),
        stage(scene, model, scene.render->size_px[1], edges == Edges::smooth ? smooth_samples : 0) {}
  ~Parts() { make_current(); }  // members let go of what they have in this context

  void make_current() {
    context.make_current();
    stage.make_current();
  }

  Scene scene;
  ViewModel model;
  EglContext context;
  Framebuffer framebuffer;
  Stage stage;
  Image image;
};

Picture::Picture(const Scene& scene, Edges edges) : parts_(std::make_unique<Parts>(scene, edges)) {}
Picture::~Picture() = default;

void Picture::take(const BodySurface& chunk) { parts_->model.take(chunk); }
void Picture::take(const SurfaceChange& page) { parts_->model.take(page); }
void Picture::take(const VertexBlock& block) { parts_->model.take(block); }
void Picture::take(const ToolWrench& wrench) { parts_->model.take(wrench); }
void Picture::take(const HapticTrace& trace) { parts_->model.take(trace); }
void Picture::take(const NodeStatus& status) { parts_->model.take(status); }

void Picture::draw(double t) {
  parts_->make_current();
  parts_->framebuffer.bind();
  PanelFacts facts;
  facts.t = t;
  parts_->stage.draw(facts, parts_->scene.render->size_px[0], parts_->scene.render->size_px[1],
                     frame_seconds);
  parts_->framebuffer.read(parts_->image);
}

void Picture::draw_whole() noexcept { parts_->stage.painter().draw_whole(); }

const Image& Picture::image() const noexcept { return parts_->image; }

void Picture::save_png(const std::string& path) const {
  PALPATE_CHECK(!parts_->image.rgb.empty(), "save_png() before draw()");
  write_png(parts_->image, path);
}

std::size_t Picture::facets_visible() const noexcept { return parts_->model.facets_visible(); }
std::size_t Picture::facets_total() const noexcept { return parts_->model.facets_total(); }
std::size_t Picture::bytes_uploaded() const noexcept { return parts_->stage.painter().bytes_uploaded(); }
double Picture::drawn_share() const noexcept {
  const auto& size = parts_->scene.render->size_px;
  return static_cast<double>(parts_->stage.painter().drawn().pixels()) /
         (static_cast<double>(size[0]) * size[1]);
}
void Picture::set_threshold(double intensity) noexcept { parts_->stage.threshold().obey(intensity); }
void Picture::set_section(const std::optional<SectionSpec>& section) noexcept {
  parts_->stage.section().obey(section);
}
void Picture::set_inside(const std::optional<double>& from) noexcept { parts_->stage.inside().obey(from); }
void Picture::set_colour(ColourKind kind) noexcept { parts_->stage.options().colour = kind; }
ViewModel& Picture::model() noexcept { return parts_->model; }
const ViewModel& Picture::model() const noexcept { return parts_->model; }

}  // namespace palpate::render
