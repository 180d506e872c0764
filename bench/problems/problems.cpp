#include "bench/problems/problems.h"

namespace palpate::bench {

const std::vector<Problem>& problems() {
  static const std::vector<Problem> all = {
      {"oscillation", "amplitude", 0.04, 9, true, false, oscillation},
      {"creep", "final stretch", 0.008, 9, true, false, creep},
      {"breaking", "rest length", 0.01, 9, false, false, breaking},
      {"chain_wave", "frequency", 0.02, 7, true, false,
       [](const Settings& settings) { return chain_wave(settings, 12, 2); }},
      {"bar_fcc", "largest displacement", 6e-6, 2, false, false,
       [](const Settings& settings) { return bar_stretch(settings, LatticeKind::fcc); }},
      {"bar_voxel", "largest displacement", 6e-6, 2, false, false,
       [](const Settings& settings) { return bar_stretch(settings, LatticeKind::voxel); }},
      {"cube_drop_fcc", "displacement, rms", 8e-4, 5, true, true,
       [](const Settings& settings) { return cube_drop(settings, LatticeKind::fcc, 0.005); }},
      {"cube_drop_voxel", "displacement, rms", 8e-4, 5, true, true,
       [](const Settings& settings) { return cube_drop(settings, LatticeKind::voxel, 0.005); }},
      {"vessel_release", "displacement, rms", 1.2e-2, 5, true, false, vessel_release},
  };
  return all;
}

}  // namespace palpate::bench
