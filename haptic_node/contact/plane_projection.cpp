#include "haptic_node/contact/plane_projection.h"

#include <Eigen/LU>
#include <algorithm>

namespace palpate::haptic {
namespace {

constexpr double feasible_tolerance = 1e-13;                   // [m]
constexpr double clear_determinant = 1e-4, clear_pull = 1e-6;  // rounding is far below, so well-conditioned
constexpr double rank_tolerance = 1e-12;  // of det(N^T N), between 0 and 1 for unit normals

/// What the active sets share: n_i . n_j and the depth of x below plane i.
struct Products {
  std::array<std::array<double, max_planes>, max_planes> gram{};
  std::array<double, max_planes> depth{};

  Products(std::span<const HalfSpace> planes, const Vec3& x) noexcept {
    for (std::size_t i = 0; i < planes.size(); ++i) {
      depth[i] = planes[i].normal.dot(planes[i].point - x);
      for (std::size_t j = 0; j <= i; ++j) gram[i][j] = gram[j][i] = planes[i].normal.dot(planes[j].normal);
    }
  }
};

/// Whether two or three planes are surely no active set: one of them pulls, clearly. By Cramer's rule the signs of lambda
/// are those of the numerators alone, and most sets of a search end here.
bool surely_pulls(double determinant, double a, double b, double c) noexcept {
  const double most = std::max({std::abs(a), std::abs(b), std::abs(c)});
  return determinant > clear_determinant && std::min({a, b, c}) < -clear_pull * most;
}
bool pair_pulls(const Products& of, std::size_t i, std::size_t j) noexcept {
  const double g = of.gram[i][j], a = of.depth[i], b = of.depth[j];
  const double first = a - g * b, second = b - g * a;
  return surely_pulls(1 - g * g, first, second, std::max(first, second));
}
bool triple_pulls(const Products& of, std::size_t i, std::size_t j, std::size_t k) noexcept {
  const double p = of.gram[i][j], q = of.gram[i][k], r = of.gram[j][k];
  const double a = of.depth[i], b = of.depth[j], c = of.depth[k];
  const double pq_r = q * r - p, pr_q = p * r - q, pq = p * q - r;  // cofactors beside the diagonal
  const double determinant = 1 + 2 * p * q * r - p * p - q * q - r * r;
  return surely_pulls(determinant, (1 - r * r) * a + pq_r * b + pr_q * c, pq_r * a + (1 - q * q) * b + pq * c,
                      pr_q * a + pq * b + (1 - p * p) * c);
}

/// Tries the `Count` planes in `index` as the active set: lambda = (N^T N)^-1 d.
template <int Count>
bool try_active(std::span<const HalfSpace> planes, const Products& of,
                const std::array<std::size_t, 3>& index, const Vec3& x, Projection& result) noexcept {
  Eigen::Matrix<double, Count, Count> gram;
  Eigen::Matrix<double, Count, 1> depth;
  for (int i = 0; i < Count; ++i) {
    const std::size_t a = index[static_cast<std::size_t>(i)];
    depth(i) = of.depth[a];
    for (int j = 0; j < Count; ++j) gram(i, j) = of.gram[a][index[static_cast<std::size_t>(j)]];
  }
  Eigen::Matrix<double, Count, Count> inverse;
  double determinant = 0;
  bool independent = false;
  gram.computeInverseAndDetWithCheck(inverse, determinant, independent, rank_tolerance);
  if (!independent || !(determinant > 0)) return false;
  Eigen::Matrix<double, Count, 1> lambda = inverse * depth;
  Eigen::Matrix<double, 3, Count> normals;
  for (int i = 0; i < Count; ++i) normals.col(i) = planes[index[static_cast<std::size_t>(i)]].normal;
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
  const Products products(planes, x);
  for (std::size_t i = 0; i < m; ++i)
    if (try_active<1>(planes, products, {i, 0, 0}, x, result)) return result;
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = i + 1; j < m; ++j)
      if (!pair_pulls(products, i, j) && try_active<2>(planes, products, {i, j, 0}, x, result)) return result;
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = i + 1; j < m; ++j)
      for (std::size_t k = j + 1; k < m; ++k)
        if (!triple_pulls(products, i, j, k) && try_active<3>(planes, products, {i, j, k}, x, result))
          return result;
  result.feasible = false;
  return result;
}

}  // namespace palpate::haptic
