#include "deploy/palpate/scene_draft.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "common/error/error.h"
#include "common/math/angles.h"
#include "common/math/units.h"
#include "common/record/part_file.h"

namespace palpate::deploy {

std::string in_quotes(const std::string& text) {
  std::string out = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') out += '\\';
    if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f)
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(static_cast<unsigned char>(letter)));
    else
      out += letter;
  }
  return out + "\"";
}

std::string in_comment(std::string text) {
  for (char& letter : text)
    if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f) letter = '?';
  return text;
}

namespace {

namespace fs = std::filesystem;

constexpr double camera_aside_deg = 55,
                 camera_above_deg = 20;  // Why: from the side the dent and the tip are both seen
constexpr double below = -0.5;           // outward z of a place that is seen from below only
constexpr double camera_sizes = 1.4;     // away, in diagonals of the image

std::string in_mm(const Vec3& p) {
  const auto rounded_to_nm = [](double m) { return std::round(1e9 * m) * 1e-6 + 0.0; };  // + 0.0: no -0
  return fmt::format("{:.7g}, {:.7g}, {:.7g}", rounded_to_nm(p.x()), rounded_to_nm(p.y()),
                     rounded_to_nm(p.z()));
}

std::string path_words(const PressPlan& plan) {
  std::string text;
  for (const Waypoint& point : plan.path)
    text +=
        fmt::format("{}[{:.4g}, {}]", text.empty() ? "[" : ",\n                 ", point.t, in_mm(point.p));
  return text + "]";
}

/// Yaw 0 stands on the -y side, and the camera looks at the place from where the tip comes, turned aside.
std::string camera_words(const ImageTissue& tissue, const TouchPlace& place) {
  const Vec3 extent = tissue.cells.spacing.cwiseProduct(tissue.cells.size.cast<double>());
  const double yaw = deg_from_rad(std::atan2(place.outward.x(), -place.outward.y())) + camera_aside_deg;
  return fmt::format("{{ yaw_deg = {:.0f}, pitch_deg = {:.0f}, target_mm = [{}], distance_mm = {:.4g} }}",
                     yaw, place.outward.z() < below ? -camera_above_deg : camera_above_deg, in_mm(place.at),
                     mm_from_m(camera_sizes * extent.norm()));
}

std::string body_lines(const std::string& file, const std::string& words, const ImageTissue& tissue,
                       const PressPlan& plan) {
  return fmt::format(
      R"([[body]]
name       = "tissue"
lattice    = "voxel"
model      = "fem"
shape      = "volume"
file       = {}
partition  = [{}, {}, {}]              # cells of {} mm
keep       = [{:.6g}, {:.6g}]          # {}
largest_component = true               # what is apart from the largest piece is left out
border_cells = "filled"                # cells that the skin goes through are as stiff as they are full
at_mm      = [0, 0, 0]
material   = "soft"
# All of it gives way wherever it is touched; what is near to the finger is computed, here {} cells, and a soft rim stands for
# the rest: {:.2g} times real time by forecast, pressed, on one thread.
deformable = {{ awake_mm = {:.4g} }}
# What lies opposite is held.
fixed      = [{{ min_mm = [{}], max_mm = [{}] }}]
)",
      in_quotes(file), tissue.partition[0], tissue.partition[1], tissue.partition[2],
      in_mm(tissue.cells.spacing), tissue.keep.lo, tissue.keep.hi, words, plan.n_awake, plan.real_time_factor,
      mm_from_m(plan.awake), in_mm(plan.held.min()), in_mm(plan.held.max()));
}

std::string material_lines(const MaterialSpec& soft) {
  return fmt::format(
      R"([material.soft]
# An image does not say how stiff tissue is. 5 kPa lies between fat and resting muscle; 2 to 20 are all soft tissue.
# All of `keep` is of it, bone too: modulus_by_intensity in place of modulus_kPa tells them apart.
density_kg_per_m3 = {:.6g}
modulus_kPa       = {:.6g}
poisson_ratio     = {:.6g}
viscosity_Pa_s    = {:.3g}
)",
      *soft.density, 1e-3 * *soft.modulus, soft.poisson_ratio, *soft.viscosity_bulk);
}

std::string hand_lines(const ImageTissue& tissue, const TouchPlace& place, const PressPlan& plan) {
  return fmt::format(
      R"([[tool]]
name              = "finger"
shape             = "point"
radius_mm         = {:.4g}
force_model       = "tissue"            # presses by the hand's own motion
stiffness_N_per_m = 400
damping_N_s_per_m = 1
device            = "hand"
set_point_mm      = [{}]

[device.hand]
driver        = "simulated"            # of a real device: its driver, docs/device.md
rate_Hz       = 1000
force_limit_N = 3
hand          = "rigid"                # follows the path; "arm" gives way as an arm does
# [s, mm, mm, mm]: from {:.3g} mm outside along the normal to the surface, {:.3g} mm in, held, and back.
waypoints     = {}
)",
      mm_from_m(tissue.tip_radius), in_mm(place.at), mm_from_m(approach_length(tissue.tip_radius)),
      mm_from_m(plan.depth), path_words(plan));
}

}  // namespace

std::string scene_draft(const std::string& file, const std::string& words, const ImageTissue& tissue,
                        const TouchPlace& place, const PressPlan& plan) {
  const std::string name = fs::path(file).stem().string();
  return fmt::format(
             R"(# A finger presses {}: written by palpate new, to be changed.
#   palpate info SCENE       what it takes, and when the finger touches
#   palpate simulate SCENE   computes it
#   palpate run SCENE        the same at the pace of a hand, in a window
# The axes of the world are those of the image, and its middle is the origin.

title = {}
gravity_m_per_s2 = [0, 0, 0]           # an image shows tissue as its weight has left it

[scene]
seconds = {:.4g}

[physics]
precision = "single"
safety    = {:g}
frame_Hz  = 1000

)",
             in_comment(name), in_quotes("A finger on " + name), plan.path.back().t + 0.5, step_safety) +
         body_lines(file, words, tissue, plan) + "\n" + material_lines(plan.material) + "\n" +
         hand_lines(tissue, place, plan) +
         fmt::format(R"(
[render]
size_px = [1280, 720]
camera  = {}

[record]
what    = ["positions", "forces", "energy"]
rate_Hz = 20
)",
                     camera_words(tissue, place));
}

std::string named_from(const std::string& volume, const std::string& scene) {
  std::error_code trouble;
  const fs::path folder = fs::path(scene).parent_path();
  const fs::path named = fs::relative(volume, folder.empty() ? fs::path(".") : folder, trouble);
  if (!trouble && !named.empty() && fs::equivalent((folder / named).lexically_normal(), volume, trouble))
    return named.string();
  return fs::absolute(volume).string();
}

void write_scene(const std::string& text, const std::string& path) {
  PartFile beside(path);
  std::FILE* file = std::fopen(beside.part().c_str(), "w");
  const bool written = file != nullptr && std::fputs(text.c_str(), file) >= 0;
  if (file == nullptr || std::fclose(file) != 0 || !written)
    throw InputError(path + ": cannot be written; make room or name another place");
  beside.commit();
}

}  // namespace palpate::deploy
