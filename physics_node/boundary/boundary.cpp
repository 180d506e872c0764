#include "physics_node/boundary/boundary.h"

#include <algorithm>

namespace palpate::physics {

Boundary::Boundary(const BodyModel& moving, double bucket_size)
    : surface_(make_surface(moving, std::nullopt, 0)), bucket_size_(bucket_size) {
  Vec3 high = Vec3::Zero();
  if (!surface_.rest.empty()) low_ = high = surface_.rest.front();
  for (const Vec3& p : surface_.rest) low_ = low_.cwiseMin(p), high = high.cwiseMax(p);
  // No more buckets than this many each way: a tiny bucket in a huge body would cost memory for nothing.
  bucket_size_ = std::max(bucket_size_, (high - low_).maxCoeff() / 200);
  n_buckets_ = ((high - low_) / bucket_size_).array().floor().cast<int>() + 1;

  std::vector<std::pair<std::size_t, std::uint32_t>> rigid;
  for (std::uint32_t f = 0; f < surface_.facets.size(); ++f) {
    const auto& corners = surface_.facets[f];
    const bool moves =
        std::any_of(corners.begin(), corners.end(), [&](auto c) { return c < surface_.n_moving(); });
    if (moves) {
      moving_facets_.push_back(f);
    } else {
      rigid.emplace_back(bucket_of(centroid(f, moving)), f);
    }
  }
  std::sort(rigid.begin(), rigid.end());
  bucket_start_.assign(static_cast<std::size_t>(n_buckets_.prod()) + 1, 0);
  for (const auto& [bucket, facet] : rigid) {
    ++bucket_start_[bucket + 1];
    bucket_facets_.push_back(facet);
  }
  for (std::size_t b = 1; b < bucket_start_.size(); ++b) bucket_start_[b] += bucket_start_[b - 1];
}

std::size_t Boundary::bucket_of(const Vec3& p) const {
  const Vec3i at = ((p - low_) / bucket_size_).array().floor().cast<int>().max(0).min(n_buckets_.array() - 1);
  return static_cast<std::size_t>(at.x() + n_buckets_.x() * (at.y() + n_buckets_.y() * at.z()));
}

void Boundary::facets_near(const Vec3& p, double radius, const NodeMotion& moving,
                                 std::vector<std::uint32_t>& out) const {
  const auto take = [&](std::uint32_t facet) {
    if ((centroid(facet, moving) - p).squaredNorm() <= radius * radius) out.push_back(facet);
  };
  for (const std::uint32_t facet : moving_facets_) take(facet);
  if (bucket_facets_.empty()) return;
  const Vec3 reach = Vec3::Constant(radius);
  const Eigen::Array3i lo = ((p - reach - low_) / bucket_size_).array().floor().cast<int>().max(0);
  const Eigen::Array3i hi =
      ((p + reach - low_) / bucket_size_).array().floor().cast<int>().min(n_buckets_.array() - 1);
  for (int z = lo.z(); z <= hi.z(); ++z)
    for (int y = lo.y(); y <= hi.y(); ++y)
      for (int x = lo.x(); x <= hi.x(); ++x) {
        const auto b = static_cast<std::size_t>(x + n_buckets_.x() * (y + n_buckets_.y() * z));
        for (std::uint32_t n = bucket_start_[b]; n < bucket_start_[b + 1]; ++n) take(bucket_facets_[n]);
      }
}

Vec3 Boundary::centroid(std::uint32_t facet, const NodeMotion& moving) const {
  const auto& c = surface_.facets[facet];
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 0; n < 4; ++n) sum += surface_.position(c[n], moving);
  return sum / 4;
}

Vec3 Boundary::rest_centroid(std::uint32_t facet) const {
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t corner : surface_.facets[facet]) sum += surface_.rest[corner];
  return sum / 4;
}

Vec3 Boundary::rest_area(std::uint32_t facet) const {
  const auto& c = surface_.facets[facet];
  return 0.5 * (surface_.rest[c[2]] - surface_.rest[c[0]]).cross(surface_.rest[c[3]] - surface_.rest[c[1]]);
}

Boundary::CentroidAndArea Boundary::centroid_and_area(std::uint32_t facet,
                                                                  const NodeMotion& moving) const {
  const auto& c = surface_.facets[facet];
  const Vec3 p0 = surface_.position(c[0], moving);
  const Vec3 p1 = surface_.position(c[1], moving);
  const Vec3 p2 = surface_.position(c[2], moving);
  const Vec3 p3 = surface_.position(c[3], moving);
  return {0.25 * (p0 + p1 + p2 + p3), 0.5 * (p2 - p0).cross(p3 - p1)};
}

}  // namespace palpate::physics
