// palpate new VOLUME --out SCENE: a scene that presses an image, to start from.

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "common/error/error.h"
#include "common/file/privacy.h"
#include "common/math/units.h"
#include "common/process/checked_option.h"
#include "common/record/part_file.h"
#include "common/scene/device_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/tool_spec.h"
#include "deploy/palpate/image_tissue.h"
#include "deploy/palpate/scene_draft.h"
#include "deploy/palpate/subcommands.h"
#include "physics_node/remarks/first_touch.h"

namespace palpate::deploy {
namespace {

namespace fs = std::filesystem;

constexpr double bytes_of_work =
    16;  // Why: a cell is read, copied to be resampled, resampled, and kept or not

struct NewOptions {
  std::string volume, out;
  std::vector<double> at_mm, keep;
};

/// What would go wrong at the end goes wrong first.
void check_names(const NewOptions& options) {
  std::error_code none;
  if (fs::path(options.out).extension() != ".toml")
    throw InputError(fmt::format("--out {}: the name of a scene ends in .toml", options.out));
  if (fs::exists(fs::symlink_status(options.out, none)))
    throw InputError(
        fmt::format("--out {}: is there already; give another name, or take it away", options.out));
  check_volume(options.volume);
  check_can_write(options.out);
}

std::optional<KeepWindow> keep_of(const NewOptions& options) {
  if (options.keep.empty()) return std::nullopt;
  if (options.keep[0] > options.keep[1]) throw InputError("--keep: give the lowest intensity first");
  return KeepWindow{options.keep[0], options.keep[1]};
}

TouchPlace place_of(const NewOptions& options, const ImageTissue& tissue) {
  if (options.at_mm.empty()) {
    if (const auto place = best_place(tissue.cells, tissue.tip_radius)) return *place;
    throw InputError(
        fmt::format("{}: a tip of {:.3g} mm finds no even place on tissue of two cells and more that it can "
                    "come to from outside; give one "
                    "by --at x,y,z",
                    options.volume, mm_from_m(tissue.tip_radius)));
  }
  const Vec3 at(m_from_mm(options.at_mm[0]), m_from_mm(options.at_mm[1]), m_from_mm(options.at_mm[2]));
  const Vec3 end = -tissue.cells.corner;
  if ((at.cwiseAbs() - end).maxCoeff() > 1e-9)
    throw InputError(
        fmt::format("--at {:g},{:g},{:g}: lies outside of the image, which goes {:.4g}, {:.4g} and {:.4g} mm "
                    "to both sides of its "
                    "middle",
                    options.at_mm[0], options.at_mm[1], options.at_mm[2], mm_from_m(end.x()),
                    mm_from_m(end.y()), mm_from_m(end.z())));
  if (const auto place = place_near(tissue.cells, at, tissue.tip_radius)) return *place;
  throw InputError(fmt::format(
      "--at {:g},{:g},{:g}: a tip of {:.3g} mm comes to no tissue of two cells and more around it",
      options.at_mm[0], options.at_mm[1], options.at_mm[2], mm_from_m(tissue.tip_radius)));
}

/// A scene that is written has nothing to be remarked on, and its finger touches where that is planned, give or take
/// a cell.
physics::FirstTouch tried(const std::string& text, const std::string& path, const TouchPlace& place,
                          double cell) {
  const Scene scene = parse_scene(text, path);
  const physics::World world(scene);
  std::vector<std::string> remarks = world.remarks();
  for (auto& line : physics::remarks_about(world)) remarks.push_back(std::move(line));
  if (!remarks.empty()) throw InputError(remarks);
  const auto touch = physics::first_touch(world.scene(), {&world.body(0)}, world.scene().tools[0]);
  if (touch && (touch->at - place.at).norm() <= cell) return *touch;
  throw std::runtime_error(path + ": its path would miss the place; give another by --at x,y,z");
}

/// Where the path is at a time between its ends.
Vec3 place_on(const std::vector<Waypoint>& path, double t) {
  for (std::size_t n = 1; n < path.size(); ++n)
    if (t <= path[n].t)
      return path[n - 1].p + (t - path[n - 1].t) / (path[n].t - path[n - 1].t) * (path[n].p - path[n - 1].p);
  return path.back().p;
}

/// The skin lies up to half a cell from the faces that the place was found on: the path is to touch when it says.
void come_to_skin(const physics::FirstTouch& touch, TouchPlace& place, PressPlan& plan) {
  const double off = (place_on(plan.path, touch.t) - place.at).dot(place.outward);
  for (Waypoint& point : plan.path) point.p += off * place.outward;
  place.at += off * place.outward;
}

void write_new(const NewOptions& options) {
  keep_as_private_as({options.volume});
  const auto keep = keep_of(options);
  check_names(options);
  const ImageTissue tissue =
      find_tissue(read_volume_within_memory(options.volume, bytes_of_work), keep, options.volume);
  TouchPlace place = place_of(options, tissue);
  PressPlan plan = plan_press(tissue, place, options.volume);
  const std::string words =
      keep ? "as given by --keep"
           : fmt::format("halfway between air and tissue by the histogram, and what is brighter");
  const double cell = tissue.cells.spacing.norm();
  const auto draft = [&] {
    return scene_draft(named_from(options.volume, options.out), words, tissue, place, plan);
  };
  come_to_skin(tried(draft(), options.out, place, cell), place, plan);
  const std::string text = draft();
  const physics::FirstTouch touch = tried(text, options.out, place, cell);
  write_scene(text, options.out);
  fmt::print(
      "tissue       intensity {:g} to {:g}, in cells of {:.3g} x {:.3g} x {:.3g} mm, {} of which are awake "
      "at a time\n",
      tissue.keep.lo, tissue.keep.hi, mm_from_m(tissue.cells.spacing.x()),
      mm_from_m(tissue.cells.spacing.y()), mm_from_m(tissue.cells.spacing.z()), plan.n_awake);
  fmt::print(
      "touch        after {:.4g} s at ({:.4g}, {:.4g}, {:.4g}) mm, then {:.3g} mm in, with a tip of {:.3g} "
      "mm\n",
      touch.t, mm_from_m(touch.at.x()), mm_from_m(touch.at.y()), mm_from_m(touch.at.z()),
      mm_from_m(plan.depth), mm_from_m(tissue.tip_radius));
  fmt::print("speed        about {:.2g} x real time on one thread while it presses{}\n",
             plan.real_time_factor,
             plan.real_time_factor < 1 ? ": in slow motion, since so small cells take short steps" : "");
  fmt::print("scene        {}; palpate simulate {} computes it\n", options.out, options.out);
}

}  // namespace

void add_new(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("new", "write a scene that presses a volume, to start from");
  auto options = std::make_shared<NewOptions>();
  command->add_option("volume", options->volume, "volume (.h5) of palpate import")->required();
  command->add_option("--out", options->out, "the scene to write (.toml), a new file")->required();
  command
      ->add_option(
          "--at", options->at_mm,
          "where to press: x,y,z [mm] along the axes of the image from its middle, or the nearest tissue "
          "(default: a place that suits)")
      ->delimiter(',')
      ->expected(3)
      ->check(number_in({.lo = -1e6, .hi = 1e6}));
  command
      ->add_option("--keep", options->keep,
                   "lowest,highest intensity that is tissue (default: by the histogram)")
      ->delimiter(',')
      ->expected(2)
      ->check(number_in({.lo = -1e12, .hi = 1e12}));
  command->callback([options, &exit_code] {
    write_new(*options);
    exit_code = exit_ok;
  });
}

}  // namespace palpate::deploy
