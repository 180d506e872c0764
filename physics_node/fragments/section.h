#pragma once
// How many elements it takes to cut a body through.

#include <cstdint>

#include "physics_node/body/body.h"

namespace palpate::physics {

/// Elements of the body at rest, springs or cells, that cross the plane through its centre of mass across its longest principal
/// axis: what a cut through its middle breaks. At least 1. Cost: two passes over the masses; for reports.
std::int64_t middle_section(const Body& body);

}  // namespace palpate::physics
