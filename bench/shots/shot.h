#pragma once
// A small hard sphere shot at a plate, a tube or a sphere that bends and never breaks; and whether it went through.

#include <cstdint>
#include <string>

#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"

namespace palpate::bench {

struct Shot {
  std::uint64_t seed = 0;
  double speed = 0;  // [m/s]
  std::string target;
  Scene scene;
};

/// What the bullet is shot at, how and how fast (0.1 m/s to fastest, evenly in its logarithm), from nothing but the seed.
/// Spacings, stiffness and mass differ by factors up to 4, 300 and 100.
Shot random_shot(std::uint64_t seed, double fastest, ContactDistance distance);

struct ShotResult {
  std::uint64_t seed = 0;
  double speed = 0;  // [m/s]
  std::string target;
  std::int64_t collisions = 0;
  std::int64_t stopped = 0;    // masses that had to be made to move together
  std::int64_t passages = 0;   // masses that went through a facet, counted in every step
  std::int64_t overflows = 0;  // pairs that contact had no room for
  std::int64_t restored = 0;   // by the guard
  int inside = 0;              // masses of either surface that end inside the other body
  int spilled =
      0;  // inner masses of the bullet that end inside the target: it was beaten out of its own skin

  bool passes() const { return passages == 0 && overflows == 0 && restored == 0 && inside == 0; }
};

/// Shoots, and waits until the bullet could have crossed the target.
ShotResult run_shot(const Shot& shot);

}  // namespace palpate::bench
