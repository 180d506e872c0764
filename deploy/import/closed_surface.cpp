#include "deploy/import/closed_surface.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <unordered_map>
#include <utility>

#include "common/error/error.h"
#include "common/math/units.h"
#include "common/scene/complaints.h"
#include "deploy/import/surface_cuts.h"
#include "deploy/import/surface_winding.h"

namespace palpate {
namespace {

// Of the box's diagonal: points nearer than that are one. Why: places are floats, which a program that writes text rounds again.
constexpr double weld_share = 1e-6;
constexpr std::size_t none = static_cast<std::size_t>(-1);

std::string in_mm(const Vec3& x) {
  return fmt::format("{:.4g}, {:.4g}, {:.4g} mm", mm_from_m(x.x()), mm_from_m(x.y()), mm_from_m(x.z()));
}

/// Finds points near a place, by the cube that each is in.
class NearPoints {
 public:
  explicit NearPoints(double distance) : distance_(distance) {}

  /// The first point added within the distance, or -1.
  std::int32_t near(const Vec3& x, const std::vector<Vec3>& points) const {
    const Cube at = cube_of(x);
    for (std::int64_t n = 0; n < 27; ++n) {
      const auto found = point_in_.find({at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1});
      if (found == point_in_.end()) continue;
      for (const std::int32_t p : found->second)
        if ((points[static_cast<std::size_t>(p)] - x).norm() <= distance_) return p;
    }
    return -1;
  }
  void add(const Vec3& x, std::int32_t point) { point_in_[cube_of(x)].push_back(point); }

 private:
  using Cube = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cube& c) const noexcept {
      return static_cast<std::size_t>(c[0] * 73856093 ^ c[1] * 19349663 ^ c[2] * 83492791);
    }
  };
  Cube cube_of(const Vec3& x) const {
    Cube cube{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      cube[axis] = std::llround(std::floor(x[static_cast<Eigen::Index>(axis)] / distance_));
    return cube;
  }

  double distance_;
  std::unordered_map<Cube, std::vector<std::int32_t>, Hash> point_in_;
};

/// Points at one place become one; triangles that have lost a corner, and points of none, are left out.
TriangleSurface welded(const TriangleSurface& raw, SurfaceMended& mended) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : raw.points) box.extend(x);
  const double distance = std::max(weld_share * box.diagonal().norm(), 1e-12);
  TriangleSurface made;
  std::vector<std::int32_t> number(raw.points.size(), -1);
  std::vector<bool> used(raw.points.size());
  for (const Corners& corners : raw.triangles)
    for (const std::int32_t c : corners) used[static_cast<std::size_t>(c)] = true;
  NearPoints near(distance);
  for (std::size_t p = 0; p < raw.points.size(); ++p) {
    if (!used[p]) {
      ++mended.unused;
      continue;
    }
    number[p] = near.near(raw.points[p], made.points);
    if (number[p] >= 0) {
      if (made.points[static_cast<std::size_t>(number[p])] != raw.points[p]) ++mended.welded;
      continue;
    }
    number[p] = static_cast<std::int32_t>(made.points.size());
    near.add(raw.points[p], number[p]);
    made.points.push_back(raw.points[p]);
  }
  for (Corners corners : raw.triangles) {
    for (std::int32_t& c : corners) c = number[static_cast<std::size_t>(c)];
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
      ++mended.degenerate;
    else
      made.triangles.push_back(corners);
  }
  return made;
}

struct Neighbour {
  std::size_t triangle = none;
  bool turned = false;  // the other way round than this one
};

/// Of each triangle, over its edges 01, 12, 20. @throws InputError: an edge that is not of two
std::vector<std::array<Neighbour, 3>> neighbours_over_edges(const TriangleSurface& surface,
                                                            const std::string& where) {
  struct Side {
    std::int32_t low = 0, high = 0;
    std::size_t triangle = none, n = 0;
    bool rises = false;
  };
  std::vector<Side> sides;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t n = 0; n < 3; ++n) {
      const std::int32_t a = surface.triangles[t][n], b = surface.triangles[t][(n + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), t, n, a < b});
    }
  std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.low, s.high, s.triangle); });
  std::vector<std::array<Neighbour, 3>> found(surface.triangles.size());
  std::size_t open = 0, of_more = 0;
  Side first_open, first_of_more;  // in the order of triangles
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    const Side& s = sides[begin];
    for (end = begin; end < sides.size() && sides[end].low == s.low && sides[end].high == s.high;) ++end;
    if (end - begin == 2) {
      const Side& other = sides[begin + 1];
      found[s.triangle][s.n] = {other.triangle, s.rises == other.rises};
      found[other.triangle][other.n] = {s.triangle, s.rises == other.rises};
    } else if (end - begin == 1) {
      ++open;
      if (s.triangle < first_open.triangle) first_open = s;
    } else {
      ++of_more;
      if (s.triangle < first_of_more.triangle) first_of_more = s;
    }
  }
  const auto middle = [&](const Side& s) {
    return in_mm(0.5 * (surface.points[static_cast<std::size_t>(s.low)] +
                        surface.points[static_cast<std::size_t>(s.high)]));
  };
  if (of_more > 0)
    throw InputError(
        one_line(fmt::format("{}: edges of more than two triangles: {}, the first at {}; where parts touch, "
                             "move them apart or make "
                             "them one, and leave out walls inside",
                             where, of_more, middle(first_of_more))));
  if (open > 0)
    throw InputError(one_line(
        fmt::format("{}: the surface is open: edges of one triangle: {}, the first at {}; close its holes",
                    where, open, middle(first_open))));
  return found;
}

/// Turns triangles so that those of a part agree. @return the part of each triangle  @param turned  those that were
std::vector<std::size_t> agree(TriangleSurface& surface, const std::string& where, std::vector<bool>& turned,
                               std::size_t& parts) {
  const auto neighbours = neighbours_over_edges(surface, where);
  std::vector<std::size_t> part(surface.triangles.size(), none);
  turned.assign(surface.triangles.size(), false);
  parts = 0;
  std::deque<std::size_t> waiting;
  for (std::size_t first = 0; first < part.size(); ++first) {
    if (part[first] != none) continue;
    part[first] = parts++;
    waiting.push_back(first);
    for (; !waiting.empty(); waiting.pop_front()) {
      const std::size_t t = waiting.front();
      for (const Neighbour& next : neighbours[t]) {
        const bool turn = turned[t] != next.turned;
        if (part[next.triangle] == none) {
          part[next.triangle] = part[t];
          turned[next.triangle] = turn;
          waiting.push_back(next.triangle);
        } else if (turned[next.triangle] != turn) {
          throw InputError(one_line(fmt::format(
              "{}: the surface has one side only, as a Klein bottle, at {}; nothing is inside of it", where,
              in_mm(surface.corner(next.triangle, 0)))));
        }
      }
    }
  }
  for (std::size_t t = 0; t < turned.size(); ++t)
    if (turned[t]) std::swap(surface.triangles[t][1], surface.triangles[t][2]);
  return part;
}

/// Parts that an even number of others is round are anticlockwise from outside, and the others are holes.
/// @return of each part: is it the wrong way round?
std::vector<bool> wrong_parts(const TriangleSurface& surface, const SurfaceWinding& winding,
                              const std::vector<std::size_t>& part, std::size_t parts) {
  std::vector<double> volume(parts, 0);
  std::vector<std::size_t> first(parts, none);
  const Vec3 origin = surface.points.front();
  for (std::size_t t = 0; t < part.size(); ++t) {
    if (first[part[t]] == none) first[part[t]] = t;
    volume[part[t]] += surface.volume_under(t, origin);
  }
  std::vector<bool> wrong(parts);
  for (std::size_t p = 0; p < parts; ++p) {
    std::map<std::size_t, int> times;  // that each other part goes round this one
    winding.for_each_met(surface.corner(first[p], 0),
                         [&](std::size_t t, int turn) { times[part[t]] += turn; });
    times.erase(p);
    const auto round = std::ranges::count_if(times, [](const auto& each) { return each.second % 2 != 0; });
    wrong[p] = (volume[p] > 0) != (round % 2 == 0);
  }
  return wrong;
}

}  // namespace

ClosedSurface close_surface(TriangleSurface raw, const std::string& where) {
  ClosedSurface made;
  made.surface = welded(raw, made.mended);
  TriangleSurface& surface = made.surface;
  if (surface.triangles.empty())
    throw InputError(one_line(
        fmt::format("{}: all of its triangles are points or lines, so nothing is inside of it", where)));
  std::vector<bool> turned;
  const std::vector<std::size_t> part = agree(surface, where, turned, made.parts);
  {
    const SurfaceWinding winding(surface);
    const SurfaceCuts cuts = cuts_of(surface, winding.tree(), part);
    if (cuts.between_parts)
      throw InputError(
          one_line(fmt::format("{}: its parts go through each other, first at {}; make them one surface",
                               where, in_mm(*cuts.between_parts))));
    made.mended.cutting = cuts.triangles;
    made.mended.cut = cuts.first;
    const std::vector<bool> wrong = wrong_parts(surface, winding, part, made.parts);
    for (std::size_t t = 0; t < part.size(); ++t) {
      if (!wrong[part[t]]) continue;
      turned[t] = !turned[t];
      std::swap(surface.triangles[t][1], surface.triangles[t][2]);
    }
  }
  made.mended.turned = static_cast<std::size_t>(std::ranges::count(turned, true));
  made.volume = enclosed_volume(surface);
  Eigen::AlignedBox3d box;
  for (const Vec3& x : surface.points) box.extend(x);
  constexpr double least_share = 1e-9;  // of the box's longest side, cubed
  if (!(made.volume > least_share * std::pow(box.sizes().maxCoeff(), 3)))
    throw InputError(
        one_line(fmt::format("{}: the surface encloses nothing: its sides lie upon each other", where)));
  return made;
}

}  // namespace palpate
