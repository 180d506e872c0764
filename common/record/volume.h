#pragma once
// An imported image: what `palpate import` writes and physics_node reads. HDF5 on disk, docs/volume_file.md.

#include <Eigen/LU>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace palpate {

inline constexpr std::int64_t volume_cells_limit =
    1'000'000'000;  // refused from here on, before any memory is taken

/// One control point of a transfer function: from this intensity on, this colour (linear between points).
struct TransferPoint {
  double intensity = 0;
  std::array<double, 4> rgba{};
};  // each 0..1

struct Volume {
  std::array<int, 3> size{};            // cells along x, y, z
  Eigen::Vector3d spacing = {0, 0, 0};  // of the cells [m], all > 0
  std::optional<Eigen::Matrix3d>
      orientation;                      // columns: patient directions (LPS) of x, y, z; absent: unknown
  Eigen::Vector3d origin = {0, 0, 0};   // patient position of the first cell's centre [m]
  std::vector<float> intensity;         // x fastest, then y, then z (nx * ny * nz)
  std::vector<TransferPoint> transfer;  // sorted by intensity, at least two
  std::string source;                   // file name (no folder) that it came from
  std::uint64_t source_checksum = 0;    // FNV-1a of the bytes of the source file (of a series: of all files)
  std::array<int, 3> source_size{};     // before resampling

  std::size_t n_cells() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  /// Do its axes go round the other way than a patient's? Then a body made of it has x turned round, so that it is no mirror image.
  bool is_left_handed() const { return orientation && orientation->determinant() < 0; }
  float at(int i, int j, int k) const {
    return intensity[static_cast<std::size_t>(i) +
                     static_cast<std::size_t>(size[0]) *
                         (static_cast<std::size_t>(j) +
                          static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k))];
  }
};

/// Writes beside, then renames: `path` is either complete or untouched. @throws InputError
void write_volume(const Volume& volume, const std::string& path);

/// @throws InputError: missing, truncated, not a palpate volume, other version, absurd sizes, spacing not finite,
/// sizes that do not match the data, values that are not numbers
Volume read_volume(const std::string& path);

/// The volume on another partition: cells of size * spacing / partition, trilinear at their centres
/// (box-averaged where a new cell is larger than an old one, which keeps the mean). @throws InputError: absurd partition
Volume resample(const Volume& volume, std::array<int, 3> partition);

/// Colour of an intensity, 0xAABBGGRR: linear between the points, the outermost colours beyond them.
std::uint32_t rgba_of(const std::vector<TransferPoint>& transfer, double intensity);

/// For CT in Hounsfield units: air clear, fat yellowish, muscle reddish, bone white. The tones are close to each other: the cells at
/// the skin are partly air, and strong colours would draw rings on it. `lo`, `hi`: range of the image;
/// an image that does not look like CT (lo >= 0, say) gets a grey ramp.
std::vector<TransferPoint> default_transfer(double lo, double hi);

/// The two it chooses from, and how: CT reaches down to air (-500 or less) and up to tissue (100 or more).
std::vector<TransferPoint> ct_transfer();
std::vector<TransferPoint> grey_transfer(double lo, double hi);
bool looks_like_ct(double lo, double hi);

}  // namespace palpate
