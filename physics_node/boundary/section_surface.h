#pragma once
// What a plane across an axis shows of a body of cells where it cuts it open: of each cell that it goes through a
// square, in the grey of its intensity. The squares lie in the body at rest and move with it.

#include "common/scene/section_spec.h"
#include "physics_node/boundary/live_elements.h"
#include "physics_node/boundary/surface.h"

namespace palpate::physics {

/// Intensities that are shown black and white; between them brightness goes by the root.
struct GreyScale {
  double black = 0, white = 1;
};
/// All but a fiftieth at each end of what the body is filled with. Cost: a look at 100,000 cells at most.
GreyScale grey_scale_of(const Cells& cells);

/// Where a skin is smooth the outline of the section is, too. Empty where the plane misses the body.
/// @param body  of voxels  @param rgba  of one without an image: its section is a little darker
/// Cost: the cells of one layer.
Surface section_surface(const Body& body, const LiveElements& live, const SectionSpec& section,
                        const GreyScale& grey, std::uint32_t rgba);

}  // namespace palpate::physics
