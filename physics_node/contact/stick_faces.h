#pragma once
// The faces of one body that a stick meets: between masses, where it would slip through.

#include <vector>

#include "physics_node/contact/contact_surface.h"
#include "physics_node/contact/led_tool.h"
#include "physics_node/contact/stick.h"

namespace palpate::physics {

/// A triangle of the surface under the capsule: what point of it meets which point of the axis, and by how much it has to give way.
struct FaceHit {
  bool hit = false;
  Vec3 weight = Vec3::Zero();  // barycentric, of the point of the triangle
  double t = 0;                // of the point of the axis
  Vec3 push = Vec3::UnitZ();   // where tissue gives way to, unit
  double depth = 0;            // [m]
};

/// A triangle meets a stick that comes from outside: the nearer of axis and triangle, pushed to the radius. An axis that has come
/// through by less than the radius is still seen as coming from outside. Exact for one triangle; a stick must move by less than its
/// radius in a step.
/// @param x  corners, anticlockwise from outside
FaceHit meet(const Stick& stick, const std::array<Vec3, 3>& x) noexcept;

/// Pushes faces out of the way of a stick, after it has pushed masses. Faces at which elements have broken are left to the masses:
/// what was the surface there is no more. Held corners stay.
///   J = depth / (dt W),   W = sum w_i^2 / m_i,   dv_i = J w_i / m_i
class StickFaces {
 public:
  /// @param surface, model  outlive it
  StickFaces(const ContactSurface& surface, BodyModel& model);

  /// Lists the faces within `reach` of the axis. Contract: allocates nothing.
  void list(const Stick& stick, double reach) noexcept;
  std::size_t size() const noexcept { return near_.size(); }
  /// A step of dt in which the stick went from `before` to `now`, after the elements have moved everything.
  /// @param sum  takes the impulses on the stick, about `origin`; @param contacts  counts the faces
  LeadWork lead(const Stick& before, const Stick& now, const Vec3& origin, double dt, ContactSum& sum,
                std::uint32_t& contacts) noexcept;

 private:
  bool is_whole(std::uint32_t facet) const noexcept;
  LeadWork give_way(const std::array<std::uint32_t, 3>& corner, const FaceHit& hit, const Stick& before,
                    const Stick& now, const Vec3& origin, double dt, ContactSum& sum) noexcept;

  const ContactSurface* surface_;
  BodyModel* model_;
  std::vector<std::uint32_t> near_;
};

}  // namespace palpate::physics
