#include "bench/peers/spring_body.h"

#include <algorithm>

#include "common/error/error.h"

namespace palpate::bench {

double SpringBody::longest() const {
  double longest = 0;
  for (const Spring& spring : springs) longest = std::max(longest, spring.length);
  return longest;
}

SpringBody spring_body(const physics::Body& body, const Vec3& gravity) {
  PALPATE_CHECK(body.law_of.empty() && !body.law.damped && body.law.drag == 0 && !body.law.yields,
                "peers are given elastic springs of one material only");
  const physics::Lattice& lattice = body.lattice;
  const std::vector<physics::Vec3i> half = physics::half_directions(lattice.kind);
  SpringBody springs;
  springs.gravity = gravity;
  springs.mass = body.law.mass;
  std::vector<std::size_t> number(static_cast<std::size_t>(lattice.n_cells()), 0);
  for (const physics::Index cell : lattice.masses) {
    number[static_cast<std::size_t>(cell)] = springs.rest.size();
    springs.rest.push_back(lattice.rest_position(cell));
    springs.held.push_back(body.inverse_mass[static_cast<std::size_t>(cell)] == 0 ? 1 : 0);
  }
  for (const physics::Index cell : lattice.masses) {
    const auto i = static_cast<std::size_t>(cell);
    const physics::Vec3i grid = lattice.grid_of(cell);
    for (std::size_t d = 0; d < half.size(); ++d) {
      if (((lattice.mask[i] >> d) & 1) == 0) continue;
      const std::size_t j = number[static_cast<std::size_t>(lattice.mass_at(grid + half[d]))];
      if (springs.held[number[i]] != 0 && springs.held[j] != 0) continue;
      springs.springs.push_back({number[i], j, body.law.k1[d], lattice.rest_length[d]});
    }
  }
  return springs;
}

}  // namespace palpate::bench
