#include "physics_node/collision/passages.h"

#include "physics_node/collision/point_triangle.h"

namespace palpate::physics {

std::int64_t count_passages(const std::vector<ContactBody>& bodies, std::span<const NearPair> pairs,
                            double dt, const ContactImpulses& impulses) noexcept {
  std::int64_t passages = 0;
  for (const NearPair& pair : pairs) {
    const ContactBody& other = bodies[pair.other.body];
    const Facets::Corners& k = other.facets()->all()[pair.other.n];
    if (k[0] == k[1]) continue;  // a loose mass
    const auto start = [&](PairEnd at) { return bodies[at.body].candidates().x()[at.n]; };
    const auto moves = [&](PairEnd at) { return Vec3(dt * impulses.v_move(bodies, at)); };
    const PairEnd a{pair.other.body, k[0]}, b{pair.other.body, k[1]}, c{pair.other.body, k[2]};
    if (passes_through(start(pair.mass), moves(pair.mass), {start(a), start(b), start(c)},
                       {moves(a), moves(b), moves(c)}))
      ++passages;
  }
  return passages;
}

}  // namespace palpate::physics
