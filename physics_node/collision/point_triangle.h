#pragma once
// A point and a triangle, standing and moving. A triangle whose corners are one point is that point.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

namespace palpate::physics {

using Triangle = std::array<Eigen::Vector3d, 3>;

struct ClosestPoint {
  Eigen::Vector3d weight = Eigen::Vector3d::Zero();  // barycentric; in [0, 1], sum 1
  Eigen::Vector3d away = Eigen::Vector3d::Zero();    // from it to the point [m]
  double distance = 0;                               // [m]
};

/// The point of the triangle nearest to p. Source: Ericson, Real-Time Collision Detection, 5.1.5.
ClosestPoint closest_point(const Eigen::Vector3d& p, const Triangle& t) noexcept;

/// Does the distance fall below `least` while all four points move on straight lines? Errs to the side of yes, by a tenth of
/// the distance at the start, and where that takes more than 200 looks.
/// @param dp, dt  what they move by [m]
/// @param away  at the start, from the closest point of the triangle to p, not 0 [m]
/// @param least   below the length of that [m]
/// Source: conservative advancement, Mirtich 1996, by the motion along the line of the closest points;
/// additive as in Li, Kaufman, Jiang 2021, Codimensional Incremental Potential Contact, algorithm 1.
bool comes_nearer(const Eigen::Vector3d& p, const Eigen::Vector3d& dp, const Triangle& t, const Triangle& dt,
                  const Eigen::Vector3d& away, double least) noexcept;

/// Does the point go through the triangle? Exact up to rounding: finds the times at which the four are in a plane.
bool passes_through(const Eigen::Vector3d& p, const Eigen::Vector3d& dp, const Triangle& t,
                    const Triangle& dt) noexcept;

}  // namespace palpate::physics
