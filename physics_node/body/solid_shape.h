#pragma once
// The shapes that are built from numbers, each in its own frame: a sphere, box or tube round its centre, a knife or needle
// with its tip in the origin (common/scene/scene.h says which way they point).

#include "common/math/vec3.h"
#include "common/scene/body_spec.h"

namespace palpate::physics {

/// A point meant to lie on a surface is inside [m].
inline constexpr double on_surface = 1e-9;

struct Bounds {
  Vec3 lo = Vec3::Zero(), hi = Vec3::Zero();
};

/// A box round the shape in its own frame. The body's shape must be none of an image.
Bounds bounds_of(const BodySpec& body);

/// Does the shape hold p of its own frame, with `slack` at its surface? The layers of a wall take more than one look and are
/// left to the builders.
bool holds(const BodySpec& body, const Vec3& p, double slack);

/// Is p across the outer wall of a tube or needle, seen along its axis?
bool beyond_outer_wall(const BodySpec& body, const Vec3& p);

/// Layers of its wall, counted from the outside in, where the scene or the shape says how many there are.
std::optional<int> wall_layers_of(const BodySpec& body);

/// p in the world.
bool holds(const BoxRegion& box, const Vec3& p);
bool holds(const BallRegion& ball, const Vec3& p);

/// Takes material away where the cavities of a body are.
class Carver {
 public:
  explicit Carver(const BodySpec& body) : body_(body), used_(body.cavities.size(), false) {}
  /// Is the material at p of the world gone?
  bool takes(const Vec3& p);
  /// @throws InputError: a cavity that took nothing of all that was asked for
  void refuse_unused() const;

 private:
  const BodySpec& body_;
  std::vector<bool> used_;
};

}  // namespace palpate::physics
