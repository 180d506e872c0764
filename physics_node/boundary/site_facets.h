#pragma once
// What bounds the tissue of a body, place by place, by the elements alive at that moment. A place is a voxel cell, an
// octahedral site of the fcc lattice or a tetrahedron of a mesh; a facet belongs to one of them, and depends on masses near it alone. So where an
// element breaks, a few places are looked at again, and not the body.

#include <array>
#include <memory>
#include <span>

#include "physics_node/step/topology.h"

namespace palpate::physics {

class SiteFacets {
 public:
  /// Masses at the corners, anticlockwise from outside; a triangle repeats its last.
  using Corners = std::array<Index, 4>;
  static constexpr std::size_t most_facets =
      16;  // of a site: two triangles on each face of a cell, four inside it
  static constexpr std::size_t most_around = TetNet::most_around;  // a mass

  virtual ~SiteFacets() = default;
  virtual std::size_t n_sites() const noexcept = 0;
  /// Sites whose facets depend on the elements of this mass. @return how many
  virtual std::size_t around(Index mass, std::span<std::uint32_t, most_around> sites) const noexcept = 0;
  /// The facets between what is filled and what is empty. A sheet, with nothing filled on either side, is none: nothing is
  /// behind it that could bear a tool. Of a site of rigid scenery only those towards tissue that moves.
  /// @return how many
  virtual std::size_t facets_of(std::uint32_t site, std::span<Corners, most_facets> out) const noexcept = 0;
  /// Of a facet that a cut has opened: what lies at its corners on the other side. Of others -1.
  virtual Corners across(std::uint32_t /*site*/, const Corners& /*masses*/) const noexcept {
    return {-1, -1, -1, -1};
  }
  /// Are the other facets of this site rigid scenery, which stays?
  virtual bool is_rigid(std::uint32_t site) const noexcept = 0;
};

/// @param moving  outlives it
std::unique_ptr<SiteFacets> make_site_facets(const Topology& moving);

}  // namespace palpate::physics
