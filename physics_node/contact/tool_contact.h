#pragma once
// What the tissue looks like to a point tool: a smooth plane through the facets around it, and where its force goes.

#include <vector>

#include "common/message/messages.h"
#include "physics_node/body/mass_share.h"
#include "physics_node/boundary/boundary.h"
#include "physics_node/contact/rigid_shape.h"

namespace palpate::physics {

/// A plane fitted to the facets near a point, and the share of each mass in it.
struct LocalPlane {
  bool found = false;
  Vec3 point = Vec3::Zero();    // on the tissue now [m]
  Vec3 normal = Vec3::UnitZ();  // out of the tissue, unit
  // The same weights over the facets where they were before any force (Boundary's settled ones):
  Vec3 rest = Vec3::Zero();         // point [m]
  Vec3 rest_normal = Vec3::Zero();  // unit, or 0 where they face all ways
  double flat = 0;  // |sum w n| / sum w at rest, of all facets, l_f left out: 1 where all face one way
};

class ToolContact {
 public:
  /// Beyond the tip: what a hand at 0.2 m/s covers in 50 ms [m].
  static constexpr double search_margin = 0.010;

  /// @param radius  of the tip: its force fades out smoothly over twice that, and over two cells at least [m]
  /// @param farther  that facets are looked for beyond it [m]
  ToolContact(const Boundary& surface, const NodeMotion& moving, double radius, double farther = 0);

  /// Looks for facets around `p`; keeps what it found until the tool or the tissue may have left it, or one has opened nearby.
  void look(const Vec3& p, double t) noexcept;

  /// The plane under p:
  ///   w_f = A_f l_f (1 - |c_f - q|^2 / R^2)^2,   point = sum w c / sum w,   normal = sum w n / |sum w n|
  /// q begins at the facet nearest to p and follows the projection of p onto the plane. Facets that face away from
  /// the nearest one do not count; l_f is 1, or what nearest_to() says. Source: Adamson & Alexa 2003 (point set surfaces from weighted averages);
  /// R is twice the tip's radius, so the plane is smooth although voxel facets are steps.
  LocalPlane plane_under(const Vec3& p) const noexcept;

  /// Finds the masses that carry the plane under q and their shares: the weights of the plane's point, so that a force
  /// does the same work on the point as its shares do on the masses. What is missing to 1 lies on scenery.
  void find_shares(const Vec3& q) noexcept;
  /// Of a force on the plane, what the masses behind it take, in storage order.
  const std::vector<MassShare>& shares() const { return shares_; }

  /// Distance from p to the nearest facet's centroid; infinite where none is near [m].
  double nearest_distance(const Vec3& p) const noexcept;
  double reach() const { return radius_; }  // R [m]
  struct Nearest {
    double distance = 0;           // infinite where none is near [m]
    Vec3 point = Vec3::Zero();     // centroid of the facet [m]
    Vec3 on_shape = Vec3::Zero();  // nearest to that [m]
  };
  /// The facet that is nearest to a shape, of those that look at it. Until the next look() each facet counts in planes and shares as
  /// far as it looks at the shape: the sides of a block do not lean the plane under a plate that is wider than the block.
  /// @param origin, axes  of the shape
  Nearest nearest_to(const RigidShape& shape, const Vec3& origin, const Eigen::Matrix3d& axes) noexcept;
  /// Appends the facets of the last look whose centroid lies within `radius` of p, up to the room that `out` has.
  void facets_within(const Vec3& p, double radius, std::vector<std::uint32_t>& out) const noexcept;

  /// Writes the facets nearest to p, each with its own plane, nearest first.
  /// @param at_rest  the planes' points and normals at rest instead of now
  /// @return how many triangles
  std::uint32_t write_facets(const Vec3& p, std::uint32_t body, PatchFacet* out, std::uint32_t room,
                             bool at_rest) noexcept;

  /// Hash of the facets that write_facets named last: the contact set.
  std::uint64_t contact_set() const { return contact_set_; }

 private:
  struct Facet {
    std::uint32_t id;
    Vec3 centroid, normal;
    Vec3 rest, rest_normal;  // the same before any force
    double area;
    std::array<std::uint32_t, 4> corner;  // of corners_
    double looks = 1;                     // cosine between it and what it looks at
  };
  /// One that the last search found.
  struct Near {
    std::uint32_t id;
    std::array<std::uint32_t, 4> corner;  // of corners_
    Vec3 rest, rest_normal;
  };
  /// A corner of facets.
  struct Corner {
    std::int64_t number = 0;  // Boundary::corner()
    std::uint32_t facet = 0, of_facet = 0;
    Vec3 place = Vec3::Zero();  // now [m]
    double weight = 0;          // of a plane
  };
  void search(const Vec3& p) noexcept;
  void keep_nearest(const Vec3& p) noexcept;
  double weight(const Facet& facet, const Vec3& q, const Vec3& facing) const noexcept;
  LocalPlane plane_at(const Vec3& q, const Vec3& facing) const noexcept;
  const Facet* nearest(const Vec3& p) const noexcept;

  const Boundary& surface_;
  const NodeMotion& moving_;
  double radius_;  // R [m]
  double reach_;   // facets within this distance are kept [m]
  Vec3 searched_at_ = Vec3::Constant(1e9);
  double searched_when_ = -1e9;
  std::uint64_t searched_revision_ = 0;  // of the boundary
  std::vector<std::uint32_t> found_;
  std::vector<Near> near_;                                     // of found_
  std::vector<Corner> corners_;                                // of near_, by number
  std::vector<std::pair<std::int64_t, std::uint32_t>> order_;  // to find equal corners
  std::vector<Facet> facets_;                                  // of near_, as they are now
  std::vector<MassShare> shares_;
  std::uint64_t contact_set_ = 0;
};

}  // namespace palpate::physics
