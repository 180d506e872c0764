// What a scene takes is said before it is taken, and nothing that stands in a scene hangs, crashes or fills
// the memory.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <regex>
#include <tuple>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/material_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/body/body.h"
#include "physics_node/forecast/memory_need.h"
#include "physics_node/forecast/speed_forecast.h"
#include "physics_node/world.h"
#include "tests/support/physics/mesh_worlds.h"

namespace palpate::physics {
namespace {

constexpr const char* clay = R"(
[material.clay]
density_kg_per_m3 = 1000
modulus_kPa = 10
)";

Scene scene_of(const std::string& body) {
  return parse_scene("[[body]]\nname = \"b\"\nmaterial = \"clay\"\n" + body + clay, "s.toml");
}

TEST(MemoryNeed, IsThatOfTheBodyAsItIsBuilt) {
  for (const char* body :
       {"shape = \"sphere\"\nradius_mm = 40\nspacing_mm = 3",
        "shape = \"box\"\nsize_mm = [90, 60, 30]\nspacing_mm = 3",
        "shape = \"box\"\nsize_mm = [90, 60, 30]\nspacing_mm = 3\nlattice = \"voxel\"",
        "shape = \"sphere\"\nradius_mm = 40\nspacing_mm = 3\nlattice = \"voxel\"",
        "shape = \"tube\"\nouter_radius_mm = 30\ninner_radius_mm = 20\nlength_mm = 100\nspacing_mm = 2",
        "shape = \"tube\"\nouter_radius_mm = 30\nwall_layers = 3\nlength_mm = 100\nspacing_mm = 3",
        "shape = \"knife\"\nlength_mm = 100\nheight_mm = 60\nspacing_mm = 1\ntheta_deg = [0, 0, 0]"}) {
    const Scene scene = scene_of(body);
    const MemoryNeed need = memory_need(scene.bodies[0], scene);
    const Lattice lattice = build_body(scene.bodies[0], scene.materials).lattice;
    EXPECT_GT(need.masses, 0.7 * lattice.n_masses()) << body;
    EXPECT_LT(need.masses, 1.4 * lattice.n_masses()) << body;
    EXPECT_GT(need.cells, 0.9 * lattice.n_cells()) << body;
    EXPECT_LT(need.cells, 2.5 * lattice.n_cells()) << body;
  }
}

/// Before its file is read its nodes are not known, and the file stands for them.
TEST(MemoryNeed, OfAMeshIsThatOfItsFileAndThenOfItsNodes) {
  const std::string file = test::mesh_file(make_tet_box({.cells = {8, 8, 8}, .edge = 0.005}));
  const Scene scene = scene_of("shape = \"mesh\"\nunit = \"mm\"\nfile = \"" + file + "\"\n");
  const MemoryNeed need = memory_need(scene.bodies[0], scene);
  EXPECT_EQ(need.masses, 0);
  EXPECT_GE(need.bytes, static_cast<double>(std::filesystem::file_size(file)));
  EXPECT_GT(bytes_of_masses(729, scene.bodies[0], scene), 729 * 8 * 3 * 8) << "places, state, six tetrahedra";
  EXPECT_THROW(refuse_too_large(scene, {{.masses = 1e9, .cells = 0, .bytes = 1e12}}, 1e9), InputError);
  const World world(scene);
  const double masses = 729;
  const SpeedForecast speed = forecast_speed(scene, {&masses, 1}, world.stable_step_seconds());
  EXPECT_GT(speed.real_time_factor, 1);
}

std::string complaint_of(const Scene& scene, double memory) {
  try {
    refuse_too_large(scene, memory);
  } catch (const InputError& error) {
    return error.complaints().at(0);
  }
  return "";
}

TEST(MemoryNeed, ATooLargeSceneIsRefusedWithWhatWouldFit) {
  constexpr double memory = 20e9;
  for (const char* shape : {"shape = \"sphere\"\nradius_mm = 500\n",
                            "shape = \"box\"\nsize_mm = [1e3, 1e3, 1e3]\nlattice = \"voxel\"\n",
                            "shape = \"box\"\nsize_mm = [1e6, 1e6, 1e6]\n"}) {
    const std::string complaint = complaint_of(scene_of(fmt::format("{}spacing_mm = 1e-3", shape)), memory);
    EXPECT_THAT(complaint, testing::StartsWith("s.toml:1:1: [[body]] \"b\" would have "));
    std::smatch fits;
    ASSERT_TRUE(std::regex_search(complaint, fits, std::regex("spacing_mm = ([-+0-9.e]+) would fit")))
        << complaint;
    EXPECT_EQ(complaint_of(scene_of(fmt::format("{}spacing_mm = {}", shape, fits[1].str())), memory), "");
  }
  EXPECT_EQ(complaint_of(scene_of("shape = \"sphere\"\nradius_mm = 40\nspacing_mm = 3"), memory), "");
}

TEST(MemoryNeed, ABillionMassesAreRefusedBeforeTheyAreBuilt) {
  const Scene scene = scene_of("shape = \"sphere\"\nradius_mm = 1000\nspacing_mm = 0.1");
  EXPECT_THROW(World{scene}, InputError);
}

TEST(SpeedForecast, RefusesAFrameOfTooManySteps) {
  Scene scene = scene_of("shape = \"sphere\"\nradius_mm = 40\nspacing_mm = 3");
  EXPECT_EQ(steps_a_frame(scene, 1e-3), 2);  // 0.8 of the stable one
  EXPECT_EQ(steps_a_frame(scene, std::numeric_limits<double>::infinity()), 1);
  EXPECT_THROW(steps_a_frame(scene, 1e-12), InputError);
  EXPECT_THROW(steps_a_frame(scene, 0), InputError);
  scene.materials[0].modulus = 1e15;
  EXPECT_THROW(World{scene}, InputError);
}

/// What elements cost is not what springs do: `palpate bench fem`, and a term of relaxation beside.
TEST(SpeedForecast, KnowsWhatElementsAreStepped) {
  Scene scene = scene_of("shape = \"sphere\"\nradius_mm = 40\nspacing_mm = 3");
  const auto speed = [&](const std::vector<double>& masses) {
    return forecast_speed(scene, masses, 1e-3).real_time_factor;
  };
  const double of_springs = speed({10000});
  EXPECT_NEAR(speed({20000}), 0.5 * of_springs, 1e-9 * of_springs);
  scene.bodies[0].model = ElementModel::fem;
  const double of_elements = speed({10000});
  EXPECT_GT(of_elements, 1.2 * of_springs);
  scene.bodies[0].hourglass = HourglassKind::isotropic;
  EXPECT_GT(speed({10000}), 1.2 * of_elements);
  scene.bodies[0].hourglass = HourglassKind::physical;
  scene.materials[0].relaxation = {{0.3, 0.1}, {0.2, 1}};
  EXPECT_LT(speed({10000}), 0.5 * of_elements);
  EXPECT_EQ(speed({}), 0);
}

// Keys of every part, each with a number.
constexpr const char* numbers = R"(title = "Numbers"
seed = 7
gravity_m_per_s2 = [0, 0.5, -9.81]
[scene]
seconds = 0.5
[physics]
safety = 0.5
threads = 1
frame_Hz = 1000
[material.clay]
mass_g = 1.0
k1_N_per_m = 100
k2_ratio = 0.5
viscosity_N_s_per_m = 0.1
drag_N_s_per_m = 0.01
yield_ratio = 1.2
break_ratio = 1.5
[material.skin]
density_kg_per_m3 = 1000
modulus_kPa = 10
viscosity_Pa_s = 2
[[body]]
name = "ball"
shape = "sphere"
radius_mm = 12
spacing_mm = 4
material = "clay"
at_mm = [0, 0, 20]
velocity_m_per_s = [0, 0, -1]
theta_deg = [10, 20, 30]
fixed = [{ min_mm = [-1, -1, 30], max_mm = [1, 1, 33] }]
[[body]]
name = "slab"
shape = "box"
lattice = "voxel"
size_mm = [30, 30, 12]
spacing_mm = 4
at_mm = [0, 0, -20]
material = "skin"
[[body.cavity]]
center_mm = [0, 0, -20]
radius_mm = 5
[[body]]
name = "vessel"
shape = "tube"
outer_radius_mm = 12
inner_radius_mm = 7
length_mm = 30
spacing_mm = 2.5
at_mm = [60, 0, 0]
material = "skin"
[[body]]
name = "hose"
shape = "tube"
outer_radius_mm = 12
wall_layers = 2
length_mm = 30
spacing_mm = 2.5
at_mm = [100, 0, 0]
material = "skin"
[[body]]
name = "blade"
shape = "knife"
length_mm = 20
height_mm = 10
theta_deg = [0, 0, 0]
spacing_mm = 2
at_mm = [0, 60, 0]
material = "skin"
[[body]]
name = "needle"
shape = "needle"
length_mm = 30
diameter_mm = 8
theta_deg = [0, 0, 0, 30]
spacing_mm = 2
at_mm = [0, 90, 0]
material = "skin"
[floor]
height_mm = -60
[[wall]]
point_mm = [-100, 0, 0]
normal = [1, 0, 0]
[contact]
restitution = 0.5
[[tool]]
name = "tip"
shape = "point"
radius_mm = 3
stiffness_N_per_m = 300
damping_N_s_per_m = 1
friction = 0.2
torque_limit_N_m = 0.1
set_point_mm = [0, 0, 0]
device = "hand"
[[tool]]
name = "rod"
shape = "stick"
radius_mm = 3
length_mm = 40
low_pass_Hz = 30
device = "hand"
[device.hand]
driver = "simulated"
rate_Hz = 1000
force_limit_N = 3
scale = 1
force_scale = 1
offset_mm = [0, 0, 0]
waypoints = [[0, 0, 0, 50], [0.5, 0, 0, 40]]
max_torque_N_m = 0.1
turn_inertia_kg_m2 = 1e-4
[render]
size_px = [640, 480]
camera = { yaw_deg = 10, pitch_deg = 10, distance_mm = 300, target_mm = [0, 0, 0], field_of_view_deg = 40 }
threshold = 10
rate_Hz = 10
most_frames = 100
most_frames_MB = 100
[record]
rate_Hz = 50
)";

/// What a scene comes to in a process of its own: 0 a frame was simulated or it would take too long, 2 a
/// complaint, else trouble.
int end_of(const std::string& text) {
  const pid_t child = fork();
  if (child == 0) {
    constexpr rlim_t memory = 2'000'000'000;
    const rlimit held{memory, memory};
    if (const char* sanitized = std::getenv("ASAN_OPTIONS"); sanitized == nullptr)
      setrlimit(RLIMIT_DATA, &held);
    alarm(50);  // Why: 10 s on a quiet machine
    try {
      const Scene scene = parse_scene(text, "s.toml");
      double masses = 0;
      for (const BodySpec& body : scene.bodies) masses += memory_need(body, scene).masses;
      refuse_too_large(scene, usable_memory());
      if (masses > 3e5) _exit(0);
      World world(scene);
      const std::vector<std::optional<ToolState>> hands(scene.tools.size());
      if (world.step_seconds() * 1e4 > world.frame_seconds()) world.frame(hands);
      _exit(0);
    } catch (const InputError& error) {
      for (const auto& line : error.complaints())
        if (!line.starts_with("s.toml") || line.find('\n') != line.npos || line.find(": ") == line.npos)
          _exit(3);
      _exit(error.complaints().empty() ? 3 : 2);
    } catch (...) {
      _exit(1);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

TEST(SceneNumbers, EveryOneEndsWithASceneOrAComplaint) {
  ASSERT_EQ(end_of(numbers), 0);
  const std::string text = numbers;
  std::string many = "[0";
  for (int i = 0; i < 20000; ++i) many += ", 0";
  many += "]";
  const std::regex number("[-+]?[0-9][0-9.e+-]*");
  int refused = 0, taken = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin), equals = text.find(" = ", begin);
    const std::string line = text.substr(begin, end - begin);
    if (equals != text.npos && equals < end) {
      const std::size_t from = equals + 3 - begin;
      for (std::sregex_iterator at(line.begin() + static_cast<std::ptrdiff_t>(from), line.end(), number),
           last;
           at != last; ++at) {
        const auto where = begin + from + static_cast<std::size_t>(at->position());
        for (const std::string& value : std::vector<std::string>{
                 "1e300", "-1e300", "nan", "inf", "-inf", "-0.0", "0", "-1", "1e-300", "1e-9", "1e9",
                 "9223372036854775807", "-9223372036854775808", "\"\"", "[]", "{}", "true", many}) {
          std::string spoilt = text;
          spoilt.replace(where, static_cast<std::size_t>(at->length()), value);
          const int ended = end_of(spoilt);
          EXPECT_TRUE(ended == 0 || ended == 2) << line << " with " << value.substr(0, 30) << ": " << ended;
          ++(ended == 2 ? refused : taken);
        }
      }
      const int twice = end_of(text.substr(0, end + 1) + line + text.substr(end));
      EXPECT_EQ(twice, 2) << line << " twice";
    }
    begin = end + 1;
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(taken, 100);
}

/// What is absurd in a material is named with its place and with what would do.
TEST(SpeedForecast, NamesTheMaterialWhoseStepIsTooShort) {
  const auto complaint = [](const std::string& density, const std::string& rest) {
    const std::string text =
        "[[body]]\nname = \"b\"\nmaterial = \"clay\"\nshape = \"box\"\nsize_mm = [30, 30, 30]\nspacing_mm = "
        "5\n"
        "[material.clay]\ndensity_kg_per_m3 = " +
        density + "\n" + rest;
    try {
      const World world(parse_scene(text, "s.toml"));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  for (const auto& [density, rest, word] :
       {std::tuple{"1000", "modulus_kPa = 1e12", "modulus_kPa of at most about"},
        std::tuple{"1000", "modulus_kPa = 10\nviscosity_Pa_s = 1e12", "viscosity_Pa_s of at most"},
        std::tuple{"1e-12", "modulus_kPa = 10", "density_kg_per_m3 of at least about"}}) {
    const std::string said = complaint(density, rest);
    EXPECT_THAT(said, testing::StartsWith("s.toml:7:")) << rest;
    EXPECT_THAT(said, testing::HasSubstr("[material.clay] of body \"b\"")) << rest;
    EXPECT_THAT(said, testing::HasSubstr(word)) << rest;
  }
}

}  // namespace
}  // namespace palpate::physics
