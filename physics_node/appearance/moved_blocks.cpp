#include "physics_node/appearance/moved_blocks.h"

#include <algorithm>
#include <cmath>

namespace palpate::physics {
namespace {

constexpr Array3f nowhere{NAN, NAN, NAN};

std::uint8_t vertex_flags(const Condition& condition) {
  unsigned flags = (condition.flags & mass_broken) != 0 ? vertex_broken : 0;
  if ((condition.flags & mass_yielded) != 0) {
    const auto share = static_cast<unsigned>(std::lround(63 * condition.yielded_share));
    flags |= vertex_yielded | share * vertex_share_one;
  }
  return static_cast<std::uint8_t>(flags);
}

}  // namespace

void MovedBlocks::begin(std::size_t n_vertices) {
  sent_.assign(n_vertices, nowhere);
  sent_flags_.assign(n_vertices, 0);
  sent_field_.assign(n_vertices, 0.0F);
  sent_at_rest_.assign(n_vertices / max_block_vertices + 1, 0);
}

void MovedBlocks::grow(const NumberedSurface& surface) {
  for (std::size_t n = sent_.size(); n < surface.n_vertices(); ++n)
    sent_.push_back(float_of(surface.rest(n)));
  sent_flags_.resize(surface.n_vertices(), 0);
  sent_field_.resize(surface.n_vertices(), 0.0F);
  sent_at_rest_.resize(surface.n_vertices() / max_block_vertices + 1, 0);
}

void MovedBlocks::resend() {
  std::fill(sent_.begin(), sent_.end(), nowhere);
  std::fill(sent_at_rest_.begin(), sent_at_rest_.end(), std::uint8_t{0});
}

/// Scenery has no flags and no field.
void MovedBlocks::look_at(const NumberedSurface& surface, const BodyModel& moving, const TissueField* field,
                          std::size_t first, std::size_t last) {
  cells_.clear();
  for (std::size_t n = first; n < last; ++n)
    if (surface.cell(n) >= 0) cells_.push_back(surface.cell(n));
  conditions_.resize(cells_.size());
  moving.conditions(cells_, conditions_);
  flags_.clear();
  auto condition = conditions_.begin();
  for (std::size_t n = first; n < last; ++n)
    flags_.push_back(surface.cell(n) >= 0 ? vertex_flags(*condition++) : std::uint8_t{0});
  field_.assign(last - first, 0.0F);
  field_most_ = 0;
  for (std::size_t n = first; field != nullptr && n < last; ++n) {
    if (surface.cell(n) < 0) continue;
    const double value = std::min(field->at(surface.cell(n)), largest_field);
    field_[n - first] = std::isfinite(value) ? static_cast<float>(value) : 0.0F;
    field_most_ = std::max(field_most_, field_[n - first]);
  }
}

bool MovedBlocks::changed(const NumberedSurface& surface, const BodyModel& moving, std::size_t first,
                          std::size_t last) const {
  for (std::size_t n = first; n < last; ++n) {
    if (flags_[n - first] != sent_flags_[n]) return true;
    if (std::abs(field_[n - first] - sent_field_[n]) > 0.01F * field_most_) return true;
    if (is_seen_to_move(sent_[n], float_of(surface.position(n, moving)))) return true;
  }
  return false;
}

int MovedBlocks::write(const NumberedSurface& surface, const BodyModel& moving, const TissueField* field,
                       VertexBlock& block, const std::function<void(const VertexBlock&)>& sink) {
  if (surface.is_rigid()) return 0;
  int blocks = 0;
  for (std::size_t first = 0; first < surface.n_vertices(); first += max_block_vertices) {
    const std::size_t last = std::min<std::size_t>(first + max_block_vertices, surface.n_vertices());
    if (!surface.may_move(first, last)) continue;
    const bool rests = moving.parts() != nullptr && surface.rests(first, last, *moving.parts());
    std::uint8_t& was_sent = sent_at_rest_[first / max_block_vertices];
    if (rests && was_sent != 0) continue;
    was_sent = rests ? 1 : 0;
    look_at(surface, moving, field, first, last);
    if (!changed(surface, moving, first, last)) continue;
    block.block = static_cast<std::uint32_t>(first / max_block_vertices);
    block.first_vertex = static_cast<std::uint32_t>(first);
    block.n_vertices = static_cast<std::uint32_t>(last - first);
    for (std::size_t n = first; n < last; ++n) {
      block.position[n - first] = sent_[n] = float_of(surface.position(n, moving));
      block.flags[n - first] = sent_flags_[n] = flags_[n - first];
      sent_field_[n] = field_[n - first];
      const float share = field_most_ > 0 ? field_[n - first] / field_most_ : 0.0F;
      block.field[n - first] = static_cast<std::uint8_t>(std::lround(255 * share));
    }
    block.field_most = field_most_;
    sink(block);
    ++blocks;
  }
  return blocks;
}

}  // namespace palpate::physics
