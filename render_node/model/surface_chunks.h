#pragma once
// The triangles of a surface in chunks of what lies together, each with the box round it: what moved says which part of
// a picture changes, and only what lies there need be drawn.

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render_node/model/surface.h"

namespace palpate::render {

class SurfaceChunks {
 public:
  struct Run {
    std::size_t first = 0, n = 0;  // of indices
  };

  /// Of all facets with an area, the triangles sorted by where they lie. Cost: three passes over the facets.
  void build(const Surface& surface);

  /// Vertices have moved or look otherwise. Fills changed(). Cost: of the chunks that have such a vertex.
  /// @param surface  that of build(), moved  @param vertices  each < n_vertices
  void follow(const Surface& surface, std::span<const std::uint32_t> vertices);

  std::span<const std::uint32_t> indices() const noexcept { return indices_; }  // three for each triangle
  std::span<const Run> runs() const noexcept { return runs_; }                  // of each chunk, without gaps
  std::span<const Eigen::AlignedBox3f> boxes() const noexcept { return boxes_; }
  /// Do all its triangles show their back there? May say no where they do.
  bool faces_away(std::size_t chunk, const Eigen::Vector3f& eye) const;
  /// Chunks that the last follow() found changed; none after build().
  std::span<const std::uint32_t> changed() const noexcept { return changed_; }
  /// No triangle has had a longer edge since build() [m].
  float longest_edge() const noexcept { return longest_edge_; }

 private:
  void measure(const Surface& surface, std::size_t chunk);

  std::vector<std::uint32_t> indices_;
  std::vector<Run> runs_;
  std::vector<Eigen::AlignedBox3f> boxes_;
  struct Cone {
    Eigen::Vector3f axis = Eigen::Vector3f::Zero();
    float angle = 4;  // no normal is further from the axis [rad]
  };
  std::vector<Cone> normals_;  // (n_chunks)
  std::vector<std::uint32_t> changed_;
  float longest_edge_ = 0;
  std::vector<std::uint32_t> first_of_vertex_, chunks_of_vertices_;  // which chunks have a vertex
  std::vector<std::uint8_t> is_marked_;                              // (n_chunks)
};

}  // namespace palpate::render
