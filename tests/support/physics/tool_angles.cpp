#include "tests/support/physics/tool_angles.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <map>

namespace palpate::physics::test {
namespace {

constexpr double same = 1e-7;  // [m]

std::vector<Vec3> places(const Body& body, const std::vector<Index>& cells) {
  std::vector<Vec3> all;
  for (const Index cell : cells) all.push_back(body.lattice.rest_position(cell));
  return all;
}

Vec3 mean(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// The direction in which the points spread least.
Vec3 thinnest(const std::vector<Vec3>& points) {
  const Vec3 middle = mean(points);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& p : points) spread += (p - middle) * (p - middle).transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
}

/// The points that are lowest along z.
std::vector<Vec3> lowest(const std::vector<Vec3>& points, const Vec3& z) {
  double low = 1e9;
  for (const Vec3& p : points) low = std::min(low, p.dot(z));
  std::vector<Vec3> found;
  for (const Vec3& p : points)
    if (p.dot(z) < low + same) found.push_back(p);
  return found;
}

Eigen::Matrix3d columns(const Vec3& x, const Vec3& y, const Vec3& z) {
  Eigen::Matrix3d R;
  R << x, y, z;
  return R;
}

}  // namespace

MeasuredTool measure_knife(const Body& body) {
  // The whole plate is not the same on both sides of its middle; each of its two sheets is.
  const auto all = places(body, body.lattice.masses), back = places(body, body.handle);
  const Vec3 middle = mean(all), about_y = thinnest(all), up = mean(back) - middle;
  std::array<std::vector<Vec3>, 2> sheet, held;
  for (const Vec3& p : all) sheet[(p - middle).dot(about_y) > 0 ? 1 : 0].push_back(p);
  for (const Vec3& p : back) held[(p - middle).dot(about_y) > 0 ? 1 : 0].push_back(p);
  const auto depth = [&](std::size_t n) { return lowest(sheet[n], up).front().dot(up); };
  const std::size_t first = depth(0) < depth(1) ? 0 : 1;
  Vec3 y = thinnest(sheet[first]);
  if ((mean(sheet[1 - first]) - mean(sheet[first])).dot(y) < 0) y = -y;
  const Vec3 z = (mean(held[first]) - mean(sheet[first])).normalized(), x = y.cross(z);
  return {columns(x, y, z), mean(lowest(lowest(sheet[first], z), x))};
}

MeasuredTool measure_needle(const Body& body) {
  const auto all = places(body, body.lattice.masses);
  const auto hub = places(body, body.handle);
  const Vec3 on_axis = mean(hub), middle = mean(all);
  Vec3 z = thinnest(hub);
  if ((on_axis - middle).dot(z) < 0) z = -z;
  Vec3 x = on_axis - middle;
  x = (x - x.dot(z) * z).normalized();
  MeasuredTool tool{columns(x, z.cross(x), z), mean(lowest(lowest(all, z), x))};

  // Lowest mass of each column, in units of 1e-7 m across the axis.
  std::map<std::pair<long, long>, Eigen::Vector2d> columns_of;
  for (const Vec3& p : all) {
    const Vec3 q = tool.R.transpose() * (p - on_axis);
    const auto [at, added] =
        columns_of.try_emplace({std::lround(q.x() / same), std::lround(q.y() / same)}, q.x(), q.z());
    if (!added) at->second.y() = std::min(at->second.y(), q.z());
  }
  // z = x cot(sharpening) + constant
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const auto& [key, xz] : columns_of) sum += xz;
  const Eigen::Vector2d centre = sum / static_cast<double>(columns_of.size());
  double xx = 0, xz_sum = 0;
  for (const auto& [key, xz] : columns_of) {
    xx += (xz.x() - centre.x()) * (xz.x() - centre.x());
    xz_sum += (xz.x() - centre.x()) * (xz.y() - centre.y());
  }
  tool.sharpening = std::atan2(xx, xz_sum);
  return tool;
}

}  // namespace palpate::physics::test
