#include "render_node/model/surface_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace palpate::render {
namespace {

using Eigen::Vector3f;

Vector3f at(std::span<const Array3f> position, std::uint32_t v) {
  return {position[v][0], position[v][1], position[v][2]};
}

// Twice the area, along the normal: half the cross product of the diagonals is right for a quadrilateral and for
// a triangle that repeats its last corner.
Vector3f area_vector(std::span<const Array3f> position, const Corners& c) {
  return (at(position, c[2]) - at(position, c[0])).cross(at(position, c[3]) - at(position, c[1]));
}

Vector3f unit_or_zero(const Vector3f& v) {
  const float length = v.norm();
  return length > 0 ? Vector3f(v / length) : Vector3f::Zero();
}

Vector3f corner_sum(const std::vector<Vector3f>& normal, const Corners& c) {
  return normal[c[0]] + normal[c[1]] + normal[c[2]] + normal[c[3]];
}

}  // namespace

SurfaceNormals::SurfaceNormals(int passes) : levels_(static_cast<std::size_t>(std::max(passes, 0)) + 1) {}

void SurfaceNormals::set_passes(int passes) {
  levels_.resize(static_cast<std::size_t>(std::max(passes, 0)) + 1);
}

bool is_smooth_skin(std::span<const Array3f> rest, std::span<const Corners> corners) {
  constexpr float along = 0.9999F;  // cosine
  std::size_t facets = 0, slanted = 0;
  for (const Corners& c : corners) {
    if (is_loose(c)) continue;
    ++facets;
    const Vector3f normal = unit_or_zero(area_vector(rest, c));
    if (c[2] != c[3] && normal.cwiseAbs().maxCoeff() < along) ++slanted;
  }
  return 2 * slanted > facets;
}

std::span<const std::uint32_t> SurfaceNormals::facets_at(std::uint32_t vertex) const noexcept {
  return {facet_.data() + first_[vertex], facet_.data() + first_[vertex + 1]};
}

void SurfaceNormals::find_facets(std::size_t n_vertices, std::span<const Corners> corners) {
  const auto distinct = [](const Corners& c) { return c[2] == c[3] ? std::size_t{3} : std::size_t{4}; };
  first_.assign(n_vertices + 1, 0);
  for (const auto& c : corners) {
    for (std::size_t i = 0; i < distinct(c); ++i) ++first_[c[i] + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  facet_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t f = 0; f < corners.size(); ++f) {
    for (std::size_t i = 0; i < distinct(corners[f]); ++i) facet_[next[corners[f][i]]++] = f;
  }
  marked_.assign(n_vertices, 0);
  round_ = 0;
}

void SurfaceNormals::rebuild(std::span<const Array3f> position, std::span<const Corners> corners) {
  const auto n_vertices = static_cast<std::uint32_t>(position.size());
  find_facets(position.size(), corners);
  std::vector<Vector3f> of_facet(corners.size());
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    for (std::size_t f = 0; f < corners.size(); ++f) {
      of_facet[f] =
          level == 0 ? area_vector(position, corners[f]) : corner_sum(levels_[level - 1], corners[f]);
    }
    auto& normal = levels_[level];
    normal.resize(n_vertices);
    for (std::uint32_t v = 0; v < n_vertices; ++v) {
      Vector3f sum = Vector3f::Zero();
      for (const auto f : facets_at(v)) sum += of_facet[f];
      normal[v] = unit_or_zero(sum);
    }
  }
}

// Adds the other corners of all facets at the given vertices.
void SurfaceNormals::grow(std::vector<std::uint32_t>& vertices, std::span<const Corners> corners) {
  const auto n = vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (const auto f : facets_at(vertices[i])) {
      for (const auto v : corners[f]) {
        if (marked_[v] == round_) continue;
        marked_[v] = round_;
        vertices.push_back(v);
      }
    }
  }
}

std::vector<std::uint32_t> SurfaceNormals::update(std::span<const Array3f> position,
                                                  std::span<const Corners> corners,
                                                  std::span<const std::uint32_t> moved) {
  std::vector<std::uint32_t> changed(moved.begin(), moved.end());
  ++round_;
  for (const auto v : changed) marked_[v] = round_;
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    grow(changed, corners);
    for (const auto v : changed) {
      Vector3f sum = Vector3f::Zero();
      for (const auto f : facets_at(v)) {
        sum += level == 0 ? area_vector(position, corners[f]) : corner_sum(levels_[level - 1], corners[f]);
      }
      levels_[level][v] = unit_or_zero(sum);
    }
  }
  return changed;
}

}  // namespace palpate::render
