#pragma once
// What one mass has of something that several share.

#include "physics_node/body/body.h"

namespace palpate::physics {

struct MassShare {
  Index cell = 0;    // node of the body
  double share = 0;  // of a force, or of a place
};

}  // namespace palpate::physics
