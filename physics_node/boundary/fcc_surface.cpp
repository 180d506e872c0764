#include <unordered_map>

#include "physics_node/boundary/surface.h"

namespace palpate::physics {
namespace {

Vec3i axis(int a, int sign) {
  Vec3i e = Vec3i::Zero();
  e[a] = sign;
  return e;
}

constexpr Mask every_element = 0xFFF;

Vec3i corner_of(int n) { return axis(n / 2, n % 2 == 0 ? -1 : 1); }

/// One octahedral site and the eight tetrahedra on its faces.
struct Site {
  Vec3i centre;
  std::array<bool, 6> present{};  // masses at -x +x -y +y -z +z
  std::array<Mask, 6> mask{};     // their live elements
  int n_present = 0;
  bool filled = false;  // at least five masses, every element between them alive
  bool deep = false;    // all six masses with every element: nothing to see

  Mask mask_at(int a, int sign) const { return mask[static_cast<std::size_t>(2 * a + (sign > 0 ? 1 : 0))]; }
};

Site look_at(const LiveNet& net, const Vec3i& centre) {
  Site site{centre, {}, {}, 0, false, true};
  for (int n = 0; n < 6; ++n) {
    const auto i = static_cast<std::size_t>(n);
    const Index cell = net.mass(centre + corner_of(n));
    site.present[i] = cell >= 0;
    site.n_present += cell >= 0 ? 1 : 0;
    site.mask[i] = cell >= 0 ? net.mask(cell) : 0;
    site.deep = site.deep && site.mask[i] == every_element;
  }
  if (site.n_present < 5 || site.deep) return site;
  site.filled = true;
  for (int n = 0; n < 6; ++n)
    for (int o = n + 1; o < 6; ++o) {
      const auto i = static_cast<std::size_t>(n);
      if (n / 2 == o / 2 || !site.present[i] || !site.present[static_cast<std::size_t>(o)]) continue;
      site.filled = site.filled && net.alive(site.mask[i], corner_of(o) - corner_of(n));
    }
  return site;
}

class Builder {
 public:
  Builder(const Body& body, const LiveNet& net, std::uint32_t rgba) : body_(body), net_(net), rgba_(rgba) {}

  /// The triangle in the octant `s` of a site, between its octahedron and the tetrahedron beyond.
  void triangle(const Site& site, const Vec3i& s) {
    const std::array<Vec3i, 3> e{axis(0, s.x()), axis(1, s.y()), axis(2, s.z())};
    const std::array<Mask, 3> mask{site.mask_at(0, s.x()), site.mask_at(1, s.y()), site.mask_at(2, s.z())};
    const std::array<Vec3i, 3> p{site.centre + e[0], site.centre + e[1], site.centre + e[2]};
    if (!net_.alive(mask[0], e[1] - e[0]) || !net_.alive(mask[1], e[2] - e[1]) ||
        !net_.alive(mask[0], e[2] - e[0]))
      return;
    bool tetrahedron = true;
    for (std::size_t n = 0; n < 3; ++n) tetrahedron = tetrahedron && net_.alive(mask[n], s - e[n]);
    if (tetrahedron && site.filled) {
      ++surface.hidden;
      return;
    }
    // x, y, z corners are anticlockwise seen from the octant's outside when the product of signs is positive.
    const bool faces_out = (s.prod() > 0) == !tetrahedron;
    facet(faces_out ? std::array<Vec3i, 4>{p[0], p[1], p[2], p[2]}
                    : std::array<Vec3i, 4>{p[0], p[2], p[1], p[1]});
  }

  /// The square across an octahedron that lacks one mass.
  void square(const Site& site) {
    if (!site.filled || site.n_present != 5) return;
    int missing = 0;
    while (site.present[static_cast<std::size_t>(missing)]) ++missing;
    const int a = missing / 2;
    const int sign = missing % 2 == 0 ? -1 : 1;
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    std::array<Vec3i, 4> ring{site.centre + axis(b, 1), site.centre + axis(c, sign),
                              site.centre + axis(b, -1), site.centre + axis(c, -sign)};
    facet(ring);
  }

  Surface surface;

 private:
  void facet(const std::array<Vec3i, 4>& corners) {
    auto& out = surface.facets.emplace_back();
    for (std::size_t n = 0; n < 4; ++n) {
      const Index cell = net_.mass(corners[n]);
      const auto [at, added] = number_.try_emplace(cell, static_cast<std::uint32_t>(surface.cell.size()));
      if (added) {
        surface.cell.push_back(cell);
        surface.rest.push_back(body_.lattice.rest_position(cell));
      }
      out[n] = at->second;
    }
    surface.rgba.push_back(rgba_);
  }

  const Body& body_;
  const LiveNet& net_;
  std::uint32_t rgba_;
  std::unordered_map<Index, std::uint32_t> number_;
};

}  // namespace

Surface fcc_surface(const Body& body, const LiveElements& live, std::uint32_t rgba) {
  const LiveNet net(body.lattice, live);
  Builder builder(body, net, rgba);
  const Vec3i extent(2 * body.lattice.size.x(), body.lattice.size.y(), body.lattice.size.z());
  for (int z = -1; z <= extent.z(); ++z)
    for (int y = -1; y <= extent.y(); ++y)
      for (int x = -1; x <= extent.x(); ++x) {
        if (((x + y + z) & 1) == 0) continue;  // octahedral sites are the points between the masses
        const Site site = look_at(net, {x, y, z});
        if (site.n_present < 3) continue;
        if (site.deep) {
          builder.surface.hidden += 8;
          continue;
        }
        for (int octant = 0; octant < 8; ++octant)
          builder.triangle(site, {octant & 1 ? 1 : -1, octant & 2 ? 1 : -1, octant & 4 ? 1 : -1});
        builder.square(site);
      }
  return std::move(builder.surface);
}

}  // namespace palpate::physics
