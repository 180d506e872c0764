#include "tests/system/supervised_run.h"

namespace palpate::test {

std::string SupervisedRun::scene_text() {
  return R"(title = "A cube and a finger"

[material.gel]
density_kg_per_m3 = 1000.0
modulus_kPa = 10

[[body]]
name = "cube"
shape = "box"
size_mm = [20, 20, 20]
lattice = "voxel"
spacing_mm = 5
material = "gel"

[[tool]]
name = "finger"
device = "hand"

[device.hand]
driver = "simulated"
waypoints = [[0, 0, 0, 30], [1, 0, 0, 8]]
)";
}

}  // namespace palpate::test
