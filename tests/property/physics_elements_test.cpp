// Laws of a body of finite elements: what the kernel makes of a whole body is what one element promises.

#include <gtest/gtest.h>

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <map>

#include "common/scene/scene.h"
#include "physics_node/material/stable_neo_hookean.h"
#include "physics_node/step/fem/hex_constants.h"
#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

constexpr double modulus = 10e3, density = 1000;

/// A box of cells, 10 kPa, nu 0.45.
Recipe solid_box(double x_mm, double y_mm, double z_mm, double spacing_mm) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(x_mm, y_mm, z_mm);
  recipe.spacing_mm = spacing_mm;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.45";
  recipe.body = "model = \"fem\"";
  return recipe;
}
void shake(World& world, double speed, std::uint64_t seed) {
  Dice dice(seed);
  for (const Index node : world.body(0).body().nodes())
    world.body(0).place(node, dice.within(1e-4), dice.within(speed));
  world.restart_ledger();
}
void run(World& world, double seconds) {
  for (const double end = world.t() + seconds; world.t() < end - 1e-9;) world.frame({});
}

struct Hourglassed {
  const char* hourglass;
  const char* precision;
};
void PrintTo(const Hourglassed& c, std::ostream* out) { *out << c.hourglass << " " << c.precision; }

class SolidBody : public testing::TestWithParam<Hourglassed> {
 protected:
  Recipe box(double x_mm, double y_mm, double z_mm, double spacing_mm) const {
    Recipe recipe = solid_box(x_mm, y_mm, z_mm, spacing_mm);
    recipe.body += std::string("\nhourglass = \"") + GetParam().hourglass + "\"";
    recipe.precision = GetParam().precision;
    return recipe;
  }
  bool is_double() const { return GetParam().precision == std::string("double"); }
};

TEST_P(SolidBody, LeavesTheInsideAloneWhereStrainIsUniform) {
  World world(scene_of(box(50, 40, 30, 5)));
  BodyModel& body = world.body(0);
  Eigen::Matrix3d h;
  h << 0.1, -0.05, 0.2, 0.03, -0.15, 0.08, -0.12, 0.07, 0.05;
  for (const Index node : body.body().nodes())
    body.place(node, h * body.body().rest_position(node), Vec3::Zero());
  body.advance({.dt = 1e-6}, {});
  double inside = 0, outside = 0;
  for (const Index node : body.body().nodes()) {
    const Vec3 x = body.body().rest_position(node);
    const bool is_inside = std::abs(x.x()) < 0.0249 && std::abs(x.y()) < 0.0199 && std::abs(x.z()) < 0.0149;
    (is_inside ? inside : outside) = std::max(is_inside ? inside : outside, body.velocity(node).norm());
  }
  EXPECT_GT(outside, 1e-6);
  EXPECT_LT(inside, (is_double() ? 1e-12 : 1e-5) * outside);
}

TEST_P(SolidBody, KeepsMomentumAngularMomentumAndEnergy) {
  World world(scene_of(box(50, 40, 30, 5)));
  shake(world, 0.5, 3);
  const Momenta before = world.body(0).momenta();
  const double start = world.ledger().start;
  run(world, 0.5);
  const MomentumBalance balance = world.body(0).momentum_balance();
  EXPECT_LT(balance.missing.linear.norm(), (is_double() ? 1e-12 : 1e-4) * balance.linear);
  EXPECT_LT(balance.missing.angular.norm(), (is_double() ? 1e-12 : 1e-4) * balance.angular);
  EXPECT_LT((world.body(0).momenta().linear - before.linear).norm(),
            (is_double() ? 1e-12 : 1e-4) * balance.linear);
  EXPECT_GT(start, 0);
  EXPECT_LT(world.ledger().balance_error(), 3e-3)
      << "cells shaken one against the other, by 5 % of their edges";
}

TEST_P(SolidBody, KeepsTheEnergyOfASmoothMotion) {
  Recipe recipe = box(40, 40, 40, 5);
  recipe.body += "\nfixed = [\"-z\"]";
  recipe.gravity = "[3, 0, -9.81]";
  World world(scene_of(recipe));
  run(world, 2);
  EXPECT_GT(world.ledger().kinetic + world.ledger().elastic, 1e-4);
  EXPECT_LT(world.ledger().balance_error(), 1e-4);
}

TEST_P(SolidBody, GivesTheSameBitsOnAnyNumberOfThreads) {
  std::uint64_t first = 0;
  for (const int threads : {1, 2, 3, 8}) {
    Recipe recipe = box(60, 50, 70, 5);
    recipe.material += "\nviscosity_Pa_s = 1";
    recipe.body +=
        "\nvelocity_m_per_s = [0.3, 0.1, -1]\nregions = [{ material = \"stiff\", center_mm = [0, 0, 10], "
        "radius_mm = 12 }]\n"
        "[[body.cavity]]\ncenter_mm = [10, 5, -10]\nradius_mm = 13\n"
        "[material.stiff]\ndensity_kg_per_m3 = 1200\nmodulus_kPa = 40\npoisson_ratio = 0.45\nviscosity_Pa_s "
        "= 4";
    recipe.world = floor_at(-37);
    recipe.gravity = "[0, 0, -9.81]";
    recipe.physics = "threads = " + std::to_string(threads);
    World world(scene_of(recipe));
    run(world, 0.05);
    EXPECT_EQ(world.report().restored, 0);
    if (threads == 1) first = world.state_hash();
    EXPECT_EQ(world.state_hash(), first) << threads << " threads";
  }
}

TEST_P(SolidBody, LosesToItsDamperWhatItsBooksSay) {
  Recipe recipe = box(40, 40, 40, 5);
  recipe.material += "\nviscosity_Pa_s = 2";
  recipe.body += "\nfixed = [\"-z\"]";
  recipe.gravity = "[3, 0, -9.81]";
  World world(scene_of(recipe));
  double dissipated = 0;
  for (int n = 0; n < 600; ++n) {
    world.frame({});
    const EnergyLedger ledger = world.ledger();
    EXPECT_GE(ledger.dissipated, dissipated * (1 - 1e-6)) << "what is lost stays lost; frame " << n;
    dissipated = ledger.dissipated;
  }
  EXPECT_GT(dissipated, 0);
  EXPECT_LT(world.ledger().balance_error(), is_double() ? 1e-3 : 2e-3);
}

TEST_P(SolidBody, WeighsWhatItsCellsWeigh) {
  Recipe recipe = box(50, 40, 30, 5);
  recipe.body +=
      "\nregions = [{ material = \"heavy\", box_min_mm = [-25, -20, -15], box_max_mm = [0, 20, 15] }]\n"
      "[material.heavy]\ndensity_kg_per_m3 = 3000\nmodulus_kPa = 10\npoisson_ratio = 0.45";
  recipe.gravity = "[0, 0, -10]";
  World world(scene_of(recipe));
  double mass = 0;
  for (const Index node : world.body(0).body().nodes()) mass += node_mass(world.body(0).body(), node);
  EXPECT_NEAR(mass, 0.05 * 0.04 * 0.03 * (0.5 * 1000 + 0.5 * 3000), 1e-12);
  run(world, 0.1);  // and falls as a whole
  EXPECT_NEAR(world.body(0).momenta().linear.z(), -mass * 10 * 0.1, 1e-5 * mass);
}

TEST_P(SolidBody, SurvivesAFallFasterThanItsWaves) {
  // Waves of shear run at 1.9 m/s: the lowest cells are flat before the highest have heard of the floor. The step follows.
  Recipe recipe = box(20, 20, 20, 2.5);
  recipe.body += "\nvelocity_m_per_s = [1, 0.5, -3]";
  recipe.world = floor_at(-12);
  recipe.gravity = "[0, 0, -9.81]";
  World world(scene_of(recipe));
  run(world, 0.1);
  EXPECT_EQ(world.report().restored, 0);
  EXPECT_GT(world.report().steps, 2 * 100 * 5) << "more steps than at rest";
  EXPECT_GT(world.body(0).momenta().linear.z(), 0) << "it has bounced";
  EXPECT_LT(world.ledger().balance_error(), is_double() ? 0.01 : 0.02);
}

TEST_P(SolidBody, ComesBackFromHalfItsHeight) {
  Recipe recipe = box(30, 30, 30, 5);
  recipe.material += "\nviscosity_Pa_s = 20";
  World world(scene_of(recipe));
  BodyModel& body = world.body(0);
  Dice dice(7);
  for (const Index node : body.body().nodes()) {
    const Vec3 x = body.body().rest_position(node);
    body.place(node, Vec3(0.2 * x.x(), 0.2 * x.y(), -0.5 * x.z()) + dice.within(2e-4), Vec3::Zero());
  }
  world.restart_ledger();
  EXPECT_GT(world.body(0).counts().shape_rms, 4e-3);
  run(world, 1);
  EXPECT_EQ(world.report().restored, 0);
  EXPECT_LT(world.body(0).counts().shape_rms, 1e-5);
  EXPECT_LT(world.ledger().balance_error(), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SolidBody,
                         testing::Values(Hourglassed{"physical", "double"},
                                         Hourglassed{"isotropic", "double"},
                                         Hourglassed{"physical", "single"},
                                         Hourglassed{"isotropic", "single"}));

// A cantilever under its own weight, 8 times as long as it is high, solved by itself from the element's stiffness near rest.
struct Cantilever {
  int cells;  // over its height
  double poisson_ratio;
};
class Beam {
 public:
  Beam(const Cantilever& how, HourglassKind hourglass) : n_(how.cells), edge_(height / n_) {
    const HexConstants<double> k = hex_constants<double>(
        {.modulus = modulus, .poisson_ratio = how.poisson_ratio, .hourglass = hourglass},
        Vec3::Constant(edge_));
    stiffness_ = stiffness_of(k, hourglass);
    solve();
    const double area = height * height, inertia = area * area / 12, q = density * gravity * area;
    const double shear_modulus = modulus / (2 * (1 + how.poisson_ratio)), kappa = 5.0 / 6;
    timoshenko_ = q * std::pow(length, 4) / (8 * modulus * inertia) +
                  q * length * length / (2 * kappa * shear_modulus * area);
  }
  double tip() const { return tip_; }
  double timoshenko() const { return timoshenko_; }
  double edge() const { return edge_; }
  Vec3 displacement(const Vec3& x) const {  // of the node there; x from the middle of the clamped end
    const Eigen::Vector3i at = ((x + Vec3(0, height / 2, height / 2)) / edge_).array().round().cast<int>();
    return at.x() == 0 ? Vec3::Zero() : Vec3(u_.segment<3>(3 * node(at.x(), at.y(), at.z())));
  }
  static constexpr double length = 0.16, height = 0.02, gravity = 0.001;

 private:
  using Matrix24 = Eigen::Matrix<double, 24, 24>;
  static Matrix24 stiffness_of(const HexConstants<double>& k, HourglassKind hourglass) {
    using One = Scalar<double>;
    Matrix24 K;  // by corner, then component
    constexpr double d = 1e-9;
    const auto forces = [&](std::size_t e, double size) {
      Corners<One> w{};
      w[e % 3][e / 3] = size;
      HexForces<One> out;
      if (hourglass == HourglassKind::physical)
        hex_forces<One, StableNeoHookean, true, false>(k, w, out);
      else
        hex_forces<One, StableNeoHookean, false, false>(k, w, out);
      return out;
    };
    for (std::size_t e = 0; e < 24; ++e) {
      const auto plus = forces(e, d), minus = forces(e, -d);
      for (std::size_t o = 0; o < 24; ++o)
        K(static_cast<Eigen::Index>(o), static_cast<Eigen::Index>(e)) =
            (minus.f[o % 3][o / 3] - plus.f[o % 3][o / 3]) / (2 * d);
    }
    return K;
  }
  int node(int i, int j, int k) const {
    return (i - 1) + 8 * n_ * (j + (n_ + 1) * k);
  }  // i > 0: the end is held
  void solve() {
    const int nx = 8 * n_, n_nodes = nx * (n_ + 1) * (n_ + 1);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * n_nodes);
    for (int k = 0; k < n_; ++k)
      for (int j = 0; j < n_; ++j)
        for (int i = 0; i < nx; ++i) {
          std::array<int, 8> at;
          for (int a = 0; a < 8; ++a)
            at[static_cast<std::size_t>(a)] =
                i + (a & 1) == 0 ? -1 : node(i + (a & 1), j + (a >> 1 & 1), k + (a >> 2));
          for (int a = 0; a < 8; ++a) {
            const int p = at[static_cast<std::size_t>(a)];
            if (p < 0) continue;
            f[3 * p + 2] -= density * gravity * std::pow(edge_, 3) / 8;
            for (int b = 0; b < 8; ++b) {
              const int q = at[static_cast<std::size_t>(b)];
              if (q < 0) continue;
              for (int c = 0; c < 9; ++c)
                entries.emplace_back(3 * p + c / 3, 3 * q + c % 3, stiffness_(3 * a + c / 3, 3 * b + c % 3));
            }
          }
        }
    Eigen::SparseMatrix<double> K(3 * n_nodes, 3 * n_nodes);
    K.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(K);
    u_ = solver.solve(f);
    for (int k = 0; k <= n_; ++k)
      for (int j = 0; j <= n_; ++j) tip_ -= u_[3 * node(nx, j, k) + 2] / ((n_ + 1) * (n_ + 1));
  }

  int n_;
  double edge_, tip_ = 0, timoshenko_ = 0;
  Matrix24 stiffness_;
  Eigen::VectorXd u_;
};

// Reference: CalculiX 2.20, 32 x 4 x 4 quadratic bricks (C3D20R), mean of the end face.
TEST(Cantilever, BendsAsQuadraticBricksDoFromTwoCellsOn) {
  const std::map<double, double> reference_m = {{0.3, 0.246570e-3}, {0.45, 0.242376e-3}, {0.49, 0.240330e-3}};
  const std::map<int, double> within = {{2, 0.05}, {4, 0.02}, {8, 0.005}};
  for (const auto& [nu, tip] : reference_m)
    for (const auto& [cells, bound] : within) {
      if (cells == 8 && nu != 0.45) continue;  // takes seconds
      const Beam beam({cells, nu}, HourglassKind::physical);
      std::printf("nu %.2f, %d cells: %.4f of the reference, %.4f of Timoshenko's\n", nu, cells,
                  beam.tip() / tip, beam.tip() / beam.timoshenko());
      EXPECT_NEAR(beam.tip() / tip, 1, bound) << "nu " << nu << ", " << cells << " cells";
    }
  // The fit of the isotropic stiffness is what its key says: too soft in thin parts.
  const Beam thin({2, 0.45}, HourglassKind::isotropic), thick({4, 0.45}, HourglassKind::isotropic);
  EXPECT_NEAR(thin.tip() / reference_m.at(0.45), 1.10, 0.02);
  EXPECT_NEAR(thick.tip() / reference_m.at(0.45), 1.02, 0.01);
}

TEST(Cantilever, IsAtRestInTheBodyWhereItsElementsSaySo) {
  for (const auto hourglass : {HourglassKind::physical, HourglassKind::isotropic}) {
    const Beam beam({4, 0.45}, hourglass);
    Recipe recipe = solid_box(160, 20, 20, 1e3 * beam.edge());
    recipe.body += "\nfixed = [\"-x\"]\nat_mm = [80, 0, 0]";
    if (hourglass == HourglassKind::isotropic) recipe.body += "\nhourglass = \"isotropic\"";
    World world(scene_of(recipe));
    BodyModel& body = world.body(0);
    constexpr double small = 1e-6;  // so that it is linear
    for (const Index node : body.body().nodes())
      body.place(node, small * beam.displacement(body.body().rest_position(node)), Vec3::Zero());
    constexpr double dt = 1e-6;
    body.advance({.dt = dt, .gravity = Vec3(0, 0, -small * Beam::gravity)}, {});
    double worst = 0;
    for (const Index node : body.body().nodes()) worst = std::max(worst, body.velocity(node).norm() / dt);
    EXPECT_LT(worst, 1e-3 * small * Beam::gravity) << "large deflection is not quite linear";
  }
}

}  // namespace
}  // namespace palpate::physics::test
