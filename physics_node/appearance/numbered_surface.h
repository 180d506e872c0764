#pragma once
// A surface under the numbers that its reader knows. Of a later surface of the same body, whatever is in both keeps its number,
// so that only what changed need be sent.

#include <vector>

#include "common/message/messages.h"
#include "physics_node/boundary/surface.h"

namespace palpate::physics {

/// What makes one surface of another.
struct SurfaceDelta {
  struct Vertex {
    Vec3 rest;        // [m]
    Index cell;       // of its mass; -1: scenery
    Bearers bearers;  // of a smooth skin
  };
  struct Carried {
    std::uint32_t vertex;
    Bearers bearers;
  };
  std::vector<Vertex> vertices;     // numbered on behind those that are there
  std::vector<Carried> carried;     // by others than before, of those that are there
  std::vector<FacetChange> facets;  // to be carried out one after the other
  std::size_t total_facets = 0;     // afterwards: what is behind them is gone
  std::uint64_t hidden = 0;
};

/// Vertices keep their number for good; one that no facet uses any more stays. Facets have no gaps: a new facet takes the place
/// of one that is gone, and otherwise the last facet does.
class NumberedSurface {
 public:
  NumberedSurface() = default;  // of nothing
  explicit NumberedSurface(Surface surface);

  /// What makes this surface show the facets of `next`, in whatever order. Equal facets have equal corners, from the same first
  /// one on, and equal colours. Cost: a pass over both, and sorting what does not come in the same order in them.
  SurfaceDelta delta_to(const Surface& next) const;

  /// Cost: of the change, not of the surface.
  void apply(const SurfaceDelta& delta);

  std::size_t n_vertices() const { return rest_.size(); }
  Index cell(std::size_t vertex) const { return cell_[vertex]; }  // of its mass; -1: scenery
  bool is_rigid() const { return is_rigid_; }                     // no vertex moves
  /// Is there a vertex in [first, last) that moves? Never false if there is.
  bool may_move(std::size_t first, std::size_t last) const { return first < n_leading_ || last > n_first_; }
  /// Does all of [first, last) stand where it rests, since its part of the body sleeps?
  bool rests(std::size_t first, std::size_t last, const AwakeParts& parts) const;
  const Vec3& rest(std::size_t vertex) const { return rest_[vertex]; }  // where it lies without any load [m]
  /// Position now: of a moving vertex from the body, of the scenery from rest.
  Vec3 position(std::size_t vertex, const NodeMotion& moving) const {
    const Index cell = cell_[vertex];
    if (cell < 0) return rest_[vertex];
    if (bearers_.empty()) return rest_[vertex] + moving.displacement(cell);
    return rest_[vertex] + bearers_[vertex].displacement(moving);
  }

  using Corners = std::array<std::uint32_t, 4>;
  const std::vector<Corners>& facets() const { return facets_; }
  const std::vector<std::uint32_t>& rgba() const { return rgba_; }  // (n_facets)
  std::uint64_t hidden() const { return hidden_; }

 private:
  std::vector<std::uint32_t> numbers_of(const Surface& next, SurfaceDelta& delta) const;

  std::vector<Vec3> rest_;   // (n_vertices)
  std::vector<Index> cell_;  // (n_vertices)
  std::vector<Bearers>
      bearers_;                  // as of Surface, but of scenery, too; EMPTY: no skin is smooth  (n_vertices)
  std::vector<Corners> facets_;  // (n_facets)
  std::vector<std::uint32_t> rgba_;
  std::uint64_t hidden_ = 0;
  std::size_t n_leading_ = 0;  // vertices that move and came first
  std::size_t n_first_ = 0;    // vertices that came first; scenery is behind those that move
  bool is_rigid_ = true;
};

}  // namespace palpate::physics
