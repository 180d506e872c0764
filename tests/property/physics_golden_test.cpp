// The state of small worlds after 200 frames, to the bit, as golden_hashes.json holds it: what is only moved about may not change
// them. PALPATE_RECORD_GOLDEN=1 writes the file anew; the commit that does so says why the bits had to change.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "common/scene/load_scene.h"
#include "physics_node/step/lattice/element_context.h"
#include "physics_node/world.h"
#include "tests/support/physics/pressed_world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

constexpr std::uint64_t n_frames = 200;

struct Golden {
  std::string name;
  std::function<Scene()> scene;
  std::function<std::optional<ToolState>(std::uint64_t)> hand;  // by frame; none where the scene has no tool
  bool breaks = false;  // whether elements must have broken at the end
};
void PrintTo(const Golden& golden, std::ostream* out) { *out << golden.name; }

const char* const yielding =
    "\nviscosity_N_s_per_m = 0.02\nk2_ratio = 0.2\nyield_ratio = 1.01\nbreak_ratio = 3";
const char* const breaking =
    "\nviscosity_N_s_per_m = 0.02\nk2_ratio = 0.2\nyield_ratio = 1.01\nbreak_ratio = 1.05";

/// A turning ball that falls on the floor within the run.
Recipe ball(const char* lattice, const char* precision, const char* integrator, const char* law) {
  Recipe recipe;
  recipe.lattice = lattice;
  recipe.precision = precision;
  recipe.physics = std::string("threads = 1\nintegrator = \"") + integrator + "\"";
  recipe.shape = Recipe::sphere(30);
  recipe.material += law;
  recipe.body = "velocity_m_per_s = [0.3, 0.1, -2]";
  recipe.gravity = "[0, 0, -9.81]";
  recipe.world = floor_at(-36);
  return recipe;
}

struct SolidKind {
  const char *name, *law, *hourglass;
  double lag_ms;  // viscosity over modulus
  bool breaks = false;
};

/// Such a ball of finite elements, with a stiffer half.
Recipe solid_ball(const char* precision, const SolidKind& kind) {
  Recipe recipe = ball("voxel", precision, "symplectic_euler", "");
  const auto material = [&kind](double modulus_kPa) {
    return fmt::format(
        "density_kg_per_m3 = 1000\npoisson_ratio = 0.45\nmodulus_kPa = {}\nviscosity_Pa_s = {}\n{}\n",
        modulus_kPa, modulus_kPa * kind.lag_ms, kind.law);
  };
  recipe.spacing_mm = 6;
  recipe.material = material(10);
  recipe.body += fmt::format(
      "\nmodel = \"fem\"\nhourglass = \"{}\"\nregions = [{{ material = \"stiff\", box_min_mm = [0, -99, "
      "-99], "
      "box_max_mm = [99, 99, 99] }}]",
      kind.hourglass);
  recipe.world += "\n[material.stiff]\n" + material(30);
  return recipe;
}

std::optional<ToolState> hand_at(std::uint64_t tick, const Vec3& p) {
  ToolState state{};
  state.tick = tick;
  state.engaged = 1;
  state.p_WT = {p.x(), p.y(), p.z()};
  state.q_WT = {1, 0, 0, 0};
  return state;
}

/// A blade that is led down into a block on the table and cuts it.
/// Why "paper": with the swept distance this scene takes minutes.
Scene cut_block(const char* lattice) {
  return parse_scene(
      std::string("gravity_m_per_s2 = [0, 0, 0]\n[physics]\nthreads = 1\n[contact]\ndistance = \"paper\"\n"
                  "[[body]]\nname = \"block\"\nshape = \"box\"\nsize_mm = [48, 32, 40]\nspacing_mm = 8\n"
                  "fixed = [\"-z\"]\nmaterial = \"gel\"\nlattice = \"") +
          lattice +
          "\"\n[[tool]]\nname = \"blade\"\nshape = \"knife\"\nlength_mm = 40\nheight_mm = 40\nspacing_mm = "
          "5\n"
          "material = \"steel\"\ndevice = \"hand\"\nset_point_mm = [20, 0, 0]\n"
          "[material.gel]\ndensity_kg_per_m3 = 1000\nmodulus_kPa = 20\nk2_ratio = 0.2\nviscosity_Pa_s = 20\n"
          "yield_ratio = 1.05\nbreak_ratio = 1.5\n"
          "[material.steel]\nmass_g = 10\nk1_N_per_m = 5000\n"
          "[device.hand]\ndriver = \"simulated\"\nwaypoints = [[0, 0, 0, 0], [1, 0, 0, 0]]\n",
      "cut.toml");
}

/// Two balls that meet off centre.
Scene two_balls(const char* lattice) {
  const std::string kind = std::string("lattice = \"") + lattice + "\"\n";
  return parse_scene(
      "gravity_m_per_s2 = [0, 0, 0]\n[physics]\nthreads = 1\n"
      "[[body]]\nname = \"left\"\nshape = \"sphere\"\nradius_mm = 20\nspacing_mm = 6\nat_mm = [-25, 0, 0]\n"
      "velocity_m_per_s = [1, 0, 0]\nmaterial = \"m\"\n" +
          kind +
          "[[body]]\nname = \"right\"\nshape = \"sphere\"\nradius_mm = 20\nspacing_mm = 6\nat_mm = [25, 6, "
          "3]\n"
          "material = \"m\"\n" +
          kind + "[material.m]\nmass_g = 1\nk1_N_per_m = 500\nviscosity_N_s_per_m = 0.05\n",
      "two_balls.toml");
}

std::vector<Golden> all_worlds() {
  std::vector<Golden> all;
  for (const SolidKind kind :
       {SolidKind{"elastic", "", "physical", 0}, SolidKind{"isotropic", "", "isotropic", 0},
        SolidKind{"damped", "", "physical", 0.2},
        SolidKind{"relaxing", "relaxation = [[0.3, 0.01], [0.2, 1]]", "physical", 0},
        SolidKind{"yields", "yield_ratio = 1.1\nk2_ratio = 0.3", "physical", 0.2},
        SolidKind{"breaks", "break_ratio = 1.15\nfracture_energy_J_per_m2 = 2", "physical", 0.2, true}})
    for (const char* precision : {"single", "double"})
      all.push_back({std::string("hexahedra_") + precision + "_" + kind.name,
                     [=] { return scene_of(solid_ball(precision, kind)); }, nullptr, kind.breaks});
  for (const char* lattice : {"fcc", "voxel"}) {
    const std::string of = lattice;
    for (const char* precision : {"single", "double"}) {
      for (const char* integrator : {"symplectic_euler", "velocity_verlet", "backward_euler"})
        all.push_back({of + "_" + precision + "_" + integrator,
                       [=] { return scene_of(ball(lattice, precision, integrator, yielding)); }, nullptr});
      all.push_back({of + "_" + precision + "_breaks",
                     [=] { return scene_of(ball(lattice, precision, "symplectic_euler", breaking)); },
                     nullptr, true});
      all.push_back({of + "_" + precision + "_pressed",
                     [=] {
                       Recipe recipe = pressed_slab_recipe();
                       recipe.lattice = lattice;
                       recipe.precision = precision;
                       recipe.physics = "threads = 1";
                       return scene_of(recipe);
                     },
                     [](std::uint64_t) {
                       return steady_hand({0, 0, 0.3});
                     }});
    }
    all.push_back({of + "_cut", [=] { return cut_block(lattice); },
                   [](std::uint64_t n) {
                     return hand_at(n + 1, {0, 0, 0.026 - 0.0001 * static_cast<double>(n)});
                   },
                   true});
    all.push_back({of + "_two_balls", [=] { return two_balls(lattice); }, nullptr});
  }
  return all;
}

std::string file_path() {
  return std::string(std::getenv("PALPATE_SOURCE")) + "/tests/property/golden_hashes.json";
}
/// avx512 gives the bits of avx2.
std::string bits() { return instruction_set() == InstructionSet::sse2 ? "sse2" : "avx2"; }
nlohmann::json golden_file() {
  std::ifstream file(file_path());
  return file ? nlohmann::json::parse(file) : nlohmann::json::object();
}

class GoldenHash : public testing::TestWithParam<Golden> {};
INSTANTIATE_TEST_SUITE_P(Worlds, GoldenHash, testing::ValuesIn(all_worlds()),
                         [](const auto& test) { return test.param.name; });

TEST_P(GoldenHash, IsAsItWas) {
  const Golden& golden = GetParam();
  World world(golden.scene());
  const std::uint64_t start = world.state_hash();
  for (std::uint64_t n = 0; n < n_frames; ++n) {
    if (!golden.hand) {
      world.frame({});
      continue;
    }
    const std::optional<ToolState> hand = golden.hand(n);
    world.frame(std::span(&hand, 1));
  }
  ASSERT_FALSE(world.has_stopped());
  ASSERT_NE(world.state_hash(), start) << "nothing moved";
  const BodyCounts counts = world.body(0).counts();
  EXPECT_EQ(counts.live_elements < counts.elements, golden.breaks);
  const std::string hash = fmt::format("{:016x}", world.state_hash());
  nlohmann::json kept = golden_file();
  if (std::getenv("PALPATE_RECORD_GOLDEN") != nullptr) {
    kept[bits()][golden.name] = hash;
    std::ofstream(file_path()) << kept.dump(2) << "\n";
    return;
  }
  ASSERT_TRUE(kept.contains(bits()) && kept[bits()].contains(golden.name))
      << golden.name << " has no hash in " << file_path();
  EXPECT_EQ(hash, kept[bits()][golden.name].get<std::string>())
      << "the bits have changed; if they had to: PALPATE_RECORD_GOLDEN=1 and PALPATE_ISA=sse2 likewise, and "
         "say why";
}

}  // namespace
}  // namespace palpate::physics::test
