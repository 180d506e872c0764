#pragma once
// Abuse, from a seed: a small scene that nobody should load, and the way it is started and poked.
//
//   stiffness        10 Pa to 1 GPa, and a second material within a factor of 100 of it
//   mass             ratio of materials and of bodies up to 10^4
//   size             some 50 to 2000 masses, spacing 1 to 100 mm, both lattices
//   law              elastic; yield from 1.001 on, break; dampers of all kinds, drag
//   start            at rest; shaken; scattered up to two spacings; some masses on top of each other; turned inside out
//   load             0 to 1000 g; floor; held face; a tool at up to 100 m/s that presses with up to 1 kN
//   step             0.1 to 1.0 of the stable step; backward Euler at 1 to 100 times that
//   precision, threads, all integrators
// Of finite elements: voxels of Poisson's ratio 0 to 0.495, of either law and hourglass; some yield, some break, some relax;
// symplectic Euler, and backward Euler where it follows them.

#include <cstdint>
#include <string>

#include "common/scene/element_kinds.h"
#include "common/scene/scene.h"
#include "physics_node/world.h"

namespace palpate::bench {

enum class Start { rest, shaken, scattered, zero_length, inverted };
inline constexpr const char* start_names[] = {"rest", "shaken", "scattered", "zero_length", "inverted"};

struct StressScene {
  std::uint64_t seed = 0;
  Scene scene;
  Start start = Start::rest;
  double amount = 0;      // of scattering, in spacings; share of masses; speed [m/s]
  double tool_speed = 0;  // [m/s]
  double tool_force = 0;  // [N]; 0: no tool
  double step_ratio = 0;  // of the stable step
  int frames = 0;
};

/// @throws InputError if the scene that the dice give cannot be loaded: a mistake of this file
StressScene random_scene(std::uint64_t seed, ElementModel model = ElementModel::springs);

/// Moves the masses to where they start.
void set_start(const StressScene& stress, physics::World& world);

/// What the hand does in a frame; nothing without a tool.
std::optional<ToolState> tool_at(const StressScene& stress, const physics::World& world, int frame);

/// In a few words, for a person.
std::string describe(const StressScene& stress);

}  // namespace palpate::bench
