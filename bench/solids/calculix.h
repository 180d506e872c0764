#pragma once
// CalculiX (Debian: calculix-ccx) as a child process: a block of bricks in linear equilibrium. It works in a scratch folder.

#include <array>
#include <filesystem>
#include <functional>
#include <utility>
#include <vector>

#include "common/math/vec3.h"

namespace palpate::bench {

enum class Brick {
  quadratic,    // C3D20R: 20 nodes, 8 points
  incompatible  // C3D8I: 8 nodes and Wilson's modes
};

/// The unit cube, cut into bricks and placed in space; held where s_x = 0.
struct BrickBlock {
  Brick kind = Brick::quadratic;
  std::array<int, 3> bricks{1, 1, 1};
  std::function<Vec3(const Vec3&)> place;  // of the unit cube [m]
  double modulus = 0, poisson_ratio = 0;   // [Pa]
  double density = 0;                      // [kg/m^3]
  double gravity = 0;                      // along -z [m/s^2]
  double lift = 0;                         // on s_x = 1 along z in all, even over the unit square [N]
  bool flat = false;                       // plane strain: nothing moves along y
};

struct BrickAnswer {
  std::vector<std::pair<Vec3, Vec3>>
      end;           // of the nodes at s_x = 1: place in the unit cube, displacement [m]
  double cpu_s = 0;  // of the child

  /// Mean over all nodes of the end [m].
  Vec3 mean() const;
  /// Of the node at s. @throws std::runtime_error: none is there
  Vec3 at(const Vec3& s) const;
};

/// The program on PATH; empty: not installed.
std::filesystem::path calculix();

/// @throws std::runtime_error: no answer came
BrickAnswer solve(const BrickBlock& block);

}  // namespace palpate::bench
