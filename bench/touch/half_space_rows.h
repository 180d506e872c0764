#pragma once
// The product's own contact (FacePress) on a half space, against closed forms: force over depth, radius of contact, error over cell size.

#include "bench/machine/result_folder.h"

namespace palpate::bench {

/// Prints and returns a row for each shape, kind of tissue, radius and cell size:
///   sphere    F = 4/3 E* sqrt(R) d^1.5,   radius of contact sqrt(R d)
///   cylinder  F = 2 E* R d,   its flat end's edge
/// with E* = E / (1 - nu^2), at d = 0.05, 0.1 and 0.15 R, to rest. Source: Hertz 1882; Boussinesq 1885.
nlohmann::json half_space_rows(Table& table);

/// Spheres of 3 and 5 mm on cells of 5 mm under the same force: how deep each goes.
nlohmann::json coarse_rows();

}  // namespace palpate::bench
