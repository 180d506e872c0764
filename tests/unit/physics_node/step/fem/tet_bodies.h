#pragma once
// Small bodies of tetrahedra for tests.

#include <gtest/gtest.h>

#include <random>

#include "physics_node/mesh/renumber.h"
#include "physics_node/mesh/tet_box.h"
#include "physics_node/step/fem/tetrahedra.h"

namespace palpate::physics::test {

struct TetCube {
  std::array<int, 3> cells{4, 4, 4};  // of 2.5 mm; even, where it is of second order
  bool nodal = true;
  double jitter = 0.15;
  double beta = 0;
  bool held = false;  // at the bottom
  bool two_materials = false;
  bool second_order = false;
  double poisson_ratio = 0.45;
  CubeSplit split = CubeSplit::six;
};

inline TetModel model_of(const TetCube& cube) {
  TetModel model;
  TetBox box{.cells = cube.cells, .edge = 0.0025, .split = cube.split, .jitter = cube.jitter};
  if (cube.second_order) {  // the same box with as many nodes
    for (int& cells : box.cells) cells /= 2;
    box.edge *= 2;
  }
  model.mesh = make_tet_box(box);
  model.materials = {{.poisson_ratio = cube.poisson_ratio, .nodal_pressure = cube.nodal}};
  if (cube.two_materials) {
    model.materials.push_back(
        {.modulus = 40e3, .poisson_ratio = 0.3, .density = 1500, .nodal_pressure = cube.nodal});
    for (std::size_t t = 0; t < model.mesh.tets.size() / 2; ++t) model.mesh.region[t] = 1;
  }
  model.beta = cube.beta;
  if (cube.second_order) add_middles(model.mesh);
  renumber(model.mesh);
  if (cube.held)
    for (const Vec3& x : model.mesh.nodes) model.held.push_back(x.z() < 1e-9);
  return model;
}

/// Numbers in [-1, 1), the same for the same seed.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-52 - 1; }
  Vec3 vector() {
    const double x = (*this)(), y = (*this)();
    return {x, y, (*this)()};
  }

 private:
  std::mt19937_64 engine_;
};

/// Moves all free nodes at random, by and with at most these along each axis.
template <class Real>
void stir(Tetrahedra<Real>& body, double displacement, double velocity, std::uint64_t seed = 1) {
  Dice dice(seed);
  for (Index n = 0; n < static_cast<Index>(body.n_nodes()); ++n) {
    const Vec3 u = displacement * dice.vector(), v = velocity * dice.vector();
    if (body.inverse_mass(n) > 0) body.place(n, u, v);
  }
}

/// Whatever `run` does to it keeps both momenta, to 1e-12 of what its nodes have of them.
template <class Run>
void expect_momenta_kept(Tetrahedra<double>& body, const Run& run) {
  const Momenta start = body.momenta();
  double linear = 0, angular = 0;
  for (Index n = 0; n < static_cast<Index>(body.n_nodes()); ++n) {
    const Vec3 p = body.velocity(n) / body.inverse_mass(n);
    linear += p.norm();
    angular += p.norm() * body.model().mesh.nodes[static_cast<std::size_t>(n)].norm();
  }
  run();
  const Momenta end = body.momenta();
  EXPECT_LT((end.linear - start.linear).norm(), 1e-12 * linear);
  EXPECT_LT((end.angular - start.angular).norm(), 1e-12 * angular);
}

}  // namespace palpate::physics::test
