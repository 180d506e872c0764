#pragma once
// The facets that a tool can touch, found near a point.

#include <vector>

#include "physics_node/step/body_model.h"
#include "physics_node/boundary/surface.h"

namespace palpate::physics {

/// The whole tissue surface of a body with what is needed to find facets near a point. Scenery is found through a
/// grid of buckets; moving facets are looked through one by one, and the caller keeps what it found for a while.
class Boundary {
 public:
  Boundary(const BodyModel& moving, double bucket_size);

  const Surface& surface() const { return surface_; }
  double bucket_size() const { return bucket_size_; }

  /// Appends the facets whose centroid lies within `radius` of `p` now. Allocates only while `out` grows.
  void facets_near(const Vec3& p, double radius, const NodeMotion& moving,
                   std::vector<std::uint32_t>& out) const;

  Vec3 centroid(std::uint32_t facet, const NodeMotion& moving) const;
  Vec3 rest_centroid(std::uint32_t facet) const;
  Vec3 rest_area(std::uint32_t facet) const;  // as below [m^2]
  /// The centroid and, half the cross product of the diagonals, the normal times the area [m^2].
  struct CentroidAndArea {
    Vec3 centroid, area;
  };
  CentroidAndArea centroid_and_area(std::uint32_t facet, const NodeMotion& moving) const;

 private:
  std::size_t bucket_of(const Vec3& p) const;

  Surface surface_;
  double bucket_size_;
  Vec3 low_ = Vec3::Zero();
  Vec3i n_buckets_ = Vec3i::Ones();
  std::vector<std::uint32_t> moving_facets_;  // at least one corner moves
  std::vector<std::uint32_t> bucket_start_;   // facets of bucket b: bucket_facets_[start[b] .. start[b + 1])
  std::vector<std::uint32_t> bucket_facets_;
};

}  // namespace palpate::physics
