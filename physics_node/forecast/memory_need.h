#pragma once
// How much memory a scene takes, said before it is taken. An estimate from the numbers of the scene and the
// headers of its images: good to a third above some ten thousand masses, for what is meant to stop a slip of
// the keyboard, not to fill a machine to its brim.

#include <cstdint>
#include <vector>

#include "common/scene/scene_fwd.h"

namespace palpate::physics {

struct MemoryNeed {
  double masses = 0;  // of an image that deforms as a whole: unknown before it is read, 0
  double cells = 0;   // of storage; counted by 32 bits
  double bytes = 0;
};

/// Of one body. Cost: that of opening its image. @throws InputError: an image that cannot be read
MemoryNeed memory_need(const BodySpec& body, const Scene& scene);

/// State, tallies and saved states of so many masses, in contact [bytes].
double bytes_of_masses(double masses, const BodySpec& body, const Scene& scene);

/// What the program takes without any mass [bytes].
inline constexpr double bytes_of_program = 0.15e9;

/// The part of the machine's memory that a scene may take [bytes].
double usable_memory() noexcept;

/// @param needs   of each body of the scene
/// @throws InputError naming the place of the largest body, what the scene takes, what there is, and what
/// would fit
void refuse_too_large(const Scene& scene, const std::vector<MemoryNeed>& needs, double memory);

/// The same of a scene that nothing of is built yet.
void refuse_too_large(const Scene& scene, double memory);

}  // namespace palpate::physics
