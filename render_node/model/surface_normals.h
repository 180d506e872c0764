#pragma once
// Smooth normals of a surface whose facets are faces of a lattice, that is a staircase; of one that is smooth itself.
//
//   n_v^0 = unit of the sum of (twice the) area vectors of the facets at vertex v
//   n_v^p = unit of the sum over the facets at v of the sum of n^(p-1) over their corners,  p = 1 .. passes
//
// Only normals are smoothed; positions stay true. Every level is kept, so that after a few vertices moved only their
// neighbourhood is computed again, with the same bits as a computation of the whole.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "render_node/model/surface.h"

namespace palpate::render {

class SurfaceNormals {
 public:
  static constexpr int for_stairs = 5;
  /// @param passes  of smoothing, >= 0
  explicit SurfaceNormals(int passes = for_stairs);

  /// From the next rebuild() on. @param passes  >= 0
  void set_passes(int passes);

  /// Everything anew. @param position,corners as in Surface
  void rebuild(std::span<const Array3f> position, std::span<const Corners> corners);

  /// After some vertices moved. The corners must be those of the last rebuild().
  /// @param moved  vertices, each once
  /// @return vertices whose normal was computed again, each once
  std::vector<std::uint32_t> update(std::span<const Array3f> position, std::span<const Corners> corners,
                                    std::span<const std::uint32_t> moved);

  /// Unit, or zero at a vertex without facets.
  std::span<const Eigen::Vector3f> normals() const noexcept { return levels_.back(); }

 private:
  std::span<const std::uint32_t> facets_at(std::uint32_t vertex) const noexcept;
  void find_facets(std::size_t n_vertices, std::span<const Corners> corners);
  void grow(std::vector<std::uint32_t>& vertices, std::span<const Corners> corners);

  std::vector<std::uint32_t> first_;   // facets of v: facet_[first_[v] .. first_[v+1])   (n_vertices + 1)
  std::vector<std::uint32_t> facet_;   // in rising order
  std::vector<std::uint32_t> marked_;  // == round_: already in the set being grown        (n_vertices)
  std::uint32_t round_ = 0;
  std::vector<std::vector<Eigen::Vector3f>> levels_;  // n^0 .. n^passes                  (each n_vertices)
};

/// Is it a smooth skin of cells: most of its facets have four corners, and lie along no plane of a lattice? At rest.
bool is_smooth_skin(std::span<const Array3f> rest, std::span<const Corners> corners);

}  // namespace palpate::render
