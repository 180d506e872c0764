#include <algorithm>
#include <cmath>

#include "common/error/error.h"
#include "common/math/hash.h"
#include "common/record/hdf5_file.h"
#include "common/record/part_file.h"
#include "common/record/volume.h"
#include "common/record/volume_check.h"

namespace palpate {
namespace {

bool fits_int16(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](float v) { return v >= -32768.0f && v <= 32767.0f && v == std::trunc(v); });
}

std::vector<double> numbers_of(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

std::vector<double> numbers_of(const std::array<int, 3>& n) {
  return {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])};
}

void write_intensity(Hdf5File& file, const Volume& volume) {
  // x is fastest in memory, so it is the last axis of the dataset.
  const std::vector<std::uint64_t> shape = {static_cast<std::uint64_t>(volume.size[2]),
                                            static_cast<std::uint64_t>(volume.size[1]),
                                            static_cast<std::uint64_t>(volume.size[0])};
  if (fits_int16(volume.intensity)) {
    std::vector<std::int16_t> whole(volume.intensity.size());
    std::transform(volume.intensity.begin(), volume.intensity.end(), whole.begin(),
                   [](float v) { return static_cast<std::int16_t>(v); });
    file.write("/intensity", shape, whole.data());
  } else {
    file.write("/intensity", shape, volume.intensity.data());
  }
}

void write_transfer(Hdf5File& file, const std::vector<TransferPoint>& transfer) {
  std::vector<double> rows;
  for (const auto& point : transfer) {
    rows.push_back(point.intensity);
    rows.insert(rows.end(), point.rgba.begin(), point.rgba.end());
  }
  file.write("/transfer", {transfer.size(), 5}, rows.data());
}

void check(const std::string& where, const Volume& volume) {
  check_size(where, {volume.size[0], volume.size[1], volume.size[2]});
  check_spacing(where, volume.spacing);
  PALPATE_CHECK(volume.intensity.size() == volume.n_cells(), "a volume's sizes match its values");
  check_intensity(where, volume.intensity);
  check_transfer(where, volume.transfer);
}

void write_all(Hdf5File& file, const Volume& volume) {
  file.set_text("format", "palpate volume");
  file.set_numbers("version", {1});
  file.set_numbers("partition", numbers_of(volume.size));
  file.set_numbers("spacing_m", numbers_of(volume.spacing));
  file.set_numbers("origin_m", numbers_of(volume.origin));
  if (volume.orientation) {
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = *volume.orientation;
    file.set_numbers("orientation_lps", {rows.data(), rows.data() + 9});
  }
  file.set_text("source", volume.source);
  file.set_text("source_checksum", hex_of(volume.source_checksum));
  file.set_numbers("source_size", numbers_of(volume.source_size));
  write_intensity(file, volume);
  write_transfer(file, volume.transfer);
}

}  // namespace

void write_volume(const Volume& volume, const std::string& path) {
  check(path, volume);
  PartFile beside(path);
  try {
    Hdf5File file(beside.part(), Hdf5File::Mode::create);
    write_all(file, volume);
    file.close();
  } catch (const std::runtime_error& error) {
    throw InputError(std::string(error.what()) + "; make room or name another place");
  }
  beside.commit();
}

}  // namespace palpate
