#pragma once
// The cantilever at rest, of finite elements: palpate's hexahedra, Bullet's tetrahedra and CalculiX's bricks at equal error.

#include <nlohmann/json.hpp>
#include <optional>

#include "bench/solids/resting_beam.h"

namespace palpate::bench {

/// Of six tetrahedra a cell, neo-Hookean, stepped explicitly; nothing where Bullet was not there when this was built.
std::optional<RestingBeam> bullet_beam(int cells, double poisson_ratio);

/// Runs and prints them. @param quick  the coarsest alone
nlohmann::json compare_beams(bool quick);

}  // namespace palpate::bench
