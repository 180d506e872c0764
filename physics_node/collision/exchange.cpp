#include "physics_node/collision/exchange.h"

#include "physics_node/step/rebound.h"

namespace palpate::physics {

ExchangeReport exchange_velocities(const std::vector<ContactBody>& bodies, std::span<const NearPair> pairs,
                                   double e, ContactImpulses& impulses) noexcept {
  ExchangeReport report;
  for (const NearPair& pair : pairs) {
    const Candidates& a = bodies[pair.mass.body].candidates();
    const Candidates& b = bodies[pair.other.body].candidates();
    const Vec3 r = b.x()[pair.other.n] - a.x()[pair.mass.n];
    const double d = paper_distance(a, b);
    const double r2 = r.squaredNorm();
    if (!(r2 < d * d) || r2 == 0) continue;
    const Vec3 n = r / std::sqrt(r2);
    const double v_n = (impulses.v(bodies, pair.other) - impulses.v(bodies, pair.mass)).dot(n);
    const double w = a.inverse_mass(pair.mass.n) + b.inverse_mass(pair.other.n);
    if (v_n >= 0 || w == 0) continue;
    const double v_move_n = (impulses.v_move(bodies, pair.other) - impulses.v_move(bodies, pair.mass)).dot(n);
    const double J = rebound(e, v_n, v_move_n) / w;
    impulses.push(bodies, pair.mass, -J * n);
    impulses.push(bodies, pair.other, J * n);
    report.lost -= J * v_n + 0.5 * J * J * w;
    ++report.collisions;
  }
  return report;
}

}  // namespace palpate::physics
