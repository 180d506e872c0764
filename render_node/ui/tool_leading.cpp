#include "render_node/ui/tool_leading.h"

#include <algorithm>

#include "common/scene/body_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "render_node/ui/bindings.h"

namespace palpate::render {
namespace {

/// How far before a surface a tool starts, besides what the surface's own steps ask for [m]. A point has no extent to
/// the hand.
double clearance(const ToolSpec& tool) { return tool.shape == ToolShape::stick ? tool.radius : 0.0; }

/// From how far before the surface it comes down: a ball that has lain in tissue has to be outside of it with all its
/// girth.
double lift_of(const ToolSpec& tool) { return 2 * tool.radius; }

}  // namespace

void ToolLeading::lay_out(const Camera& camera) {
  if (pointed_.empty() || !pointers_.empty() || !model_.anything_to_see()) return;
  const auto box = model_.box();
  const Vec3 before = box.center() + 0.5 * box.diagonal().norm() * camera.axes().row(2).transpose();
  const auto middle = camera.project(camera.target());
  touch_.keep(tissue(), {});
  for (const std::uint32_t tool : pointed_) {
    const auto surface = middle ? touch_.under(camera, *middle, clearance(scene_.tools[tool])) : std::nullopt;
    const auto body = std::find_if(scene_.bodies.begin(), scene_.bodies.end(), [&](const BodySpec& spec) {
      return spec.name == scene_.tools[tool].body;
    });
    pointers_.emplace_back(tool, body == scene_.bodies.end() ? surface.value_or(before) : body->at);
  }
}

/// What a tool is laid on: bodies, and not the strands between them.
std::span<const BodyPicture> ToolLeading::tissue() const {
  return std::span(model_.bodies()).first(scene_.bodies.size());
}

/// A tool that is a body starts where it lies and keeps to a plane: to jump would tear what it is in.
bool ToolLeading::keeps_to_surface() const {
  return scene_.tools[pointers_[led_].tool()].shape != ToolShape::body;
}

PointerInput ToolLeading::input_from(const HandEvents& events, const CursorNow& cursor, const Camera& camera,
                                     const SeenBodies& seen, double seconds) {
  const auto key = [&](Action action) {
    return cursor.typing ? 0.0 : held(events, action, seconds) / seconds;
  };
  PointerInput input;
  input.cursor = cursor.pixel;
  input.follows = cursor.in_picture && !cursor.drags;
  input.wheel = cursor.in_picture ? cursor.wheel : 0.0;
  input.fine = cursor.fine;
  input.turn = {key(Action::turn_down) - key(Action::turn_up),
                key(Action::turn_right) - key(Action::turn_left),
                key(Action::roll_left) - key(Action::roll_right)};
  input.toggle = !cursor.typing && presses(events, Action::toggle_tool) % 2 == 1;
  input.buttons = !cursor.typing && down(events, Action::button) ? 1u : 0u;
  input.place = cursor.in_picture && events.click(0).has_value();
  input.lift = lift_of(scene_.tools[pointers_[led_].tool()]);
  input.let_go = cursor.in_picture && events.click(1).has_value();
  if (!keeps_to_surface()) {
    input.toggle =
        input.toggle != (input.place && !pointers_[led_].held());  // a click takes it where it lies
    return input;
  }
  const bool taken = input.place || (input.toggle && !pointers_[led_].held());
  if (taken) {
    touch_.keep(tissue(), seen.hidden.bodies, seen.cut);
    if (seen.cut) touch_.keep_sections(model_.sections());
  }
  if (cursor.in_picture)
    input.surface = [&](const Eigen::Vector2d& pixel) {
      return touch_.under(camera, pixel, clearance(scene_.tools[pointers_[led_].tool()]));
    };
  return input;
}

void ToolLeading::lead(const HandEvents& events, const CursorNow& cursor, const Camera& camera,
                       const SeenBodies& seen, double seconds) {
  if (pointers_.empty()) return;
  for (int n = cursor.typing ? 0 : presses(events, Action::next_tool); n > 0; --n) {
    pointers_[led_].let_go();
    led_ = (led_ + 1) % pointers_.size();
  }
  const PointerInput input = input_from(events, cursor, camera, seen, seconds);
  pointers_[led_].follow(input, camera, seconds);
}

}  // namespace palpate::render
