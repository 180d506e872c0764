// The part of a frame that tools have which press with forces.

#include <algorithm>
#include <cmath>

#include "physics_node/world.h"

namespace palpate::physics {
namespace {

/// visit(body, forces) of each of so many bodies that it presses.
template <class Visit>
void each_pressed(const PressingTool& tool, std::size_t n_bodies, const Visit& visit) {
  for (std::size_t b = 0; tool.presses() && b < n_bodies; ++b)
    if (const auto forces = tool.forces_on(b); !forces.empty()) visit(b, forces);
}

}  // namespace

bool World::is_pressed() const noexcept {
  return std::any_of(toolbox_.pressing.begin(), toolbox_.pressing.end(),
                     [](const PressingTool* tool) { return tool->may_press(); });
}

void World::gather() noexcept {
  for (auto& forces : gathered_) forces.clear();
  for (const PressingTool* tool : toolbox_.pressing)
    if (!tool->follows_steps())
      each_pressed(*tool, bodies_.size(), [this](std::size_t b, std::span<const NodalForce> forces) {
        gathered_[b].insert(gathered_[b].end(), forces.begin(), forces.end());
      });
}

/// Of the forces of a tool, with velocities now [W].
double World::power(const PressingTool& tool) const noexcept {
  double sum = 0;
  each_pressed(tool, bodies_.size(),
               [&](std::size_t b, std::span<const NodalForce> forces) { sum += bodies_[b]->power(forces); });
  for (std::size_t c = 0; c < connections_.size(); ++c) sum += connections_[c]->power(tool.pushes(c));
  return sum;
}

/// Of the forces of tools that press, where no step has solved for them.
/// @param begun  false: of those alone that are known before a step
/// @return work in half a step of dt [J]
double World::book_tools(double dt, bool begun) noexcept {
  double sum = 0;
  if (is_implicit()) return sum;
  for (PressingTool* tool : toolbox_.pressing) {
    if (!begun && tool->follows_steps()) continue;
    sum += tool->book().tissue(0.5 * dt * power(*tool));
  }
  return sum;
}

/// The step has solved for them: a force works along all of the way that the velocities at its end make.
void World::book_solved(double dt) noexcept {
  for (PressingTool* tool : toolbox_.pressing)
    each_pressed(*tool, bodies_.size(), [&](std::size_t b, std::span<const NodalForce> forces) {
      tool->book().tissue(dt * bodies_[b]->power(forces));
    });
}

/// Once the tool's forces have moved the masses on: the books of what is cut are of where they are.
/// @return what the hand pays [J]
double World::cut(PressingTool& tool) noexcept {
  bool cuts_strands = false;
  for (std::size_t c = 0; c < connections_.size(); ++c)
    cuts_strands = cuts_strands ||
                   std::ranges::any_of(tool.pushes(c), [](const StrandPush& push) { return push.cuts > 0; });
  if (cuts_strands || !tool.cuts().empty()) begin_stroke();
  if (!tool.cuts().empty()) {
    BodyModel& body = *bodies_[tool.touched_body()];
    const Losses before = body.losses();
    report_.broken += body.cut(tool.cuts());
    const Losses lost = body.losses() - before;
    cut_since_ += lost;
    tool.take_released(lost.broken);
  }
  for (std::size_t c = 0; c < connections_.size(); ++c)
    cut_since_.broken += connections_[c]->cut(tool.pushes(c));
  const CutWork work = tool.cut_work();
  if (!std::isfinite(work.hand) || !std::isfinite(work.released)) return work.hand;
  report_.cut += work.hand + work.released;
  report_.cut_by_released += work.released;
  return tool.book().tissue(work.hand);
}

/// Tools that follow steps: their forces act in the step just integrated, and cut at its end.
/// @return work in the first half of it, and for cuts [J]
double World::press(double dt) noexcept {
  double sum = 0;
  for (PressingTool* tool : toolbox_.pressing) {
    if (!tool->follows_steps()) continue;
    const StageTimer timer(report_, Stage::contact_forces);
    sum += tool->book().tissue(0.5 * dt * tool->press(dt));
    each_pressed(*tool, bodies_.size(),
                 [&](std::size_t b, std::span<const NodalForce> forces) { bodies_[b]->kick(forces, dt); });
    for (std::size_t c = 0; c < connections_.size(); ++c) connections_[c]->kick(tool->pushes(c), dt);
    sum += cut(*tool);
  }
  return sum;
}

}  // namespace palpate::physics
