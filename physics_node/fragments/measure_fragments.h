#pragma once
// What each fragment is: for reports, not for the step.

#include <vector>

#include "physics_node/fragments/fragments.h"
#include "physics_node/step/momentum_account.h"
#include "physics_node/step/node_motion.h"

namespace palpate::physics {

struct FragmentMeasure {
  Index label = 0;  // as in Fragments
  Index masses = 0;
  double mass = 0;             // [kg]
  Vec3 center = Vec3::Zero();  // of mass [m]
  Momenta momenta;             // angular: about the origin
};

/// The heaviest first; of equal ones, the one with the smaller label. One pass over the masses.
std::vector<FragmentMeasure> measure_fragments(const NodeMotion& moving, const Fragments& fragments);

/// Root mean square distance of a fragment's masses to where they rest, after the best rigid fit [m]. 0 for a fragment of
/// less than three masses, which has no shape.
double fragment_shape_rms(const NodeMotion& moving, const Fragments& fragments, Index label);

}  // namespace palpate::physics
