#pragma once
// What can be seen and touched of a body: four-cornered facets on its masses and on its rigid scenery.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "physics_node/body/body.h"
#include "physics_node/boundary/bearers.h"
#include "physics_node/boundary/live_elements.h"
#include "physics_node/step/body_model.h"

namespace palpate::physics {

/// Surface::fan of a vertex that is on no smooth skin.
inline constexpr std::uint8_t no_fan = 255;

struct Surface {
  std::vector<Vec3> rest;   // rest position [m]               (n_vertices)
  std::vector<Index> cell;  // storage cell of its mass, moving first (n_moving)
  /// Who carries each vertex that moves; EMPTY: its own mass does (n_moving).
  std::vector<Bearers> bearers;
  std::vector<std::uint8_t> fan;  // of a smooth skin, see smooth_skin.h; EMPTY: there is none  (n_moving)
  std::vector<std::array<std::uint32_t, 4>>
      facets;                       // corners, anticlockwise from outside; a triangle repeats its last
  std::vector<std::uint32_t> rgba;  // 0xAABBGGRR                      (n_facets)
  std::vector<std::uint32_t>
      site;  // which voxel cell, octahedral site or tetrahedron it is of; of a mesh that is not cut 0 (n_facets)
  std::uint64_t hidden = 0;  // facets between two filled cells

  std::size_t n_vertices() const { return rest.size(); }
  std::size_t n_moving() const { return cell.size(); }
  /// Position now: of a moving vertex from the body, of the scenery from rest.
  Vec3 position(std::size_t vertex, const NodeMotion& moving) const {
    if (vertex >= cell.size()) return rest[vertex];
    return rest[vertex] +
           (bearers.empty() ? moving.displacement(cell[vertex]) : bearers[vertex].displacement(moving));
  }
};

/// Faces of shown cells that no other shown cell covers. Source: Takada & Abe, visible list; 6 neighbours (C-37).
/// A cell that has lost an element is shown by its five tetrahedra instead: a triangle is there while its three elements
/// live, a tetrahedron is filled while its six do (C-8), and what both sides fill is hidden.
/// With a smooth skin the corners that lay at it as loaded lie where the tissue ends (smooth_skin.h), and what meets a cut has the colour of
/// its inside.
/// @param threshold  shows only cells of at least this intensity; absent: all tissue
/// @param rgba  of a body without an image
Surface voxel_surface(const Body& body, const LiveElements& live, std::optional<double> threshold,
                      std::uint32_t rgba);

/// Facets of an fcc body: the triangles and squares that bound its filled tetrahedra and octahedra, from live elements.
/// A tetrahedron is filled while all its elements live, an octahedron while at least five of its six
/// masses hold together; a triangle that bounds nothing is a sheet and is shown too. Source: EQUATIONS C-8, C-12.
Surface fcc_surface(const Body& body, const LiveElements& live, std::uint32_t rgba);

/// The faces of a mesh that can be touched, as triangles; those that a cut has opened darker and redder, and of a
/// surface those along it. hidden: the faces between two tetrahedra.
Surface mesh_surface(const Body& body, const LiveElements& live, std::uint32_t rgba);

/// Of flesh under a skin of this colour (0xAABBGGRR).
std::uint32_t inside_colour(std::uint32_t skin) noexcept;

/// The same facets with the masses themselves at their corners.
Surface on_masses(const Body& body, Surface surface);

/// The surface of any kind.
Surface make_surface(const Body& body, const LiveElements& live, std::optional<double> threshold,
                     std::uint32_t plain_rgba);
/// The same from the elements alive now.
Surface make_surface(const Topology& moving, std::optional<double> threshold, std::uint32_t plain_rgba);

}  // namespace palpate::physics
