#include <fmt/format.h>

#include <algorithm>

#include "common/math/hash.h"
#include "common/math/units.h"
#include "common/record/volume.h"
#include "deploy/palpate/info.h"

namespace palpate::deploy {
namespace {

std::string orientation_text(const Volume& volume) {
  if (!volume.orientation) return "unknown";
  const Eigen::Matrix3d& m = *volume.orientation;
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    text += fmt::format("{}{} ({:.3g}, {:.3g}, {:.3g})", axis == 0 ? "" : ", ", "xyz"[axis], m(0, axis),
                        m(1, axis), m(2, axis));
  }
  return text + " in LPS";
}

std::string transfer_text(const Volume& volume) {
  std::string text;
  for (const TransferPoint& point : volume.transfer) {
    text += fmt::format("\n  {:>10.6g}  ({:.2f}, {:.2f}, {:.2f}, {:.2f})", point.intensity, point.rgba[0],
                        point.rgba[1], point.rgba[2], point.rgba[3]);
  }
  return text;
}

}  // namespace

std::string info_volume(const std::string& path) {
  const Volume volume = read_volume(path);
  const auto [lo, hi] = std::minmax_element(volume.intensity.begin(), volume.intensity.end());
  const auto mm = [&](int axis) { return mm_from_m(volume.spacing[axis]); };
  std::string text = fmt::format("volume       {}\n", path);
  text += fmt::format("partition    {} x {} x {} cells ({})\n", volume.size[0], volume.size[1],
                      volume.size[2], volume.n_cells());
  text += fmt::format("spacing      {:.6g} x {:.6g} x {:.6g} mm\n", mm(0), mm(1), mm(2));
  text += fmt::format("extent       {:.6g} x {:.6g} x {:.6g} mm\n", mm(0) * volume.size[0],
                      mm(1) * volume.size[1], mm(2) * volume.size[2]);
  text += fmt::format("origin       ({:.6g}, {:.6g}, {:.6g}) mm\n", mm_from_m(volume.origin[0]),
                      mm_from_m(volume.origin[1]), mm_from_m(volume.origin[2]));
  text += fmt::format("orientation  {}\n", orientation_text(volume));
  text += fmt::format("intensity    {:.6g} to {:.6g}\n", static_cast<double>(*lo), static_cast<double>(*hi));
  text += fmt::format("source       {} ({} x {} x {} cells)\n", volume.source, volume.source_size[0],
                      volume.source_size[1], volume.source_size[2]);
  text += fmt::format("checksum     {}\n", hex_of(volume.source_checksum));
  text += fmt::format("transfer     intensity, then RGBA{}\n", transfer_text(volume));
  return text;
}

}  // namespace palpate::deploy
