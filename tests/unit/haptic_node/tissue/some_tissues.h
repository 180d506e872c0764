#pragma once
// Tissues to try laws on, with their surface up: lumps, three modes with a residual, the same under a ball, one that relaxes, three whose
// contact flows; and a leaning one.
// Without friction what moves along z alone stays there.

#include <cmath>
#include <vector>

#include "haptic_node/tissue/motion_history.h"
#include "haptic_node/tissue/tissue_model.h"

namespace palpate::haptic {

inline Vec3 down(double depth) { return {0, 0, -depth}; }
inline TipSample tip_down(double depth, double speed) { return {down(depth), down(speed)}; }
inline double pressed(const TissueState& state) { return -state.force.z(); }

inline TissueModel lump(double mass, double damping, double stiffness) {
  TissueModel model;
  model.n_modes = 1;
  model.modes[0] = {down(1 / std::sqrt(mass)), stiffness / mass, damping / mass};
  return model;
}

inline std::vector<TissueModel> some_tissues() {
  TissueModel waves;
  waves.n_modes = 3;
  waves.modes[0] = {down(4.2), 4500, 15};
  waves.modes[1] = {down(4.0), 40'000, 50};
  waves.modes[2] = {down(3.8), 108'000, 120};
  waves.residual = waves.residual_across = 4e-4;
  TissueModel under_a_ball = waves;
  under_a_ball.residual = 7e-3;
  under_a_ball.growth = 15;
  TissueModel relaxing = lump(0.1, 2, 200);
  relaxing.n_branches = 2;
  relaxing.branches[0] = {200, 0.1};
  relaxing.branches[1] = {50, 5e-3};
  TissueModel viscous = under_a_ball;  // by 5 ms
  viscous.n_branches = 1;
  viscous.branches[0] = {0, 0.3e-3, 5 / 0.3};
  TissueModel flowing = under_a_ball;
  flowing.n_branches = 3;
  flowing.branches[0] = {0, 0.3e-3, 2};
  flowing.branches[1] = {600, 0.1, 0.6};
  flowing.branches[2] = {400, 1, 0.4};
  TissueModel flat = flowing;
  flat.growth = 0;
  return {lump(0.1, 2, 200),
          lump(0.5, 5, 1000),
          lump(0.02, 0.5, 50),
          waves,
          under_a_ball,
          relaxing,
          viscous,
          flowing,
          flat};
}

/// Modes that move it along its surface as well, a slope of 0.3, friction, more give across than along.
inline TissueModel leaning(double friction) {
  TissueModel model;
  model.normal = Vec3(0.3, 0, 1).normalized();
  model.friction = friction;
  model.n_modes = 3;
  model.modes[0] = {Vec3(3.1, 0.4, -1.0), 9000, 20};
  model.modes[1] = {Vec3(-0.3, 3.0, 0.8), 10'000, 25};
  model.modes[2] = {Vec3(0.6, -0.2, -3.5), 30'000, 60};
  model.residual = 6e-4;
  model.residual_across = 8e-4;
  model.n_branches = 1;
  model.branches[0] = {150, 0.05};
  return model;
}

}  // namespace palpate::haptic
