#include "haptic_node/contact/plane_projection.h"

#include <Eigen/LU>
#include <algorithm>

namespace palpate::haptic {
namespace {

constexpr double feasible_tolerance = 1e-13;  // [m]
constexpr double rank_tolerance = 1e-12;      // of det(N^T N), between 0 and 1 for unit normals

/// Tries the `Count` planes in `index` as the active set: lambda = (N^T N)^-1 d, d_i the depth of x below plane i.
template <int Count>
bool try_active(std::span<const HalfSpace> planes, const std::array<std::size_t, 3>& index, const Vec3& x,
                Projection& result) noexcept {
  Eigen::Matrix<double, 3, Count> normals;
  Eigen::Matrix<double, Count, 1> depth;
  for (int i = 0; i < Count; ++i) {
    const HalfSpace& plane = planes[index[static_cast<std::size_t>(i)]];
    normals.col(i) = plane.normal;
    depth(i) = plane.normal.dot(plane.point - x);
  }
  const Eigen::Matrix<double, Count, Count> gram = normals.transpose() * normals;
  if (!(gram.determinant() > rank_tolerance)) return false;
  const Eigen::Matrix<double, Count, Count> inverse = gram.inverse();
  Eigen::Matrix<double, Count, 1> lambda = inverse * depth;
  lambda +=
      inverse * (depth - normals.transpose() * (normals * lambda));  // one refinement: N^T N squares errors
  if (!(lambda.minCoeff() >= 0)) return false;
  const Vec3 p = x + normals * lambda;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const bool active = std::find(index.begin(), index.begin() + Count, i) != index.begin() + Count;
    if (!active && !(planes[i].normal.dot(p - planes[i].point) >= -feasible_tolerance)) return false;
  }
  result.point = p;
  for (int i = 0; i < Count; ++i) result.push[index[static_cast<std::size_t>(i)]] = lambda(i);
  return true;
}

bool is_free(std::span<const HalfSpace> planes, const Vec3& x) noexcept {
  for (const HalfSpace& plane : planes)
    if (!(plane.normal.dot(x - plane.point) >= 0)) return false;
  return true;
}

}  // namespace

Projection project_out(std::span<const HalfSpace> planes, const Vec3& x) noexcept {
  Projection result;
  result.point = x;
  if (is_free(planes, x)) return result;
  const std::size_t m = planes.size();
  for (std::size_t i = 0; i < m; ++i)
    if (try_active<1>(planes, {i, 0, 0}, x, result)) return result;
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = i + 1; j < m; ++j)
      if (try_active<2>(planes, {i, j, 0}, x, result)) return result;
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = i + 1; j < m; ++j)
      for (std::size_t k = j + 1; k < m; ++k)
        if (try_active<3>(planes, {i, j, k}, x, result)) return result;
  result.feasible = false;
  return result;
}

}  // namespace palpate::haptic
