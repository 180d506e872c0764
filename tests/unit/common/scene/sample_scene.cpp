#include "tests/unit/common/scene/sample_scene.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "common/error/error.h"
#include "common/scene/load_scene.h"
#include "common/scene/scene.h"

namespace palpate::test {
namespace fs = std::filesystem;

const char* const full_scene = R"(title = "Every key"
seed = 7
gravity_m_per_s2 = [0, 0.5, -9.81]

[physics]
integrator = "velocity_verlet"
step_ms = 0.25
safety = 0.5
precision = "double"
threads = 2
frame_Hz = 500

[material.skin]
density_kg_per_m3 = 1060.0
modulus_kPa = 20
k2_ratio = 0.5
viscosity_Pa_s = 150.0

[material.clay]
mass_g = 2.0
k1_N_per_m = 800
viscosity_N_s_per_m = 0.5
yield_ratio = 1.2
break_ratio = 1.5

[[body]]
name = "head"
shape = "volume"
file = "scan.h5"
keep = [-200, 3071]
partition = [120, 120, 70]
deformable = { center_voxel = [60, 20, 35], radius_voxels = 12 }
largest_component = true
material = "skin"

[[body]]
name = "ball"
shape = "sphere"
radius_mm = 20
lattice = "fcc"
spacing_mm = 4
material = "clay"
at_mm = [0, 0, 100]
velocity_m_per_s = [1, 0, -2]
fixed = ["-z", { min_mm = [-1, -2, -3], max_mm = [1, 2, 3] }, "+x"]

[[body]]
name = "slab"
shape = "box"
size_mm = [10, 20, 30]
lattice = "voxel"
spacing_mm = 1.5
material = "skin"

[[body]]
name = "vessel"
shape = "tube"
outer_radius_mm = 5
inner_radius_mm = 3
length_mm = 40
axis = "x"
spacing_mm = 1
material = "skin"

[floor]
height_mm = -50

[contact]
enabled = false
distance = "paper"

[[tool]]
name = "tip"
shape = "point"
device = "right"
set_point_mm = [1, 2, 3]
radius_mm = 2
stiffness_N_per_m = 500
damping_N_s_per_m = 2

[device.right]
driver = "simulated"
rate_Hz = 1000
force_limit_N = 3.3
rotation = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
scale = 2.0
force_scale = 0.5
offset_mm = [10, 0, 0]
waypoints = [[0, 0, 0, 50], [1.5, 0, 0, 40]]
hand = "pinch"

[device.left]
driver = "omni"
serial = "A12"
port = 3
gain = 0.5
quiet = true

[render]
size_px = [640, 480]
camera = { yaw_deg = 90, pitch_deg = 30, distance_mm = 400, target_mm = [0, 0, 10], field_of_view_deg = 45 }
threshold = 226
show = ["force", "wire", "fragments"]
rate_Hz = 25
most_frames = 50
most_frames_MB = 20
inside = 300
opacity = 0.4

[record]
what = ["positions"]
rate_Hz = 100

[scene]
seconds = 12.5
)";

const char* const least_scene = R"([material.a]
mass_g = 1
k1_N_per_m = 10
[[body]]
name = "b"
shape = "sphere"
radius_mm = 5
spacing_mm = 1
material = "a"
)";

namespace {

struct Folder {
  std::string path = (fs::temp_directory_path() / ("palpate_scene_" + std::to_string(getpid()))).string();
  Folder() {
    fs::create_directories(path);
    for (const char* file : {"/scan.h5", "/organ.msh"})
      std::ofstream(path + file) << "only its presence is looked at";
  }
  ~Folder() {
    std::error_code error;
    fs::remove_all(path, error);
  }
};

}  // namespace

const std::string& scene_folder() {
  static const Folder folder;
  return folder.path;
}

std::vector<std::string> complaints_about(const std::string& text, const std::vector<std::string>& settings) {
  const auto folder = scene_folder() + "/";
  try {
    parse_scene(text, folder + "s.toml", settings);
  } catch (const InputError& error) {
    auto lines = error.complaints();
    for (auto& line : lines)
      for (auto at = line.find(folder); at != line.npos; at = line.find(folder))
        line.erase(at, folder.size());
    return lines;
  }
  return {};
}

Scene parsed(const std::string& text, const std::vector<std::string>& settings) {
  EXPECT_THAT(complaints_about(text, settings), testing::IsEmpty()) << text;
  return parse_scene(text, scene_folder() + "/s.toml", settings);
}

}  // namespace palpate::test
