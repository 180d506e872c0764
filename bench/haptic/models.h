#pragma once
// Devices, hands and objects of the matrix that the haptic loop must bear, as masses, springs and dampers.

#include <array>
#include <span>

namespace palpate::bench {

/// As seen at the handle. Values: published data sheets where there are any, rounded; see docs/haptics.md.
struct DeviceModel {
  const char* name;
  double mass;         // [kg]
  double damping;      // viscous [N s/m]
  double friction;     // Coulomb [N]
  double resolution;   // of a coordinate [m]; 0: none
  double force_limit;  // peak [N]
};

/// What holds the handle: mass, damping and stiffness toward where the hand wants to be.
struct HandSpring {
  const char* name;
  double mass;       // [kg]
  double damping;    // [N s/m]
  double stiffness;  // [N/m]; 0: no hand, the handle is pushed down by a constant force instead
};

/// One mass on a spring and a damper. mass 0: does not give.
struct ObjectModel {
  const char* name;
  double mass;       // [kg]
  double damping;    // [N s/m]
  double stiffness;  // [N/m]
};

inline constexpr std::array<DeviceModel, 4> device_models{{{"Touch", 0.045, 0.3, 0.26, 55e-6, 3.3},
                                                           {"Premium", 0.075, 0.02, 0.04, 30e-6, 8.5},
                                                           {"omega", 0.2, 1.0, 0.3, 10e-6, 12.0},
                                                           {"frictionless", 0.045, 0.3, 0.0, 0.0, 3.3}}};
inline constexpr std::array<HandSpring, 4> hand_springs{{{"pinch", 0.02, 1.0, 100.0},
                                                         {"arm", 0.554, 6.45, 135.0},
                                                         {"firm", 0.15, 5.0, 700.0},
                                                         {"none", 0.0, 0.0, 0.0}}};
/// All but none.
inline constexpr std::span<const HandSpring> holding_hands{hand_springs.data(), 3};
inline constexpr std::array<ObjectModel, 4> object_models{
    {{"static", 0.0, 0.0, 0.0}, {"O1", 0.1, 2.0, 200.0}, {"O2", 0.5, 5.0, 1000.0}, {"O3", 0.02, 0.5, 50.0}}};

}  // namespace palpate::bench
