// A body of tetrahedra: forces are the slope of its energy, what is linear is exact, nothing comes from turning, momentum and
// energy stay or are booked, and the bits are the same whoever computes them.

#include "physics_node/step/fem/tetrahedra.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/unit/physics_node/step/fem/tet_bodies.h"

namespace palpate::physics {
namespace {

using test::expect_momenta_kept;
using test::model_of;
using test::stir;
using test::TetCube;

constexpr double edge = 0.0025, modulus = 10e3;        // of the bodies [m, Pa]
constexpr double force_scale = modulus * edge * edge;  // [N]

template <class Real>
std::vector<Vec3> forces_of(Tetrahedra<Real>& body) {
  std::vector<Vec3> f(body.n_nodes());
  body.forces(f);
  return f;
}
template <class Real>
void deform(Tetrahedra<Real>& body, const Eigen::Matrix3d& h, const Vec3& shift = Vec3::Zero()) {
  for (Index n = 0; n < static_cast<Index>(body.n_nodes()); ++n)
    body.place(n, h * body.model().mesh.nodes[static_cast<std::size_t>(n)] + shift, Vec3::Zero());
}
const Eigen::Matrix3d turned = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();

enum class Kind { plain, nodal, second_order };
TetCube of_kind(Kind kind, TetCube cube = {}) {
  cube.nodal = kind == Kind::nodal;
  cube.second_order = kind == Kind::second_order;
  return cube;
}

class Kinds : public testing::TestWithParam<Kind> {};
std::string name_of(const testing::TestParamInfo<Kind>& info) {
  const std::array<const char*, 3> names{"Plain", "Nodal", "SecondOrder"};
  return names[static_cast<std::size_t>(info.param)];
}
INSTANTIATE_TEST_SUITE_P(All, Kinds, testing::Values(Kind::plain, Kind::nodal, Kind::second_order), name_of);

TEST_P(Kinds, ForceIsTheSlopeOfTheEnergy) {
  Tetrahedra<double> body(model_of(of_kind(GetParam(), {.cells = {4, 2, 2}, .two_materials = true})));
  stir(body, 0.0005, 0);
  const auto f = forces_of(body);
  double most = 0;
  for (const Vec3& force : f) most = std::max(most, force.norm());
  for (Index n = 0; n < static_cast<Index>(body.n_nodes()); ++n)
    for (int a = 0; a < 3; ++a) {
      const Vec3 u = body.displacement(n);
      const auto at = [&](double d) {
        body.place(n, u + d * Vec3::Unit(a), Vec3::Zero());
        return body.energies(Vec3::Zero()).elastic;
      };
      constexpr double d = 4e-6;
      const double slope = (8 * (at(d) - at(-d)) - (at(2 * d) - at(-2 * d))) / (12 * d);
      body.place(n, u, Vec3::Zero());
      EXPECT_NEAR(-slope, f[static_cast<std::size_t>(n)][a], 1e-8 * most);
    }
}

/// Where the displacement is linear, stress is the same everywhere, and inner nodes feel nothing: over what the strain does by the
/// modulus of waves of pressure to the face of a cell. The middle stays, since the rounding of a displacement is its size's.
template <class Real>
double largest_inner_force(Kind kind) {
  Tetrahedra<Real> body(model_of(of_kind(kind, {.cells = {6, 6, 6}})));
  Eigen::Matrix3d h;
  h << 0.1, -0.2, 0.05, 0.12, -0.15, 0.08, -0.03, 0.2, 0.07;
  deform(body, h, -h * Vec3::Constant(3 * edge));
  const auto f = forces_of(body);
  double inner = 0, outer = 0;
  for (std::size_t n = 0; n < f.size(); ++n) {
    const Vec3 x = body.model().mesh.nodes[n] / edge;
    const bool is_inner = x.minCoeff() > 0.1 && x.maxCoeff() < 5.9;
    (is_inner ? inner : outer) = std::max(is_inner ? inner : outer, f[n].norm());
  }
  EXPECT_GT(outer, 0.05 * force_scale);
  const double faces = kind == Kind::second_order ? 4 : 1;  // cells are twice as wide
  return inner / (3.79 * faces * force_scale * h.norm());
}
TEST_P(Kinds, PassThePatchTestOnJitteredMeshes) {
  EXPECT_LT(largest_inner_force<double>(GetParam()), 1e-12);
  EXPECT_LT(largest_inner_force<float>(GetParam()), 1e-6);
}

template <class Real>
double largest_force_turned(Kind kind) {
  Tetrahedra<Real> body(model_of(of_kind(kind, {})));
  deform(body, turned - Eigen::Matrix3d::Identity(), Vec3(0.01, 0.02, -0.01));
  double most = 0;
  for (const Vec3& f : forces_of(body)) most = std::max(most, f.norm());
  return most / force_scale;
}
TEST_P(Kinds, TurnWithoutForce) {
  EXPECT_LT(largest_force_turned<double>(GetParam()), 1e-12);
  EXPECT_LT(largest_force_turned<float>(GetParam()), 2e-5)
      << "rounding of a displacement as large as the body";
}

TEST_P(Kinds, KeepMomentum) {
  Tetrahedra<double> body(model_of(of_kind(GetParam(), {.two_materials = true})));
  stir(body, 0.0004, 0.2);
  expect_momenta_kept(body, [&] {
    for (int n = 0; n < 300; ++n) body.step({.dt = 5e-5});
  });
}

TEST_P(Kinds, FallAsStonesDo) {
  Tetrahedra<double> body(model_of(of_kind(GetParam(), {.beta = 1e-4})));
  const Vec3 g(0.3, 0, -9.81);
  constexpr double dt = 5e-5;
  constexpr int steps = 100;
  for (int n = 0; n < steps; ++n) body.step({.dt = dt, .gravity = g});
  for (Index n = 0; n < static_cast<Index>(body.n_nodes()); ++n) {
    EXPECT_LT((body.velocity(n) - steps * dt * g).norm(), 1e-12);
    EXPECT_LT((body.displacement(n) - 0.5 * steps * (steps + 1) * dt * dt * g).norm(), 1e-14);
  }
}

TEST_P(Kinds, HoldWhatIsHeld) {
  Tetrahedra<float> body(model_of(of_kind(GetParam(), {.beta = 1e-4, .held = true})));
  for (int n = 0; n < 50; ++n) body.step({.dt = 5e-5, .gravity = Vec3(0, 0, -9.81)});
  int held = 0;
  for (Index n = 0; n < static_cast<Index>(body.n_nodes()); ++n) {
    if (body.inverse_mass(n) > 0) continue;
    EXPECT_EQ(body.displacement(n), Vec3::Zero().eval());
    ++held;
  }
  EXPECT_EQ(held, 25);
}

template <class Real>
std::uint64_t hash_after(const TetCube& cube, int threads, InstructionSet set = instruction_set()) {
  Tetrahedra<Real> body(model_of(cube), set);
  stir(body, 0.0003, 0.1);
  Team team(threads);
  for (int n = 0; n < 20; ++n)
    body.step(
        {.dt = 5e-5, .gravity = Vec3(0, 0, -9.81), .team = &team, .threads = threads, .watch = n % 4 == 3});
  EXPECT_TRUE(body.is_finite());
  return body.hash(1);
}
TEST_P(Kinds, HaveTheSameBitsOnAnyNumberOfThreads) {
  const TetCube cube =
      of_kind(GetParam(), {.cells = {12, 10, 10}, .beta = 1e-4, .held = true, .two_materials = true});
  const auto single = hash_after<float>(cube, 1), twice = hash_after<double>(cube, 1);
  for (const int threads : {2, 3, 8}) {
    EXPECT_EQ(hash_after<float>(cube, threads), single) << threads;
    EXPECT_EQ(hash_after<double>(cube, threads), twice) << threads;
  }
}
TEST_P(Kinds, HaveTheSameBitsByVectorsOfAnyWidthThatFuse) {
  if (instruction_set() != InstructionSet::avx512) GTEST_SKIP() << "no vectors of 512 bits here";
  const TetCube cube = of_kind(GetParam(), {.cells = {6, 6, 6}, .beta = 1e-4, .two_materials = true});
  EXPECT_EQ(hash_after<float>(cube, 1, InstructionSet::avx2), hash_after<float>(cube, 1));
  EXPECT_EQ(hash_after<double>(cube, 1, InstructionSet::avx2), hash_after<double>(cube, 1));
}

/// Kernels without fused operations round otherwise, and that is all.
TEST_P(Kinds, HaveTheSameForcesByVectorsThatDoNotFuse) {
  const TetModel model = model_of(of_kind(GetParam(), {.two_materials = true}));
  Tetrahedra<double> body(model), plain(model, InstructionSet::sse2);
  stir(body, 0.0004, 0);
  stir(plain, 0.0004, 0);
  const auto f = forces_of(body), same = forces_of(plain);
  for (std::size_t n = 0; n < f.size(); ++n) EXPECT_LT((f[n] - same[n]).norm(), 1e-12 * force_scale);
  EXPECT_NEAR(plain.energies({}).elastic, body.energies({}).elastic, 1e-12 * body.energies({}).elastic);
}

/// How far K + W of the leapfrog is from the energy of a dent that is let go, in the mean of the tenths of a second.
struct Drift {
  double first = 0, last = 0;
};
Drift drift_of_dent(Kind kind, double dt) {
  Tetrahedra<double> body(model_of(of_kind(kind, {.cells = {6, 6, 6}, .held = true})));
  for (Index n = 0; n < static_cast<Index>(body.n_nodes()); ++n) {
    const Vec3 x = body.model().mesh.nodes[static_cast<std::size_t>(n)];
    const double r2 = (x - Vec3(0.0075, 0.0075, 0.015)).squaredNorm();
    if (body.inverse_mass(n) > 0) body.place(n, Vec3(0, 0, -0.001 * std::exp(-r2 / 1e-4)), Vec3::Zero());
  }
  const double start = body.energies({}).elastic;
  const int steps = static_cast<int>(1 / dt), tenth = steps / 10;
  Drift drift;
  for (int n = 0; n < steps; ++n) {
    body.step({.dt = dt, .watch = true});
    const double energy = body.watch().between + body.watch().elastic + body.losses().numerical;
    if (n < tenth) drift.first += (energy / start - 1) / tenth;
    if (n >= steps - tenth) drift.last += (energy / start - 1) / tenth;
  }
  return drift;
}
/// What is not linear shifts the energy that the leapfrog keeps: by the square of the step, and no further when the dent has gone
/// through the body.
TEST_P(Kinds, KeepTheEnergyOfADent) {
  const Drift coarse = drift_of_dent(GetParam(), 6e-5), fine = drift_of_dent(GetParam(), 3e-5);
  EXPECT_LT(std::abs(coarse.last), 0.01);
  EXPECT_LT(std::abs(fine.last), 0.4 * std::abs(coarse.last));
  EXPECT_LT(std::abs(fine.last), 2.5e-3);
}
TEST_P(Kinds, KeepTheEnergyOfASmoothMotion) {
  const Vec3 g(3, 0, -9.81);
  Tetrahedra<double> body(model_of(of_kind(GetParam(), {.cells = {6, 6, 6}, .held = true})));
  double most = 0, off = 0;
  for (int n = 0; n < 20'000; ++n) {
    body.step({.dt = 5e-5, .gravity = g, .watch = true});
    const Watch w = body.watch();
    most = std::max(most, std::abs(w.fallen_before));
    off = std::max(off, std::abs(w.between + w.elastic + body.losses().numerical - w.fallen_before));
  }
  EXPECT_GT(most, 1e-6);
  EXPECT_LT(off, 1e-4 * most);
}

/// What the damper takes is booked, by its forces as where something may strike: what there is and what was lost are what there was.
TEST_P(Kinds, BookWhatTheDamperTakes) {
  for (const double size : {1e-6, 3e-4}) {
    Tetrahedra<double> body(model_of(of_kind(GetParam(), {.beta = 1e-4, .held = true})));
    stir(body, size, 0);
    const double start = body.energies({}).elastic;
    const double dt = 2e-5;
    double lost_before = 0;
    for (int n = 0; n < 2000; ++n) {
      body.step({.dt = dt, .gravity = Vec3::Zero(), .watch = true, .struck = true});
      const double there = body.watch().between + body.watch().elastic, lost = body.losses().viscous;
      EXPECT_NEAR(there + lost + body.losses().numerical, start, (size < 1e-5 ? 1e-5 : 2e-3) * start);
      EXPECT_GE(lost, lost_before - 1e-12 * start);
      lost_before = lost;
    }
    EXPECT_GT(lost_before, 0.9 * start);
  }
}
TEST_P(Kinds, BookGravity) {
  Tetrahedra<double> body(model_of(of_kind(GetParam(), {.beta = 1e-4, .held = true})));
  double most = 0;
  for (int n = 0; n < 1000; ++n) {
    body.step({.dt = 2e-5, .gravity = Vec3(0, 0, -9.81), .watch = true});
    const Watch& w = body.watch();
    most = std::max(most, w.fallen);
    const double off =
        w.between + w.elastic + body.losses().viscous + body.losses().numerical - w.fallen_before;
    EXPECT_LT(std::abs(off), 1e-3 * most + 1e-15);
  }
  const Energies now = body.energies(Vec3(0, 0, -9.81));
  EXPECT_NEAR(-now.gravitational, body.watch().fallen, 1e-12 * most);
  EXPECT_NEAR(now.kinetic, body.watch().kinetic, 1e-9 * most);
}

TEST_P(Kinds, StayFiniteInsideOut) {
  Tetrahedra<float> body(model_of(of_kind(GetParam(), {.beta = 1e-5})));
  test::Dice dice(4);
  for (Index n = 0; n < static_cast<Index>(body.n_nodes()); ++n)
    body.place(n, -1.8 * body.model().mesh.nodes[static_cast<std::size_t>(n)] + 0.001 * dice.vector(),
               Vec3::Zero());
  StepOutcome outcome;
  for (int n = 0; n < 500; ++n) outcome = body.step({.dt = 2e-5, .watch = true});
  EXPECT_TRUE(body.is_finite());
  EXPECT_TRUE(body.watch().is_finite());
  EXPECT_LT(outcome.least_corner_J, 0) << "it was inside out";
}

/// Where strain is uniform the bound is that of the law; at rest it is one.
TEST_P(Kinds, SayHowMuchStifferTheyAreThanAtRest) {
  Tetrahedra<double> body(model_of(of_kind(GetParam(), {})));
  EXPECT_NEAR(body.step({.dt = 1e-9, .watch = true}).stiffening, 1, 1e-9);
  const Eigen::Matrix3d h = Vec3(0.3, -0.4, 0.1).asDiagonal();
  deform(body, h);
  Tensor<double> t{};
  for (std::size_t a = 0; a < 3; ++a) t[a][a] = h.diagonal()[static_cast<Eigen::Index>(a)];
  const StableNeoHookean<Scalar<double>> law{modulus / 2.9, modulus * 0.45 / (1.45 * 0.1)};
  const StepOutcome outcome = body.step({.dt = 1e-9, .watch = true});
  EXPECT_NEAR(outcome.stiffening, law.stiffness(t) / law.stiffness({}), 1e-6);
  EXPECT_NEAR(outcome.least_corner_J, 1.3 * 0.6 * 1.1, 1e-9);
}

}  // namespace
}  // namespace palpate::physics
