// palpate view VOLUME: an image as tissue to look at, whole and cut open, in a window or as pictures.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "common/error/error.h"
#include "common/file/privacy.h"
#include "common/math/units.h"
#include "common/process/checked_option.h"
#include "common/record/volume.h"
#include "common/scene/load_scene.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "deploy/palpate/become_program.h"
#include "deploy/palpate/image_tissue.h"
#include "deploy/palpate/install_paths.h"
#include "deploy/palpate/patient_views.h"
#include "deploy/palpate/scene_draft.h"
#include "deploy/palpate/subcommands.h"
#include "physics_node/appearance/appearance.h"
#include "render_node/model/inside_control.h"
#include "render_node/picture.h"
#include "render_node/ui/window.h"

namespace palpate::deploy {
namespace {

namespace fs = std::filesystem;

constexpr double most_cells = 4e6;    // Why: more take seconds to draw in software, and GB
constexpr double bytes_of_work = 40;  // of a cell, at most: read, resampled, kept, drawn

struct ViewOptions {
  std::string volume, out;
  std::vector<double> keep;
  std::optional<double> inside;
  bool headless = false;
};

void check(const ViewOptions& options) {
  check_volume(options.volume);
  if (!options.keep.empty() && options.keep[0] > options.keep[1])
    throw InputError("--keep: give the lowest intensity first");
}

/// As it is stored, or of every second, third ... cell.
std::array<int, 3> partition_of(const std::array<int, 3>& size) {
  const double cells = 1.0 * size[0] * size[1] * size[2];
  const double coarser = std::max(1.0, std::ceil(std::cbrt(cells / most_cells)));
  std::array<int, 3> partition{};
  for (std::size_t a = 0; a < 3; ++a)
    partition[a] = std::max(1, static_cast<int>(static_cast<double>(size[a]) / coarser));
  return partition;
}

/// A scene without a hand. Some cells in its middle may move, since a body must have some that do.
std::string scene_text(const ViewOptions& options, const std::string& scene, const KeepWindow& keep,
                       const std::array<int, 3>& partition, const PatientView& front) {
  return fmt::format(
      R"(# {}: written by palpate view.
#   palpate run SCENE --nodes physics,render
title = {}
gravity_m_per_s2 = [0, 0, 0]

[[body]]
name       = "image"
lattice    = "voxel"
shape      = "volume"
file       = {}
partition  = [{}, {}, {}]
keep       = [{:.9g}, {:.9g}]
deformable = {{ center = "gravity", nearest = 200 }}
material   = "still"

[material.still]
density_kg_per_m3 = 1000
modulus_kPa       = 5
viscosity_Pa_s    = 1

[render]
size_px = [1280, 720]
camera  = {{ yaw_deg = {:.6g}, pitch_deg = {:.6g} }}
{})",
      in_comment(fs::path(options.volume).filename().string()),
      in_quotes(fs::path(options.volume).stem().string()), in_quotes(named_from(options.volume, scene)),
      partition[0], partition[1], partition[2], keep.lo, keep.hi, deg_from_rad(front.yaw),
      deg_from_rad(front.pitch),
      options.inside
          ? fmt::format("inside  = {:.9g}\nopacity = {:g}\n", *options.inside, render::InsideControl::veil)
          : std::string());
}

struct Look {
  const char* name;
  PatientView from;
  bool cut = false;      // across its axis, through the middle
  bool through = false;  // tissue, at what lies inside
};
std::array<Look, 6> looks_of(const PatientViews& views) {
  PatientView aside = views.front;
  aside.yaw += 0.5, aside.pitch += 0.2;
  return {{{"front", views.front},
           {"side", views.side},
           {"coronal", views.front, true},
           {"sagittal", views.side, true},
           {"axial", views.top, true},
           {"inside", aside, false, true}}};
}

/// @return their names
std::string draw_pictures(const Scene& scene, const PatientViews& views, const fs::path& out) {
  std::string names;
  const physics::World world(scene);
  physics::Appearance appearance(world, std::nullopt);
  Eigen::AlignedBox3d box;
  for (const Look& look : looks_of(views)) {
    if (look.through && !scene.render->inside) continue;
    Scene seen = scene;
    if (!look.through) seen.render->inside.reset(), seen.render->opacity = 1;
    seen.render->camera.yaw = look.from.yaw;
    seen.render->camera.pitch = look.from.pitch;
    if (look.cut) seen.render->section = SectionSpec{look.from.axis, box.center()[look.from.axis]};
    appearance.set_section(seen.render->section);
    appearance.set_inside(seen.render->inside);
    appearance.publish_anew(0);  // each picture begins with nothing
    render::Picture picture(seen);
    appearance.write_surfaces(
        {[&](const BodySurface& chunk) {
           for (std::uint32_t n = 0; n < chunk.n_vertices; ++n)
             box.extend(Vec3(chunk.position[n][0], chunk.position[n][1], chunk.position[n][2]));
           picture.take(chunk);
         },
         [&](const SurfaceChange& page) { picture.take(page); }});
    appearance.write_blocks([&](const VertexBlock& block) { picture.take(block); });
    picture.draw(0);
    picture.save_png((out / (std::string(look.name) + ".png")).string());
    names += (names.empty() ? "" : ", ") + std::string(look.name);
  }
  return names;
}

int view(const ViewOptions& options) {
  keep_as_private_as({options.volume});
  check(options);
  const std::string stem = fs::path(options.volume).stem().string();
  const fs::path out = options.out.empty() ? fs::path("out") / ("view_" + stem) : fs::path(options.out);
  const Volume volume = read_volume_within_memory(options.volume, bytes_of_work);
  const KeepWindow keep = options.keep.empty() ? find_tissue(volume, std::nullopt, options.volume).keep
                                               : KeepWindow{options.keep[0], options.keep[1]};
  const auto is_kept = [&keep](float value) {
    return static_cast<double>(value) >= keep.lo && static_cast<double>(value) <= keep.hi;
  };
  if (std::ranges::none_of(volume.intensity, is_kept))
    throw InputError(
        fmt::format("--keep {:g},{:g}: keeps no voxel of {}; palpate info says from what to what it goes",
                    keep.lo, keep.hi, options.volume));
  if (options.inside && std::ranges::none_of(volume.intensity, [&](float value) {
        return is_kept(value) && static_cast<double>(value) >= *options.inside;
      }))
    throw InputError(
        fmt::format("--inside {:g}: no voxel of {} that is kept is as intense; palpate info says from what "
                    "to what it goes",
                    *options.inside, options.volume));
  std::error_code error;
  fs::create_directories(out, error);
  if (error) throw InputError(fmt::format("--out {}: cannot be made ({})", out.string(), error.message()));
  const std::string scene_path = (out / "view.toml").string();
  const std::array<int, 3> partition = partition_of(volume.size);
  const PatientViews views = patient_views(volume);
  const std::string text = scene_text(options, scene_path, keep, partition, views.front);
  const Scene scene = parse_scene(text, scene_path);
  write_scene(text, scene_path);
  fmt::print("tissue       intensity {:g} to {:g}, in {} x {} x {} cells\n", keep.lo, keep.hi, partition[0],
             partition[1], partition[2]);
  std::fflush(stdout);
  if (!options.headless && render::display_present())
    become_program(bin_folder() / "palpate",
                   {"run", scene_path, "--nodes", "physics,render", "--out", (out / "session").string()});
  const std::string names = draw_pictures(scene, views, out);
  fmt::print("pictures     {}: {} .png\n", out.string(), names);
  return exit_ok;
}

}  // namespace

void add_view(CLI::App& app, int& exit_code) {
  auto* command =
      app.add_subcommand("view", "look at a volume, whole and cut open: in a window, or as pictures");
  auto options = std::make_shared<ViewOptions>();
  command->add_option("volume", options->volume, "volume (.h5) of palpate import")->required();
  command
      ->add_option("--keep", options->keep,
                   "lowest,highest intensity that is tissue (default: by the histogram)")
      ->delimiter(',')
      ->expected(2)
      ->check(number_in({.lo = -1e9, .hi = 1e9}));
  command
      ->add_option("--inside", options->inside,
                   "intensity from which what lies inside shows through the rest (300 HU: bone)")
      ->check(number_in({.lo = -1e9, .hi = 1e9}));
  command->add_flag("--headless", options->headless, "pictures to files instead of a window");
  command->add_option("--out", options->out, "folder of the pictures and the scene (default: out/view_NAME)");
  command->callback([options, &exit_code] { exit_code = view(*options); });
}

}  // namespace palpate::deploy
