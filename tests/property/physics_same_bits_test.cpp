// The same scene gives the same bits, whatever the number of threads and the width of the vectors.
// Only sse2, which cannot fuse multiply and add, rounds otherwise.
#include <gtest/gtest.h>

#include <cstring>

#include "common/scene/load_scene.h"
#include "common/scene/material_spec.h"
#include "common/scene/scene.h"
#include "physics_node/step/lattice/element_context.h"
#include "physics_node/world.h"
#include "tests/support/physics/pressed_world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

struct Case {
  const char* lattice;
  const char* precision;
  const char* plastic;  // further keys of the material
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.lattice << " " << c.precision << " " << c.plastic;
}

const char* const elastic = "";
const char* const plastic = "\nk2_ratio = 0.2\nyield_ratio = 1.01\nbreak_ratio = 3";
const char* const breaking = "\nk2_ratio = 0.2\nyield_ratio = 1.01\nbreak_ratio = 1.05";

Recipe falling_ball(const Case& c) {
  Recipe recipe;
  recipe.lattice = c.lattice;
  recipe.precision = c.precision;
  recipe.shape = Recipe::sphere(30);
  recipe.material += std::string("\nviscosity_N_s_per_m = 0.02") + c.plastic;
  recipe.body = "velocity_m_per_s = [0.3, 0.1, -2]";
  recipe.gravity = "[0, 0, -9.81]";
  recipe.world = floor_at(-32);
  return recipe;
}

class SameBits : public testing::TestWithParam<Case> {};

TEST_P(SameBits, ForAnyNumberOfThreads) {
  std::uint64_t first = 0;
  for (const int threads : {1, 2, 3, 8}) {
    Recipe recipe = falling_ball(GetParam());
    recipe.physics = "threads = " + std::to_string(threads);
    World world(scene_of(recipe));
    ASSERT_EQ(world.threads(), threads);
    const std::uint64_t start = world.state_hash();
    while (world.report().steps < 200) world.frame({});
    ASSERT_NE(world.state_hash(), start);
    if (threads == 1) first = world.state_hash();
    EXPECT_EQ(world.state_hash(), first) << threads << " threads";
    const BodyCounts counts = world.body(0).counts();
    EXPECT_EQ(counts.yielded_masses > 0, GetParam().plastic != elastic);
    EXPECT_EQ(counts.live_elements < counts.elements, GetParam().plastic == breaking);
    EXPECT_EQ(world.report().restored, 0);
  }
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const char* lattice : {"fcc", "voxel"})
    for (const char* precision : {"single", "double"})
      for (const char* law : {elastic, plastic, breaking}) cases.push_back({lattice, precision, law});
  return cases;
}
INSTANTIATE_TEST_SUITE_P(EveryScene, SameBits, testing::ValuesIn(all_cases()));

/// What the balls above lack: a tool, two materials, the other integrators, rows that sleep.
struct OtherScene {
  const char* name;
  const char* physics;   // further keys
  const char* material;  // likewise
  bool two, pressed;
};
void PrintTo(const OtherScene& s, std::ostream* out) { *out << s.name; }

class SameBitsToo : public testing::TestWithParam<OtherScene> {};
INSTANTIATE_TEST_SUITE_P(
    Scenes, SameBitsToo,
    testing::Values(OtherScene{"verlet", "integrator = \"velocity_verlet\"", plastic, false, false},
                    OtherScene{"backward_euler", "integrator = \"backward_euler\"", plastic, false, true},
                    OtherScene{"two_materials", "", breaking, true, false},
                    OtherScene{"pressed", "", "", false, true},
                    OtherScene{"pressed_two", "integrator = \"velocity_verlet\"", "", true, true}),
    [](const auto& test) { return test.param.name; });

TEST_P(SameBitsToo, ForAnyNumberOfThreads) {
  const OtherScene& scene = GetParam();
  std::uint64_t first = 0;
  for (const int threads : {1, 2, 3, 8}) {
    Recipe recipe = pressed_slab_recipe();
    recipe.precision = "single";
    recipe.physics = std::string("threads = ") + std::to_string(threads) + "\n" + scene.physics;
    recipe.material += scene.material;
    if (!scene.pressed) recipe.body += "\nvelocity_m_per_s = [0.3, 0.1, -1]";
    if (scene.two) {
      recipe.body += "\nregions = [{ material = \"other\", center_mm = [0, 0, 0], radius_mm = 15 }]";
      recipe.world +=
          std::string("[material.other]\ndensity_kg_per_m3 = 1100\nmodulus_kPa = 5") + scene.material;
    }
    World world(scene_of(recipe));
    const std::uint64_t start = world.state_hash();
    run(world, scene.pressed ? steady_hand({0, 0, 0.3}) : std::nullopt, 60);
    ASSERT_NE(world.state_hash(), start);
    EXPECT_FALSE(world.has_stopped());
    if (threads == 1) first = world.state_hash();
    EXPECT_EQ(world.state_hash(), first) << threads << " threads";
  }
}

template <class Real>
void disturb(const Body& body, LatticeState<Real>& state) {
  shake(body, state, 1.0, 8);
  Dice dice(9);
  place_masses<Real>(body, state, [&](const Vec3& p) { return Vec3(p + dice.within(0.001)); });
}

/// What element_step gives the kernel, for a body of one material.
template <class Real>
ElementContext<Real> context_of(const Body& body, LatticeState<Real>& s) {
  ElementContext<Real> m = {};
  m.rows = body.lattice.rows.data();
  m.row_state = s.row_state.data(), m.ledger = s.ledger.data();
  m.all = s.all.data(), m.level = s.level.data(), m.up = s.up.data();
  for (std::size_t a = 0; a < 3; ++a) {
    m.u[a] = s.u[a].data(), m.f[a] = s.f[a].data();
    m.moved[a] = m.v[a] = s.v[a].data();
  }
  m.inverse_mass = s.inverse_mass.data();
  m.mask = s.mask.data();
  for (std::size_t h = 0; h < max_half; ++h)
    m.l_c[h] = s.l_c[h].data(), m.hardening[h] = s.hardening[h].data();
  m.dt = m.kick = static_cast<Real>(1e-4);
  m.g[2] = static_cast<Real>(-9.81);
  return m;
}

constexpr int n_steps = 20;

/// u and v of all masses after some steps of one instruction set's kernel.
template <class Real>
std::vector<Vec3> motion(const char* lattice, const std::string& further,
                         ElementKernel<Real> (*of)(KernelKind)) {
  Recipe recipe;
  recipe.lattice = lattice;
  recipe.shape = Recipe::sphere(42);
  recipe.material += further;
  recipe.body = "fixed = [\"-z\"]";
  const Body body = body_of(recipe);
  LatticeState<Real> state(body);
  disturb(body, state);
  const KernelKind kind{any_damped(body) ? DamperKind::axial : DamperKind::none, any_yields(body), false,
                        false};
  const auto n_rows = static_cast<Index>(body.lattice.rows.size());
  for (int n = 0; n < n_steps; ++n) of(kind)(context_of(body, state), 0, n_rows, Sweep::all);
  std::vector<Vec3> all;
  for (const Index cell : body.lattice.masses) {
    all.push_back(read(state.u, cell));
    all.push_back(read(state.v, cell));
  }
  return all;
}

/// Largest difference of two motions, over the largest number in them.
double difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = 0, size = 0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    most = std::max(most, (a[n] - b[n]).norm());
    size = std::max(size, a[n].norm());
  }
  return most / size;
}

template <class Real>
void compare_every_kernel(double of_sse2) {
  const bool wide = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  const bool widest = wide && __builtin_cpu_supports("avx512f") != 0;
  const std::string damper = "\nviscosity_N_s_per_m = 0.05";
  for (const char* lattice : {"fcc", "voxel"})
    for (const std::string& further : {std::string(), damper, std::string(plastic), plastic + damper}) {
      const auto narrow = motion<Real>(lattice, further, &sse2::element_kernel<Real>);
      if (!wide) continue;
      const auto fused = motion<Real>(lattice, further, &avx2::element_kernel<Real>);
      EXPECT_LT(difference(narrow, fused), of_sse2) << lattice << further;  // fused or not: other roundings
      if (!widest) continue;
      const auto fused_wide = motion<Real>(lattice, further, &avx512::element_kernel<Real>);
      EXPECT_EQ(std::memcmp(fused.data(), fused_wide.data(), fused.size() * sizeof(Vec3)), 0)
          << lattice << further;
    }
  testing::Test::RecordProperty("avx2", wide ? 1 : 0);
  testing::Test::RecordProperty("avx512", widest ? 1 : 0);
}

/// Two balls that break each other, and what becomes of their pieces.
std::uint64_t hash_of_crash(int threads, const char* distance) {
  World world(parse_scene(
      "gravity_m_per_s2 = [0, 0, -9.81]\n[floor]\nheight_mm = -80\n[physics]\nthreads = " +
          std::to_string(threads) + "\n[contact]\ndistance = \"" + distance +
          "\"\n[[body]]\nname = \"a\"\nshape = \"sphere\"\nradius_mm = 40\nspacing_mm = 10\nmaterial = "
          "\"m\"\n"
          "[[body]]\nname = \"b\"\nshape = \"sphere\"\nradius_mm = 40\nspacing_mm = 9\nmaterial = \"m\"\n"
          "at_mm = [5, 3, 92]\nvelocity_m_per_s = [0, 0, -4]\n"
          "[material.m]\nmass_g = 1\nk1_N_per_m = 500\nviscosity_N_s_per_m = 0.1\nyield_ratio = "
          "1.03\nbreak_ratio = 1.08\n",
      "crash.toml"));
  while (world.t() < 0.06) world.frame({});
  EXPECT_GT(world.body(0).breaks(), 20);
  EXPECT_GT(world.collisions()->tally().collisions, 100);
  return world.state_hash();
}

TEST(SameBits, OnAnyNumberOfThreadsInContact) {
  for (const char* distance : {"paper", "swept"}) {
    const auto one = hash_of_crash(1, distance);
    for (const int threads : {2, 3}) EXPECT_EQ(hash_of_crash(threads, distance), one) << distance;
  }
}

TEST(SameBits, FromEveryInstructionSetThatFuses) {
  compare_every_kernel<float>(1e-4);
  compare_every_kernel<double>(1e-12);
}

}  // namespace
}  // namespace palpate::physics::test
