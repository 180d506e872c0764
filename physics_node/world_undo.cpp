// What begins anew: after a reset, or when the last stroke of a blade is undone.

#include <algorithm>

#include "common/scene/tool_spec.h"
#include "physics_node/world.h"

namespace palpate::physics {
namespace {

// Without anything at a blade [s]. Why: between the walls of a bag, and where tissue jumps from it, there is nothing for a while.
constexpr double stroke_is_over = 0.2;

}  // namespace

/// Before the first cut of a stroke. Cost: a copy of what moves, once a stroke.
void World::begin_stroke() noexcept {
  if (in_stroke_) return;
  in_stroke_ = can_undo_ = true;
  ++report_.strokes;
  for (auto& body : bodies_) body->mark();
  for (auto& connection : connections_) connection->mark();
  // Before the first cut of a stroke the edge has gone on already, and has been booked for it.
  books_before_ = books_between_;
}

void World::follow_strokes() noexcept {
  unmet_ += frame_dt_;
  for (std::size_t n = 0; n < scene_.tools.size(); ++n)
    if (cuts(scene_.tools[n]) && toolbox_.tools[n]->contacts() > 0) unmet_ = 0;
  in_stroke_ = in_stroke_ && unmet_ < stroke_is_over;
  if (!in_stroke_ && unmet_ > 0) note_books(books_between_);
}

void World::note_books(std::vector<TouchBook>& books) const noexcept {
  for (std::size_t n = 0; n < books.size(); ++n) books[n] = toolbox_.tools[n]->book();
}

bool World::undo() noexcept {
  if (!can_undo_ || has_stopped()) return false;
  for (auto& body : bodies_) body->return_to_mark();
  for (auto& connection : connections_) connection->return_to_mark();
  for (std::size_t n = 0; n < books_before_.size(); ++n) {
    toolbox_.tools[n]->reset();
    toolbox_.tools[n]->book() = books_before_[n];
    toolbox_.tools[n]->book().lose_hand();
  }
  ++report_.undone;
  held_substeps_ = held_until_ = 0;
  start_anew();
  return true;
}

void World::start_anew() noexcept {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (fragments_[b]) fragments_[b]->update(*bodies_[b]);
    touchable_[b].surface->follow();
  }
  strides_.restart();
  if (collisions_) collisions_->restart();
  if (inside_) inside_->restart();
  stiffening_ = 1;
  pressed_ = pressed_before_ = false;
  in_stroke_ = can_undo_ = false;
  note_books(books_between_);
  restart_ledger();
}

}  // namespace palpate::physics
