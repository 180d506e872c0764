#pragma once
// Bodies of finite elements that are hard for multigrid, each in its own way.

#include <optional>

#include "common/scene/shape_spec.h"
#include "physics_node/body/body.h"

namespace palpate::bench {

/// cube; lump: a ball inside it is 100 times as stiff; blob: three ellipsoids that run into each other on a held plate; tube: both ends
/// held, off the coarse lattice; slit: three quarters of the cube are open, one cell wide; image: the tissue of a volume.
enum class SolidShape { cube, lump, blob, tube, slit, image };
inline constexpr const char* solid_shape_names[] = {"cube", "lump", "blob", "tube", "slit", "image"};

struct SolidKind {
  SolidShape shape = SolidShape::cube;
  int cells = 32;  // along a side; of an image as it is stored
  double modulus = 100e3;
  double poisson_ratio = 0.45;
  double edge = 0.0025;                // [m]; of an image its own
  std::optional<VolumeShape> image{};  // its largest part
};

/// The bottom is held. @throws InputError if an image cannot be read
physics::Body make_solid(const SolidKind& kind);
/// Cells that are there.
physics::Index n_cells_of(const physics::Body& body);

}  // namespace palpate::bench
