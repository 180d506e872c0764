// The same scene gives the same bits, whatever the number of threads and the width of the vectors.
#include <gtest/gtest.h>

#include <cstring>

#include "physics_node/step/element_context.h"
#include "physics_node/world.h"
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

/// What element_step gives the kernel, written out a second time.
template <class Real>
ElementContext<Real> context_of(const Body& body, LatticeState<Real>& s) {
  ElementContext<Real> m = {};
  m.rows = body.lattice.rows.data();
  for (std::size_t a = 0; a < 3; ++a) {
    m.u[a] = s.u[a].data(), m.v[a] = s.v[a].data();
    m.next_u[a] = s.next_u[a].data(), m.next_v[a] = s.next_v[a].data();
  }
  m.inverse_mass = s.inverse_mass.data();
  m.mask = s.mask.data();
  m.dt = static_cast<Real>(1e-4);
  m.g[2] = static_cast<Real>(-9.81);
  const auto n_half = static_cast<std::size_t>(body.lattice.n_half);
  for (std::size_t d = 0; d < 2 * n_half; ++d) {
    for (std::size_t parity = 0; parity < 2; ++parity) m.offset[parity][d] = body.lattice.offset[parity][d];
    for (std::size_t a = 0; a < 3; ++a)
      m.D[a][d] = static_cast<Real>(body.lattice.rest_vector[d][static_cast<Eigen::Index>(a)]);
    m.L[d] = static_cast<Real>(body.lattice.rest_length[d]);
    m.k1[d] = static_cast<Real>(body.law.k1[d % n_half]);
    m.k2[d] = static_cast<Real>(body.law.k1[d % n_half] * body.law.k2_ratio);
    m.c[d] = static_cast<Real>(body.law.c[d % n_half]);
    m.l_c[d % n_half] = s.l_c[d % n_half].data();
    m.y_p[d % n_half] = s.y_p[d % n_half].data();
  }
  return m;
}

template <class Real>
void disturb(const Body& body, LatticeState<Real>& state) {
  shake(body, state, 1.0, 8);
  Dice dice(9);
  place_masses<Real>(body, state, [&](const Vec3& p) { return Vec3(p + dice.within(0.001)); });
}

template <class Real>
void expect_same_bits(const char* lattice, const std::string& further,
                      ElementKernel<Real> (*other)(KernelKind)) {
  Recipe recipe;
  recipe.lattice = lattice;
  recipe.shape = Recipe::sphere(42);
  recipe.material += further;
  recipe.body = "fixed = [\"-z\"]";
  const Body body = body_of(recipe);
  const KernelKind kind{body.lattice.kind == LatticeKind::fcc, body.law.damped, body.law.yields};
  const auto n_rows = static_cast<Index>(body.lattice.rows.size());
  LatticeState<Real> a(body);
  LatticeState<Real> b(body);
  disturb(body, a);
  disturb(body, b);
  sse2::element_kernel<Real>(kind)(context_of(body, a), 0, n_rows);
  other(kind)(context_of(body, b), 0, n_rows);
  double moved = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t bytes = a.next_u[axis].size() * sizeof(Real);
    EXPECT_EQ(std::memcmp(a.next_u[axis].data(), b.next_u[axis].data(), bytes), 0) << lattice << further;
    EXPECT_EQ(std::memcmp(a.next_v[axis].data(), b.next_v[axis].data(), bytes), 0) << lattice << further;
  }
  for (const Index cell : body.lattice.masses) moved += (read(a.next_v, cell) - read(a.v, cell)).norm();
  EXPECT_GT(moved, 1.0);
}

template <class Real>
void expect_same_bits_for_every_kernel(ElementKernel<Real> (*other)(KernelKind)) {
  const std::string damper = "\nviscosity_N_s_per_m = 0.05";
  for (const char* lattice : {"fcc", "voxel"})
    for (const std::string& further : {std::string(), damper, std::string(plastic), plastic + damper})
      expect_same_bits<Real>(lattice, further, other);
}

TEST(SameBits, FromEveryInstructionSetThatThisMachineRuns) {
  int compared = 0;
  if (__builtin_cpu_supports("avx2") != 0) {
    expect_same_bits_for_every_kernel<float>(&avx2::element_kernel<float>);
    expect_same_bits_for_every_kernel<double>(&avx2::element_kernel<double>);
    ++compared;
  }
  if (__builtin_cpu_supports("avx512f") != 0) {
    expect_same_bits_for_every_kernel<float>(&avx512::element_kernel<float>);
    expect_same_bits_for_every_kernel<double>(&avx512::element_kernel<double>);
    ++compared;
  }
  expect_same_bits_for_every_kernel<float>(&sse2::element_kernel<float>);  // and the narrow one from itself
  RecordProperty("instruction_sets_compared_with_sse2", compared);
}

}  // namespace
}  // namespace palpate::physics::test
