#include "render_node/model/surface_chunks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace palpate::render {
namespace {

/// Facets sorted by the cell of a coarse grid in which their first corner lies: a counting sort.
struct Sorted {
  std::vector<std::uint32_t> facets;  // those with an area
  std::vector<std::uint32_t> ends;    // of cells that have any
};

// Why 16: some four facets across, less than a finger.
constexpr double facets_a_chunk = 16;
constexpr int most_cells_across = 64;

Sorted sorted(const Surface& surface) {
  Eigen::AlignedBox3f box;
  std::size_t n = 0;
  for (const Corners& c : surface.corners) {
    if (is_loose(c)) continue;
    box.extend(Eigen::Vector3f(surface.position[c[0]].data()));
    ++n;
  }
  Sorted result;
  if (n == 0) return result;
  // A surface goes through some six k^2 of k^3 cells.
  const int k = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(n) / (6 * facets_a_chunk))), 1,
                           most_cells_across);
  const Eigen::Array3f scale = static_cast<float>(k) / box.sizes().array().max(1e-9F);
  const auto cell_of = [&](const Corners& c) {
    const Eigen::Vector3f p(surface.position[c[0]].data());
    const Eigen::Array3i at = ((p - box.min()).array() * scale).cast<int>().max(0).min(k - 1);
    return static_cast<std::size_t>((at.z() * k + at.y()) * k + at.x());
  };
  std::vector<std::uint32_t> first(static_cast<std::size_t>(k * k * k) + 1, 0);
  for (const Corners& c : surface.corners)
    if (!is_loose(c)) ++first[cell_of(c) + 1];
  for (std::size_t i = 1; i < first.size(); ++i) {
    if (first[i] > 0) result.ends.push_back(first[i - 1] + first[i]);
    first[i] += first[i - 1];
  }
  result.facets.resize(n);
  for (std::size_t f = 0; f < surface.corners.size(); ++f)
    if (!is_loose(surface.corners[f]))
      result.facets[first[cell_of(surface.corners[f])]++] = static_cast<std::uint32_t>(f);
  return result;
}

}  // namespace

void SurfaceChunks::build(const Surface& surface) {
  const Sorted order = sorted(surface);
  indices_.clear();
  runs_.clear();
  changed_.clear();
  longest_edge_ = 0;
  indices_.reserve(6 * order.facets.size());
  std::size_t i = 0;
  for (const std::uint32_t end : order.ends) {
    const std::size_t first = indices_.size();
    for (; i < end; ++i) {
      const Corners& c = surface.corners[order.facets[i]];
      indices_.insert(indices_.end(), {c[0], c[1], c[2]});
      if (c[2] != c[3]) indices_.insert(indices_.end(), {c[0], c[2], c[3]});
    }
    runs_.push_back({first, indices_.size() - first});
  }
  // Which chunks a vertex is in: each once, as a chunk's indices follow each other.
  std::vector<std::uint32_t> last(surface.position.size(), UINT32_MAX);
  first_of_vertex_.assign(surface.position.size() + 1, 0);
  const auto for_each_pair = [&](const auto& what) {
    std::fill(last.begin(), last.end(), UINT32_MAX);
    for (std::uint32_t chunk = 0; chunk < runs_.size(); ++chunk)
      for (std::size_t j = runs_[chunk].first; j < runs_[chunk].first + runs_[chunk].n; ++j)
        if (std::exchange(last[indices_[j]], chunk) != chunk) what(indices_[j], chunk);
  };
  for_each_pair([&](std::uint32_t v, std::uint32_t) { ++first_of_vertex_[v + 1]; });
  for (std::size_t v = 1; v < first_of_vertex_.size(); ++v) first_of_vertex_[v] += first_of_vertex_[v - 1];
  chunks_of_vertices_.resize(first_of_vertex_.back());
  std::vector<std::uint32_t> next(first_of_vertex_.begin(), first_of_vertex_.end() - 1);
  for_each_pair([&](std::uint32_t v, std::uint32_t chunk) { chunks_of_vertices_[next[v]++] = chunk; });
  is_marked_.assign(runs_.size(), 0);
  boxes_.resize(runs_.size());
  normals_.resize(runs_.size());
  for (std::size_t chunk = 0; chunk < runs_.size(); ++chunk) measure(surface, chunk);
}

void SurfaceChunks::measure(const Surface& surface, std::size_t chunk) {
  Eigen::AlignedBox3f box;
  float longest2 = 0;
  std::vector<Eigen::Vector3f> normals;
  normals.reserve(runs_[chunk].n / 3);
  Cone cone;
  for (std::size_t j = runs_[chunk].first; j < runs_[chunk].first + runs_[chunk].n; j += 3) {
    std::array<Eigen::Vector3f, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = Eigen::Vector3f(surface.position[indices_[j + k]].data());
      box.extend(p[k]);
    }
    longest2 = std::max(
        {longest2, (p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm()});
    normals.push_back((p[1] - p[0]).cross(p[2] - p[0]).stableNormalized());
    cone.axis += normals.back();
  }
  cone.axis.stableNormalize();
  float least = 1;
  for (const Eigen::Vector3f& normal : normals) least = std::min(least, normal.dot(cone.axis));
  cone.angle = std::acos(std::clamp(least, -1.0F, 1.0F));
  normals_[chunk] = cone;
  boxes_[chunk] = box;
  longest_edge_ = std::max(longest_edge_, std::sqrt(longest2));
}

/// Of a triangle whose normal is within the angle a of the axis, at a place within b of the way d to the middle of the box, seen from
/// the eye: its back shows if the angle between axis and d is below 90 degrees - a - b.
bool SurfaceChunks::faces_away(std::size_t chunk, const Eigen::Vector3f& eye) const {
  constexpr float rounding = 0.01F;  // [rad]
  const Eigen::Vector3f d = boxes_[chunk].center() - eye;
  const float distance = d.norm(), radius = 0.5F * boxes_[chunk].diagonal().norm();
  if (!(distance > radius)) return false;
  const float open = normals_[chunk].angle + std::asin(radius / distance) + rounding;
  return open < 0.5F * std::numbers::pi_v<float> && normals_[chunk].axis.dot(d) > distance * std::sin(open);
}

void SurfaceChunks::follow(const Surface& surface, std::span<const std::uint32_t> vertices) {
  changed_.clear();
  for (const std::uint32_t v : vertices)
    for (std::uint32_t i = first_of_vertex_[v]; i < first_of_vertex_[v + 1]; ++i)
      if (std::exchange(is_marked_[chunks_of_vertices_[i]], std::uint8_t{1}) == 0)
        changed_.push_back(chunks_of_vertices_[i]);
  for (const std::uint32_t chunk : changed_) {
    is_marked_[chunk] = 0;
    measure(surface, chunk);
  }
}

}  // namespace palpate::render
