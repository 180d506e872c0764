#pragma once
// Contact as printed: masses nearer than L / sqrt(3) that approach bounce off each other along their centre line.

#include <span>

#include "physics_node/collision/contact_impulses.h"

namespace palpate::physics {

struct ExchangeReport {
  std::int64_t collisions = 0;
  double lost = 0;  // kinetic energy, with a restitution below 1 [J]
};

/// For each pair in order, with r = x_j - x_i, n = r / |r|, v_n = (v_j - v_i) . n:
///   |r| < d and v_n < 0:  J = rebound(e, v_n) / (w_i + w_j),  v_i -= J w_i n,  v_j += J w_j n
/// at the beginning of a step. Momentum and, with e = 1, kinetic energy are kept by every pair.
/// Source: Wakamatsu & Honma 2011, collision of masses; EQUATIONS C-14.
/// @param e  restitution
ExchangeReport exchange_velocities(const std::vector<ContactBody>& bodies, std::span<const NearPair> pairs,
                                   double e, ContactImpulses& impulses) noexcept;

}  // namespace palpate::physics
