#pragma once
// What the vendor's library does not say of its devices.

#include <array>

namespace palpate::haptic::forcedimension {

struct Model {
  int type;    // dhdGetSystemType
  bool wrist;  // measures an attitude
  bool gripper;
  double max_force;      // [N]
  double max_torque;     // [N m]
  double half_width;     // of the workspace, across [m]
  double half_height;    // up and down, and to and fro [m]
  double max_stiffness;  // at 1 kHz [N/m]
  double max_damping;    // [N s/m]
};

/// Stiffness and damping as CHAI3D 3.3 sets them at 1 kHz; the sizes and forces are from the data sheets.
/// delta.3; omega.3, .6 and .7; sigma.3 and .7; lambda.3 and .7; Falcon. Right and left ones are alike.
inline constexpr std::array<Model, 14> models{
    {{63, false, false, 20, 0, 0.200, 0.130, 5000, 30},
     {33, false, false, 12, 0, 0.080, 0.055, 5000, 30},
     {34, true, false, 12, 0, 0.080, 0.055, 5000, 30},
     {36, true, false, 12, 0, 0.080, 0.055, 5000, 30},
     {35, true, true, 12, 0, 0.080, 0.055, 5000, 30},
     {37, true, true, 12, 0, 0.080, 0.055, 5000, 30},
     {206, false, false, 20, 0, 0.095, 0.065, 4000, 30},
     {104, true, true, 20, 0.4, 0.095, 0.065, 4000, 30},
     {105, true, true, 20, 0.4, 0.095, 0.065, 4000, 30},
     {203, false, false, 20, 0, 0.120, 0.085, 8000, 30},
     {108, true, true, 20, 0.2, 0.120, 0.085, 8000, 30},
     {109, true, true, 20, 0.2, 0.120, 0.085, 8000, 30},
     {60, false, false, 8, 0, 0.050, 0.050, 3000, 20},
     {-1, false, false, 8, 0, 0.050, 0.050, 2000, 10}}};  // any other: careful

constexpr const Model& model_of(int type) noexcept {
  for (const Model& model : models)
    if (model.type == type) return model;
  return models.back();
}

}  // namespace palpate::haptic::forcedimension
