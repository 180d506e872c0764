#pragma once
// Where a force and its moment act: the line on which the force alone does the same as both, and the point of it at which
// tissue pushes a tool.
//
//   r = set point + F x M / F^2,    the line r + s F / |F|    (the central axis of the wrench)
//
// A wrench says the line, not the point on it. Tissue pushes from outside, so that it is where the line, led along the
// force, first meets the tool.

#include <Eigen/Geometry>
#include <optional>

#include "render_node/model/surface.h"

namespace palpate::render {

using Vec3 = Eigen::Vector3d;

struct LineOfAction {
  Vec3 point = Vec3::Zero();  // the one nearest to the set point [m]
  Vec3 along = Vec3::Zero();  // of the force, unit
};

/// Nothing where there is no force.
/// @param moment  about set_point [N m]
std::optional<LineOfAction> line_of_action(const Vec3& force, const Vec3& moment, const Vec3& set_point);

/// How far along `along` a line through `from` first meets a facet of the surface, whichever way that looks; negative
/// values lie behind `from`. Nothing: it passes by. Cost: one pass over the facets.
/// @param least  hits before this one do not count [m]
std::optional<double> first_hit(const Surface& surface, const Vec3& from, const Vec3& along, double least);

/// The point of a tool made of elements at which tissue pushes it: the first hit, or, where the line passes by (a moment
/// without a lever), the vertex nearest to the line. Nothing: there is no vertex.
std::optional<Vec3> pushed_point(const LineOfAction& line, const Surface& tool);

/// The same of a stick, a capsule from a to b: what pushes it presses against the side that looks down the force.
/// @param radius [m]
Vec3 pushed_point(const LineOfAction& line, const Vec3& a, const Vec3& b, double radius);

}  // namespace palpate::render
