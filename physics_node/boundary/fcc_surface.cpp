#include <unordered_map>
#include <utility>

#include "physics_node/boundary/fcc_facets.h"
#include "physics_node/boundary/surface.h"

namespace palpate::physics {
namespace {

constexpr Mask every_element = 0xFFF;

Vec3i corner_of(int n) { return along_axis(n / 2, n % 2 == 0 ? -1 : 1); }

/// Gives every mass of a facet its number.
class FccBuilder {
 public:
  FccBuilder(const Body& body, std::uint32_t rgba) : body_(body), rgba_(rgba) {}

  void facet(const SiteCorners& corners, std::uint32_t site) {
    auto& out = surface.facets.emplace_back();
    for (std::size_t n = 0; n < 4; ++n) {
      const Index cell = body_.lattice.mass_at(corners[n]);
      const auto [at, added] = number_.try_emplace(cell, static_cast<std::uint32_t>(surface.cell.size()));
      if (added) {
        surface.cell.push_back(cell);
        surface.rest.push_back(body_.lattice.rest_position(cell));
      }
      out[n] = at->second;
    }
    surface.rgba.push_back(rgba_);
    surface.site.push_back(site);
  }

  Surface surface;

 private:
  const Body& body_;
  std::uint32_t rgba_;
  std::unordered_map<Index, std::uint32_t> number_;
};

}  // namespace

FccSite look_at_site(const LiveNet& net, const Vec3i& centre) noexcept {
  FccSite site{centre, {}, {}, 0, false, true};
  for (int n = 0; n < 6; ++n) {
    const auto i = static_cast<std::size_t>(n);
    const Index cell = net.mass(centre + corner_of(n));
    site.present[i] = cell >= 0;
    site.n_present += cell >= 0 ? 1 : 0;
    site.mask[i] = cell >= 0 ? net.mask(cell) : 0;
    site.deep = site.deep && site.mask[i] == every_element;
  }
  if (site.n_present < 5 || site.deep) return site;
  // One that is joined to none of the others any more is as good as missing: the other five may still hold together.
  const std::array<bool, 6> there = site.present;
  for (int n = 0; n < 6; ++n) {
    bool joined = false;
    for (int o = 0; o < 6; ++o)
      joined = joined ||
               (n / 2 != o / 2 && there[static_cast<std::size_t>(o)] && there[static_cast<std::size_t>(n)] &&
                net.alive(site.mask[static_cast<std::size_t>(n)], corner_of(o) - corner_of(n)));
    if (there[static_cast<std::size_t>(n)] && !joined)
      site.present[static_cast<std::size_t>(n)] = false, --site.n_present;
  }
  if (site.n_present < 5) return site;
  site.filled = true;
  for (int n = 0; n < 6; ++n)
    for (int o = n + 1; o < 6; ++o) {
      const auto i = static_cast<std::size_t>(n);
      if (n / 2 == o / 2 || !site.present[i] || !site.present[static_cast<std::size_t>(o)]) continue;
      site.filled = site.filled && net.alive(site.mask[i], corner_of(o) - corner_of(n));
    }
  return site;
}

Surface fcc_surface(const Body& body, const LiveElements& live, std::uint32_t rgba) {
  const LiveNet net(body.lattice, live.masks());
  const SiteNumbers numbers(body.lattice);
  FccBuilder builder(body, rgba);
  int hidden = 0;
  for (int z = -1; z <= numbers.last().z(); ++z) {
    for (int y = -1; y <= numbers.last().y(); ++y)
      for (int x = -1; x <= numbers.last().x(); ++x) {
        if (((x + y + z) & 1) == 0) continue;  // octahedral sites are the points between the masses
        const std::uint32_t site = numbers.number({x, y, z});
        hidden += facets_of_site(net, {x, y, z},
                                 [&](const SiteCorners& corners, bool) { builder.facet(corners, site); });
      }
    builder.surface.hidden += static_cast<std::uint64_t>(std::exchange(hidden, 0));
  }
  return std::move(builder.surface);
}

}  // namespace palpate::physics
