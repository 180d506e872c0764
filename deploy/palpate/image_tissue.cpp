#include "deploy/palpate/image_tissue.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/error/error.h"
#include "common/record/volume_facts.h"
#include "deploy/palpate/air_threshold.h"
#include "deploy/palpate/info.h"
#include "physics_node/forecast/memory_need.h"

namespace palpate::deploy {
namespace {

using physics::Cells;
using physics::Vec3i;

constexpr double survey_cells = 1e6;  // Why: enough to tell thick tissue from thin, and soon looked through
constexpr double most_cells =
    4e6;  // of the scene. Why: what does not move is drawn, too, and a quarter of a million of facets is enough
constexpr double largest_tip =
    5e-3;  // [m]. Why: half a finger's pad; what is felt under it lies in a centimetre or two
// Volume over surface of a ball is a third of its radius, of a plate half of its thickness, and faces of cells are
// half as much again as a ball's surface. Why 0.6: the tip then is a seventh of a ball, three tenths of a plate, and
// has its 5 mm on a head.
constexpr double tip_to_depth = 0.6;
constexpr double cell_to_tip =
    0.5;  // Why: such cells follow a tip (README.md), and finer ones take more and shorter steps
constexpr std::size_t fewest_cells = 200;  // Why: less is smaller than what has to hold it
constexpr double most_filled = 0.95;       // of the image, as physics_node/remarks says

std::array<int, 3> partition_for(const Volume& volume, double edge) {
  std::array<int, 3> partition{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double length = volume.size[axis] * volume.spacing[static_cast<Eigen::Index>(axis)];
    partition[axis] = std::clamp(static_cast<int>(std::lround(std::min(length / edge, 5000.0))), 1, 4096);
  }
  return partition;
}

/// @param in_world  x turned round where the axes of the image are left-handed, as the body will be
Cells tissue_of(const Volume& volume, const KeepWindow& keep, bool in_world) {
  Cells cells;
  cells.size = {volume.size[0], volume.size[1], volume.size[2]};
  cells.spacing = volume.spacing;
  cells.corner = -0.5 * cells.spacing.cwiseProduct(cells.size.cast<double>());
  cells.filled.resize(volume.n_cells());
  for (std::size_t n = 0; n < cells.filled.size(); ++n) {
    const auto value = static_cast<double>(volume.intensity[n]);
    cells.filled[n] = value >= keep.lo && value <= keep.hi ? 1 : 0;
  }
  physics::keep_largest_component(cells);
  if (!in_world || !volume.is_left_handed()) return cells;
  for (auto row = cells.filled.begin(); row != cells.filled.end(); row += volume.size[0])
    std::reverse(row, row + volume.size[0]);
  return cells;
}

/// Of the tissue, over the faces that look at air within the image [m]; 0: none does.
double volume_over_surface(const Cells& cells) {
  double area = 0;
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i)
        for (Eigen::Index axis = 0; axis < 3 && cells.is_filled(i, j, k); ++axis)
          for (const int side : {-1, 1}) {
            const Vec3i at = Vec3i(i, j, k) + side * Vec3i::Unit(axis);
            if (cells.inside(at.x(), at.y(), at.z()) && !cells.is_filled(at.x(), at.y(), at.z()))
              area += cells.spacing.prod() / cells.spacing[axis];
          }
  return area > 0 ? static_cast<double>(cells.n_filled()) * cells.spacing.prod() / area : 0;
}

/// Three digits, away from the intensities of the image.
KeepWindow rounded(double lo, double highest, double range) {
  const double unit = std::pow(10.0, std::floor(std::log10(range)) - 2);
  return {std::round(lo / unit) * unit, std::ceil(highest / unit) * unit};
}

KeepWindow window_of(const Volume& volume, const std::string& path) {
  const auto threshold = air_threshold(volume.intensity);
  if (threshold)
    return rounded(threshold->intensity, threshold->highest, threshold->highest - threshold->lowest);
  const auto [lo, hi] = std::minmax_element(volume.intensity.begin(), volume.intensity.end());
  throw InputError(fmt::format(
      "{}: its intensities, {:g} to {:g}, do not fall into air and tissue; give --keep lowest,highest of the "
      "tissue",
      path, static_cast<double>(*lo), static_cast<double>(*hi)));
}

/// @throws InputError  tissue that no tip can come to, or that is none
void check_tissue(const Cells& cells, const KeepWindow& keep, const std::string& path) {
  const std::size_t n = cells.n_filled();
  const std::string kept = fmt::format("{}: intensities from {:g} to {:g} are", path, keep.lo, keep.hi);
  if (n < fewest_cells)
    throw InputError(fmt::format(
        "{} {} joined cells, fewer than the {} that a touch takes; give another --keep lowest,highest, or "
        "import the image with a finer --partition",
        kept, n, fewest_cells));
  if (static_cast<double>(n) > most_filled * static_cast<double>(cells.filled.size()))
    throw InputError(
        fmt::format("{} {:.0f} % of the image, which leaves no air to come from; import more of what is "
                    "round it, or give "
                    "another --keep lowest,highest",
                    kept, 100.0 * static_cast<double>(n) / static_cast<double>(cells.filled.size())));
}

}  // namespace

void check_volume(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none))
    throw InputError(fmt::format("{}: no such file; give a volume that palpate import has written", path));
  if (!is_volume(path))
    throw InputError(fmt::format("{}: is no volume; give one that palpate import has written", path));
}

Volume read_volume_within_memory(const std::string& path, double bytes_a_cell) {
  const VolumeFacts facts = volume_facts(path);
  const double bytes = bytes_a_cell * facts.size[0] * facts.size[1] * facts.size[2];
  if (bytes > physics::usable_memory())
    throw InputError(fmt::format(
        "{}: would take {:.2g} GB of memory, {:.2g} GB may be taken here; import the image with a coarser "
        "--partition",
        path, 1e-9 * bytes, 1e-9 * physics::usable_memory()));
  return read_volume(path);
}

ImageTissue find_tissue(const Volume& volume, const std::optional<KeepWindow>& keep,
                        const std::string& path) {
  ImageTissue found;
  found.keep = keep ? *keep : window_of(volume, path);
  const double finest = volume.spacing.minCoeff();
  const double image = volume.spacing.prod() * static_cast<double>(volume.n_cells());
  const double survey_edge = std::max(finest, std::cbrt(image / survey_cells));
  const Cells survey = tissue_of(resample(volume, partition_for(volume, survey_edge)), found.keep, false);
  check_tissue(survey, found.keep, path);
  const double wanted = std::min(largest_tip, tip_to_depth * volume_over_surface(survey));
  const double edge = std::max({cell_to_tip * wanted, finest, std::cbrt(image / most_cells)});
  found.partition = partition_for(volume, edge);
  found.cells = tissue_of(resample(volume, found.partition), found.keep, true);
  check_tissue(found.cells, found.keep, path);
  found.tip_radius = std::max(wanted, found.cells.spacing.maxCoeff());
  return found;
}

}  // namespace palpate::deploy
