#pragma once
// Tissues to try laws on: a lump, a light one, three modes with a residual, one that relaxes.

#include <cmath>
#include <vector>

#include "haptic_node/tissue/tissue_model.h"

namespace palpate::haptic {

inline TissueModel lump(double mass, double damping, double stiffness) {
  TissueModel model;
  model.n_modes = 1;
  model.modes[0] = {1 / std::sqrt(mass), stiffness / mass, damping / mass};
  return model;
}

inline std::vector<TissueModel> some_tissues() {
  TissueModel waves;
  waves.n_modes = 3;
  waves.modes[0] = {4.2, 4500, 15};
  waves.modes[1] = {4.0, 40'000, 50};
  waves.modes[2] = {3.8, 108'000, 120};
  waves.residual = 4e-4;
  TissueModel relaxing = lump(0.1, 2, 200);
  relaxing.n_branches = 2;
  relaxing.branches[0] = {200, 0.1};
  relaxing.branches[1] = {50, 5e-3};
  return {lump(0.1, 2, 200), lump(0.5, 5, 1000), lump(0.02, 0.5, 50), waves, relaxing};
}

}  // namespace palpate::haptic
