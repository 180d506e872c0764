#include "physics_node/fragments/measure_fragments.h"

#include <algorithm>

#include "physics_node/step/rigid_fit.h"

namespace palpate::physics {

std::vector<FragmentMeasure> measure_fragments(const NodeMotion& moving, const Fragments& fragments) {
  std::vector<FragmentMeasure> all(static_cast<std::size_t>(fragments.count()));
  for (std::size_t n = 0; n < all.size(); ++n) all[n].label = static_cast<Index>(n);
  moving.body().each_node([&](Index cell) {
    FragmentMeasure& one = all[static_cast<std::size_t>(fragments.label(cell))];
    const double m = node_mass(moving.body(), cell);
    const Vec3 x = moving.position(cell);
    const Vec3 mv = m * moving.velocity(cell);
    ++one.masses;
    one.mass += m;
    one.center += m * x;
    one.momenta.linear += mv;
    one.momenta.angular += x.cross(mv);
  });
  for (FragmentMeasure& one : all) one.center /= one.mass;
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.mass > b.mass; });
  return all;
}

double fragment_shape_rms(const NodeMotion& moving, const Fragments& fragments, Index label) {
  if (fragments.masses()[static_cast<std::size_t>(label)] < 3) return 0;
  return rigid_fit_rms([&](const auto& visit) {
    moving.body().each_node([&](Index cell) {
      if (fragments.label(cell) == label) visit(moving.body().rest_position(cell), moving.position(cell));
    });
  });
}

}  // namespace palpate::physics
