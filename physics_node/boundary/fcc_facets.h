#pragma once
// The facets of one octahedral site of an fcc body, wherever they are wanted: for the whole surface at once, or where elements
// have just broken. The sites are the points between the masses; each has up to six masses around it and a tetrahedron
// on each of its eight faces. Source: EQUATIONS C-8, C-12.

#include <array>

#include "physics_node/boundary/live_elements.h"

namespace palpate::physics {

/// One octahedral site and the eight tetrahedra on its faces.
struct FccSite {
  Vec3i centre;
  std::array<bool, 6> present{};  // masses at -x +x -y +y -z +z
  std::array<Mask, 6> mask{};     // their live elements
  int n_present = 0;
  bool filled = false;  // at least five masses, every element between them alive
  bool deep = false;    // all six masses with every element: nothing to see

  Mask mask_at(int axis, int sign) const {
    return mask[static_cast<std::size_t>(2 * axis + (sign > 0 ? 1 : 0))];
  }
};

FccSite look_at_site(const LiveNet& net, const Vec3i& centre) noexcept;

/// Grid coordinates, anticlockwise from outside; a triangle repeats its last.
using SiteCorners = std::array<Vec3i, 4>;

inline Vec3i along_axis(int a, int sign) {
  Vec3i e = Vec3i::Zero();
  e[a] = sign;
  return e;
}

/// The triangle in the octant `s` of a site, between its octahedron and the tetrahedron beyond.
/// @param take  void(SiteCorners, bounds): `bounds` is false for a sheet, a triangle that bounds nothing
/// @return how many facets are hidden between the two
template <class Take>
int facet_in_octant(const LiveNet& net, const FccSite& site, const Vec3i& s, Take&& take) {
  const std::array<Vec3i, 3> e{along_axis(0, s.x()), along_axis(1, s.y()), along_axis(2, s.z())};
  const std::array<Mask, 3> mask{site.mask_at(0, s.x()), site.mask_at(1, s.y()), site.mask_at(2, s.z())};
  const std::array<Vec3i, 3> p{site.centre + e[0], site.centre + e[1], site.centre + e[2]};
  if (!net.alive(mask[0], e[1] - e[0]) || !net.alive(mask[1], e[2] - e[1]) ||
      !net.alive(mask[0], e[2] - e[0]))
    return 0;
  bool tetrahedron = true;
  for (std::size_t n = 0; n < 3; ++n) tetrahedron = tetrahedron && net.alive(mask[n], s - e[n]);
  if (tetrahedron && site.filled) return 1;
  // x, y, z corners are anticlockwise seen from the octant's outside when the product of signs is positive.
  const bool faces_out = (s.prod() > 0) == !tetrahedron;
  take(faces_out ? SiteCorners{p[0], p[1], p[2], p[2]} : SiteCorners{p[0], p[2], p[1], p[1]},
       tetrahedron || site.filled);
  return 0;
}

/// All facets of a site: its eight octants, and the square across an octahedron that lacks one mass. Parameters as above.
template <class Take>
int facets_of_site(const LiveNet& net, const Vec3i& centre, Take&& take) {
  const FccSite site = look_at_site(net, centre);
  if (site.n_present < 3) return 0;
  if (site.deep) return 8;
  int hidden = 0;
  for (int octant = 0; octant < 8; ++octant)
    hidden +=
        facet_in_octant(net, site, {octant & 1 ? 1 : -1, octant & 2 ? 1 : -1, octant & 4 ? 1 : -1}, take);
  if (!site.filled || site.n_present != 5) return hidden;
  int missing = 0;
  while (site.present[static_cast<std::size_t>(missing)]) ++missing;
  const int a = missing / 2, sign = missing % 2 == 0 ? -1 : 1, b = (a + 1) % 3, c = (a + 2) % 3;
  take(SiteCorners{centre + along_axis(b, 1), centre + along_axis(c, sign), centre + along_axis(b, -1),
                   centre + along_axis(c, -sign)},
       true);
  return hidden;
}

/// Sites as numbers, in the order of a surface: x fastest, from -1 to one beyond the box of the lattice.
class SiteNumbers {
 public:
  explicit SiteNumbers(const Lattice& lattice)
      : last_(2 * lattice.size.x(), lattice.size.y(), lattice.size.z()) {}
  const Vec3i& last() const { return last_; }
  std::size_t size() const {
    return static_cast<std::size_t>((last_ + Vec3i::Constant(2)).cast<std::int64_t>().prod());
  }
  std::uint32_t number(const Vec3i& site) const {
    const std::int64_t nx = last_.x() + 2, ny = last_.y() + 2;
    return static_cast<std::uint32_t>(site.x() + 1 + nx * (site.y() + 1 + ny * (site.z() + 1)));
  }
  Vec3i site(std::uint32_t number) const {
    const auto n = static_cast<std::int64_t>(number);
    const std::int64_t nx = last_.x() + 2, ny = last_.y() + 2;
    return {static_cast<int>(n % nx) - 1, static_cast<int>(n / nx % ny) - 1,
            static_cast<int>(n / nx / ny) - 1};
  }
  bool inside(const Vec3i& site) const {
    return (site.array() >= -1).all() && (site.array() <= last_.array()).all();
  }

 private:
  Vec3i last_;
};

}  // namespace palpate::physics
