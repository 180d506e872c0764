#pragma once
// A cantilever of hexahedra under its own weight, 8 times as long as it is high: solved at once, without stepping, from the
// stiffness that a cell has near rest.

#include <Eigen/Core>

#include "common/math/vec3.h"
#include "common/scene/element_kinds.h"

namespace palpate::bench {

struct Cantilever {
  int cells = 4;  // over its height, and over its breadth
  double poisson_ratio = 0.45;
  HourglassKind hourglass = HourglassKind::physical;
};

class HexBeam {
 public:
  static constexpr double length = 0.16, height = 0.02;                     // [m]
  static constexpr double modulus = 10e3, density = 1000, gravity = 0.001;  // [Pa, kg/m^3, m/s^2]

  /// Cost: some milliseconds at 4 cells, some seconds at 8.
  explicit HexBeam(const Cantilever& how);

  /// How far the end face has sunk, in the mean of its nodes [m].
  double tip() const { return tip_; }
  /// What a beam that bends and shears would sink [m].
  double timoshenko() const;
  /// Mean of the end face of 32 x 4 x 4 quadratic bricks (C3D20R) of CalculiX 2.20; known for Poisson's ratios 0.3, 0.45, 0.49 [m].
  double calculix() const;
  double edge() const { return edge_; }
  /// @param x  a node, from the middle of the held end [m]
  Vec3 displacement(const Vec3& x) const;

 private:
  int node(int i, int j, int k) const;
  void solve();

  Cantilever how_;
  double edge_, tip_ = 0;
  Eigen::VectorXd u_;
};

}  // namespace palpate::bench
