#pragma once
// The faces of one body that a stick meets: between masses, where it would slip through.

#include <vector>

#include "physics_node/boundary/boundary.h"
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

/// Pushes faces out of the way of a stick, after it has pushed masses. They follow what breaks. Held corners stay.
///   J = depth / (dt W),   W = sum w_i^2 / m_i,   dv_i = J w_i / m_i
///
/// A stick that rests on masses needs no faces, and is better off without: on a thick one the masses of a row are carried, and a face
/// beside it, which gives way a little later, would drive that row aside. So faces meet the whole radius of a stick that is thinner than
/// half the spacing, between whose masses it would go, and half the radius of any other, as a last resort.
class StickFaces {
 public:
  /// @param surface, model  outlive it. @param radius  of the stick [m]
  StickFaces(const Boundary& surface, BodyModel& model, double radius);

  /// Lists the faces within `reach` of the axis. Contract: allocates nothing.
  void list(const Stick& stick, double reach) noexcept;
  std::size_t size() const noexcept { return near_.size(); }
  /// Has a facet opened or gone within `reach` since they were listed?
  bool has_changed(const Stick& stick, double reach) const noexcept;
  /// A step of dt in which the stick went from `before` to `now`, after the elements have moved everything.
  /// @param sum  takes the impulses on the stick, about `origin`; @param contacts  counts the faces
  LeadWork lead(const Stick& before, const Stick& now, const Vec3& origin, double dt, ContactSum& sum,
                std::uint32_t& contacts) noexcept;

 private:
  using Corners = std::array<std::size_t, 3>;  // of a facet's four
  LeadWork give_way(std::uint32_t facet, const Corners& corner, const FaceHit& hit, const Stick& before,
                    const Stick& now, const Vec3& origin, double dt, ContactSum& sum) noexcept;

  const Boundary* surface_;
  BodyModel* model_;
  double radius_;  // at which a face gives way [m]
  std::vector<std::uint32_t> near_;
  std::uint64_t listed_revision_ = 0;  // of the surface
};

}  // namespace palpate::physics
