#include "render_node/ui/stage.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "render_node/ui/captions.h"
#include "render_node/ui/help.h"
#include "render_node/ui/measures.h"
#include "render_node/ui/notices.h"

namespace palpate::render {

Stage::Stage(const Scene& scene, ViewModel& model, int height, int samples)
    : scene_(scene),
      model_(model),
      camera_(scene.render->camera),
      options_{scene.render->show_tool,
               scene.render->show_force,
               scene.render->show_wire,
               scene.render->show_fragments,
               scene.render->colour,
               scene.render->section,
               scene.render->inside.has_value(),
               static_cast<float>(scene.render->opacity),
               {}},
      threshold_(scene),
      section_(scene),
      inside_(scene),
      painter_(scene, model, samples),
      imgui_(height) {}

PanelWishes Stage::draw(const PanelFacts& facts, int width, int height, float seconds) {
  const bool panels = scene_.render->show_panels;
  const float scale = imgui_.fit(height);
  const float left = panels && !facts.folded ? panel_width_in(static_cast<float>(width), scale) : 0;
  camera_.set_picture(width, height, static_cast<int>(std::lround(left)));
  camera_.fit(box_with_floor());
  options_.section = section_in(model_.box());
  options_.inside = inside_.value().has_value();
  options_.opacity = static_cast<float>(inside_.opacity());
  painter_.draw(model_, camera_, options_, width, height);
  const bool coloured = options_.colour != ColourKind::own;
  if (!panels && !facts.interactive && !coloured) return {};
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  io.DeltaTime = seconds;
  ImGui::NewFrame();
  PanelFacts shown = facts;
  shown.arrow_metres_per_newton = options_.force ? painter_.arrow_metres_per_newton() : 0;
  PanelWishes wishes;
  if (panels)
    wishes = facts.folded ? lay_out_folded()
                          : lay_out_panels(scene_, model_, shown,
                                           {threshold_, section_, inside_, options_.hidden}, scale);
  if (model_.anything_to_see()) {
    lay_out_measures(camera_, left, scale);
    if (coloured) lay_out_legend(painter_.colour_scale(), scale);
  }
  if (facts.interactive) lay_out_hindrances(hindrances(scene_, model_, facts.paused, facts.pointer), left);
  lay_out_words(facts.words, left);
  if (facts.help && lay_out_help(facts.pointer != nullptr, scale)) wishes.actions.push_back(Action::help);
  ImGui::Render();
  panels_.draw();
  return wishes;
}

/// Beside all bodies a plane cuts nothing, and would only take them away.
std::optional<SectionSpec> Stage::section_in(const Eigen::AlignedBox3d& box) const {
  const auto& section = section_.value();
  if (!section || box.isEmpty()) return section;
  const double at = section->at;
  if (at < box.min()[section->axis] || at > box.max()[section->axis]) return std::nullopt;
  return section;
}

Eigen::AlignedBox3d Stage::box_with_floor() const {
  Eigen::AlignedBox3d box = model_.box();
  if (scene_.floor && !box.isEmpty())
    box.extend(Vec3(box.center().x(), box.center().y(), std::min(box.min().z(), scene_.floor->height)));
  return box;
}

}  // namespace palpate::render
